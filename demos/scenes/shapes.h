// The solids of the scenes, each given by the radius of the sphere around it.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_SHAPES_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_SHAPES_H

#include "demos/scenes/vector.h"

#include <array>
#include <vector>

namespace ode_predictive_space::scenes
{
enum class Shape
{
    sphere,
    box,
    capsule,
    mesh,     ///< a faceted ball of 80 triangles
    cylinder, ///< as long as it is wide
    convex    ///< an octahedron
};

/// Half the side of a cube, as all boxes here are, in metres.
double half_side_of_box(double bounding_radius);

/// The triangles of Shape::mesh, for one radius. ODE keeps pointers into it: it must outlive the geoms made of it.
class BallMesh
{
public:
    explicit BallMesh(double radius);
    ~BallMesh();
    BallMesh(const BallMesh &) = delete;
    BallMesh &operator=(const BallMesh &) = delete;

    dTriMeshDataID data() const { return data_; }

private:
    using Vertex = std::array<float, 3>;
    using Triangle = std::array<dTriIndex, 3>;

    void make_icosahedron();
    void split_triangles();
    dTriIndex add_vertex(const Vector3 &direction);
    Vector3 direction_of(dTriIndex vertex) const;

    double radius_;
    std::vector<Vertex> vertices_;
    std::vector<Triangle> triangles_;
    dTriMeshDataID data_;
};

/// The faces of Shape::convex, for one radius. ODE keeps pointers into it: it must outlive the geoms made of it.
class Octahedron
{
public:
    explicit Octahedron(double radius);

    dGeomID make_geom(dSpaceID space) const;

private:
    static constexpr unsigned corners = 6;
    static constexpr unsigned faces = 8;

    std::array<dReal, 3 * corners> points_{};
    std::array<dReal, 4 * faces> planes_{}; ///< of each face its normal, outwards, and its distance from the centre
    std::array<unsigned, 4 * faces> polygons_{}; ///< of each face 3 and its corners, counterclockwise from outside
};

/// What the geoms of a scene may share.
struct ShapeData
{
    const BallMesh *mesh = nullptr;     ///< for Shape::mesh
    const Octahedron *convex = nullptr; ///< for Shape::convex
};

/// Make a geom whose bounding sphere has this radius, in metres.
dGeomID make_shape(dSpaceID space, Shape shape, double bounding_radius, const ShapeData &data = {});

/// The mass of such a solid. A mesh has the mass of the ball that it represents.
dMass mass_of_shape(Shape shape, double bounding_radius, double density);
} // namespace ode_predictive_space::scenes

#endif
