// The ground of the terrain scene: a heightfield, a triangle mesh and a plane, side by side.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_TERRAIN_GROUND_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_TERRAIN_GROUND_H

#include "demos/scenes/scene_objects.h"

#include <array>
#include <vector>

namespace ode_predictive_space::scenes
{
constexpr double terrain_length = 2000; ///< along x, metres: 10^4 times the size of an object

/// Three strips along x. Seen along y: a heightfield, then a mesh, then the plane z = 0, each as wide as a third of the
/// square of the objects. The hills, of 1 m at most, end where the plane begins.
class TerrainGround
{
public:
    /// @param half_side of the square, metres
    explicit TerrainGround(double half_side);
    ~TerrainGround();
    TerrainGround(const TerrainGround &) = delete;
    TerrainGround &operator=(const TerrainGround &) = delete;

    /// Make the three geoms. This object must outlive them. The pieces of ground do not collide with one another.
    void add_geoms(SceneObjects &objects) const;

    /// Height of the ground at a place, metres.
    double height(double x, double y) const;

private:
    using Vertex = std::array<float, 3>;
    using Triangle = std::array<dTriIndex, 3>;

    void make_heightfield();
    void make_mesh();

    double half_side_;
    dHeightfieldDataID heightfield_;
    std::vector<Vertex> vertices_; // ODE keeps pointers into these two
    std::vector<Triangle> triangles_;
    dTriMeshDataID mesh_;
};
} // namespace ode_predictive_space::scenes

#endif
