// Buildings: many boxes as one triangle mesh.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SCENES_WORLDS_BOX_MESH_H
#define ODE_PREDICTIVE_SPACE_TESTS_SCENES_WORLDS_BOX_MESH_H

#include "demos/scenes/vector.h"

#include <array>
#include <vector>

namespace ode_predictive_space::scenes
{
/// ODE keeps pointers into it: it must outlive the geoms made of it.
class BoxMesh
{
public:
    BoxMesh();
    ~BoxMesh();
    BoxMesh(const BoxMesh &) = delete;
    BoxMesh &operator=(const BoxMesh &) = delete;

    void add(const Vector3 &centre, const Vector3 &half);

    /// Floor and four walls around a room, and a ceiling if there is one.
    void add_room(const Vector3 &half, bool ceiling);

    /// After the last add().
    dGeomID make_geom(dSpaceID space);

private:
    using Vertex = std::array<float, 3>;
    using Triangle = std::array<dTriIndex, 3>;

    std::vector<Vertex> vertices_;
    std::vector<Triangle> triangles_;
    dTriMeshDataID data_;
};
} // namespace ode_predictive_space::scenes

#endif
