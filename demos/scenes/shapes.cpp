#include "demos/scenes/shapes.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::scenes
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

BallMesh::BallMesh(double radius) : radius_(radius), data_(dGeomTriMeshDataCreate())
{
    make_icosahedron();
    split_triangles();
    dGeomTriMeshDataBuildSingle(data_, vertices_.data(), sizeof(Vertex), static_cast<int>(vertices_.size()),
                                triangles_.data(), static_cast<int>(3 * triangles_.size()), sizeof(Triangle));
    // ODE needs them to find contacts with convexes.
    dGeomTriMeshDataPreprocess2(data_, 1u << dTRIDATAPREPROCESS_BUILD_FACE_ANGLES, nullptr);
}

BallMesh::~BallMesh()
{
    dGeomTriMeshDataDestroy(data_);
}

void BallMesh::make_icosahedron()
{
    const double golden = (1 + std::sqrt(5.0)) / 2;
    for (const double a : {-1.0, 1.0})
    {
        for (const double b : {-golden, golden})
        {
            add_vertex({a, b, 0});
            add_vertex({0, a, b});
            add_vertex({b, 0, a});
        }
    }
    // Its faces are the triples of vertices at the distance of an edge, turned so that their normals point outwards.
    const double edge = 1.1 * 2 / std::sqrt(1 + golden * golden);
    const auto joined = [&](dTriIndex i, dTriIndex j) { return (direction_of(i) - direction_of(j)).norm() < edge; };
    for (dTriIndex i = 0; i < 12; ++i)
    {
        for (dTriIndex j = i + 1; j < 12; ++j)
        {
            for (dTriIndex k = j + 1; k < 12; ++k)
            {
                if (!joined(i, j) || !joined(j, k) || !joined(i, k))
                    continue;
                const bool outwards = direction_of(i).cross(direction_of(j)).dot(direction_of(k)) > 0;
                triangles_.push_back(outwards ? Triangle{i, j, k} : Triangle{i, k, j});
            }
        }
    }
}

void BallMesh::split_triangles()
{
    std::vector<Triangle> finer;
    for (const auto [a, b, c] : triangles_)
    {
        const dTriIndex ab = add_vertex(direction_of(a) + direction_of(b));
        const dTriIndex bc = add_vertex(direction_of(b) + direction_of(c));
        const dTriIndex ca = add_vertex(direction_of(c) + direction_of(a));
        finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles_ = finer;
}

dTriIndex BallMesh::add_vertex(const Vector3 &direction)
{
    const Eigen::Vector3f point = (radius_ * direction.normalized()).cast<float>();
    const Vertex vertex = {point.x(), point.y(), point.z()};
    const auto found = std::find(vertices_.begin(), vertices_.end(), vertex);
    const auto index = static_cast<dTriIndex>(found - vertices_.begin());
    if (found == vertices_.end())
        vertices_.push_back(vertex);
    return index;
}

Vector3 BallMesh::direction_of(dTriIndex vertex) const
{
    const Vertex &v = vertices_[vertex];
    return Vector3(v[0], v[1], v[2]).normalized();
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
        return dCreateTriMesh(space, data.mesh->data(), nullptr, nullptr, nullptr);
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
} // namespace ode_predictive_space::scenes
