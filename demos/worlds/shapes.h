// The solids of the worlds, each given by the radius of the sphere around it.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_SHAPES_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_SHAPES_H

#include "demos/worlds/triangle_mesh.h"

#include <array>

namespace ode_predictive_space::worlds
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

/// What the geoms of a world may share.
struct ShapeData
{
    const TriangleMesh *ball = nullptr; ///< for Shape::mesh
    const Octahedron *convex = nullptr; ///< for Shape::convex
};

/// Make a geom whose bounding sphere has this radius, in metres.
dGeomID make_shape(dSpaceID space, Shape shape, double bounding_radius, const ShapeData &data = {});

/// The mass of such a solid. A mesh has the mass of the ball that it represents.
dMass mass_of_shape(Shape shape, double bounding_radius, double density);
} // namespace ode_predictive_space::worlds

#endif
