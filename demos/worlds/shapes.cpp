#include "demos/worlds/shapes.h"

#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
// A capsule is a cylinder with two half balls; with these two its ends lie on the bounding sphere.
double capsule_radius(double bounding_radius)
{
    return bounding_radius / 2;
}

double capsule_length(double bounding_radius)
{
    return bounding_radius;
}

// Of a cylinder, whose length is twice this.
double cylinder_radius(double bounding_radius)
{
    return bounding_radius / std::sqrt(2.0);
}

double volume_of_octahedron(double radius)
{
    return 4.0 / 3.0 * std::pow(radius, 3);
}
} // namespace

double half_side_of_box(double bounding_radius)
{
    return bounding_radius / std::sqrt(3.0);
}

// Corner 2 * axis is on the negative side of the axis, the next one on the positive side. Face number f is on the positive side of
// those axes whose bits are set in f.
Octahedron::Octahedron(double radius)
{
    for (unsigned corner = 0; corner < corners; ++corner)
        points_[3 * corner + corner / 2] = corner % 2 == 0 ? -radius : radius;
    for (unsigned face = 0; face < faces; ++face)
    {
        const std::array<unsigned, 3> sides = {face & 1u, face >> 1u & 1u, face >> 2u & 1u};
        const bool mirrored = (sides[0] + sides[1] + sides[2]) % 2 == 0;
        polygons_[4 * face] = 3;
        for (unsigned axis = 0; axis < 3; ++axis)
        {
            const unsigned place = mirrored ? 2 - axis : axis;
            polygons_[4 * face + 1 + place] = 2 * axis + sides[axis];
            planes_[4 * face + axis] = (sides[axis] == 0 ? -1 : 1) / std::sqrt(3.0);
        }
        planes_[4 * face + 3] = radius / std::sqrt(3.0);
    }
}

dGeomID Octahedron::make_geom(dSpaceID space) const
{
    return dCreateConvex(space, planes_.data(), faces, points_.data(), corners, polygons_.data());
}

dGeomID make_shape(dSpaceID space, Shape shape, double bounding_radius, const ShapeData &data)
{
    switch (shape)
    {
    case Shape::box:
    {
        const double side = 2 * half_side_of_box(bounding_radius);
        return dCreateBox(space, side, side, side);
    }
    case Shape::capsule:
        return dCreateCapsule(space, capsule_radius(bounding_radius), capsule_length(bounding_radius));
    case Shape::mesh:
        return data.ball->make_geom(space);
    case Shape::cylinder:
    {
        const double radius = cylinder_radius(bounding_radius);
        return dCreateCylinder(space, radius, 2 * radius);
    }
    case Shape::convex:
        return data.convex->make_geom(space);
    case Shape::sphere:
        break;
    }
    return dCreateSphere(space, bounding_radius);
}

dMass mass_of_shape(Shape shape, double bounding_radius, double density)
{
    dMass mass;
    switch (shape)
    {
    case Shape::box:
    {
        const double side = 2 * half_side_of_box(bounding_radius);
        dMassSetBox(&mass, density, side, side, side);
        break;
    }
    case Shape::capsule:
        dMassSetCapsule(&mass, density, 3, capsule_radius(bounding_radius), capsule_length(bounding_radius));
        break;
    case Shape::cylinder:
    {
        const double radius = cylinder_radius(bounding_radius);
        dMassSetCylinder(&mass, density, 3, radius, 2 * radius);
        break;
    }
    case Shape::convex: // as that of a ball, its inertia is the same about all axes
        dMassSetSphereTotal(&mass, density * volume_of_octahedron(bounding_radius), std::sqrt(0.5) * bounding_radius);
        break;
    case Shape::sphere:
    case Shape::mesh:
        dMassSetSphere(&mass, density, bounding_radius);
        break;
    }
    return mass;
}
} // namespace ode_predictive_space::worlds
