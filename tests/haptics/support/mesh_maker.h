// Triangle meshes for tests: shapes, and their data in ODE.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_MESH_MAKER_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_MESH_MAKER_H

#include "tests/haptics/support/random_numbers.h"

#include <array>
#include <cmath>
#include <ode/ode.h>
#include <vector>

namespace ode_predictive_space::haptics
{
struct MeshShape
{
    std::vector<Vector3> vertices; ///< m
    std::vector<std::array<int, 3>> triangles;

    /// Adds a quadrilateral as two triangles; the corners go around it.
    void add_quad(const Vector3 &a, const Vector3 &b, const Vector3 &c, const Vector3 &d)
    {
        const int first = static_cast<int>(vertices.size());
        vertices.insert(vertices.end(), {a, b, c, d});
        triangles.push_back({first, first + 1, first + 2});
        triangles.push_back({first, first + 2, first + 3});
    }
};

/// A flat rectangle in the plane z = 0, of across x along quadrilaterals that share their corners.
inline MeshShape grid_mesh(double cell, int across, int along)
{
    MeshShape shape;
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i <= across; ++i)
            shape.vertices.emplace_back(cell * (i - across / 2.0), cell * (j - along / 2.0), 0);
    const int row = across + 1;
    for (int j = 0; j < along; ++j)
    {
        for (int i = 0; i < across; ++i)
        {
            const int corner = j * row + i;
            shape.triangles.push_back({corner, corner + 1, corner + row + 1});
            shape.triangles.push_back({corner, corner + row + 1, corner + row});
        }
    }
    return shape;
}

inline MeshShape sheet_mesh(double side, int cells)
{
    return grid_mesh(side / cells, cells, cells);
}

inline MeshShape box_mesh(const Vector3 &low, const Vector3 &high)
{
    const auto at = [&](int x, int y, int z) -> Vector3 {
        return {x != 0 ? high.x() : low.x(), y != 0 ? high.y() : low.y(), z != 0 ? high.z() : low.z()};
    };
    MeshShape shape;
    shape.add_quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
    shape.add_quad(at(0, 1, 0), at(1, 1, 0), at(1, 0, 0), at(0, 0, 0));
    shape.add_quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
    shape.add_quad(at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1));
    shape.add_quad(at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1));
    shape.add_quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
    return shape;
}

/// A sphere about the origin, with a vertex at each pole.
inline MeshShape sphere_mesh(double radius, int slices)
{
    const double pi = std::acos(-1.0);
    MeshShape shape;
    const int rings = slices / 2;
    for (int ring = 0; ring <= rings; ++ring)
    {
        for (int slice = 0; slice < slices; ++slice)
        {
            const double polar = pi * ring / rings;
            const double around = 2 * pi * slice / slices;
            shape.vertices.push_back(radius * Vector3(std::sin(polar) * std::cos(around),
                                                      std::sin(polar) * std::sin(around), std::cos(polar)));
        }
    }
    for (int ring = 0; ring < rings; ++ring)
    {
        for (int slice = 0; slice < slices; ++slice)
        {
            const int next = (slice + 1) % slices;
            const int upper = ring * slices;
            const int lower = upper + slices;
            shape.triangles.push_back({upper + slice, lower + slice, lower + next});
            shape.triangles.push_back({upper + slice, lower + next, upper + next});
        }
    }
    return shape;
}

/// A closed ball of some 4 n^2 triangles about the origin, as rough as a scan: waves of many lengths, and noise.
/// @param mean m; mean radius. @param rings n, between the poles. @param roughness of the radius. @param noise m; of vertices.
inline MeshShape rough_ball(double mean, int rings, double roughness, double noise, unsigned seed)
{
    RandomNumbers random(seed);
    MeshShape shape = sphere_mesh(mean, 2 * rings);
    std::vector<double> heights(shape.vertices.size(), 0);
    for (double waves = 3, high = roughness; waves < rings / 4.0; waves *= 1.5, high *= 0.7)
    {
        const Vector3 along = waves / mean * random.direction();
        const double phase = random.between(0, 2 * M_PI);
        for (std::size_t i = 0; i < heights.size(); ++i)
            heights[i] += high * std::sin(along.dot(shape.vertices[i]) + phase);
    }
    for (std::size_t i = 0; i < heights.size(); ++i)
        shape.vertices[i] += heights[i] * shape.vertices[i] + random.in_cube(noise);
    return shape;
}

/// Two slopes that meet at the y axis and go down from there.
inline MeshShape roof_mesh(double degrees)
{
    const double angle = degrees * std::acos(-1.0) / 180;
    const double x = 0.3 * std::cos(angle);
    const double z = -0.3 * std::sin(angle);
    MeshShape shape;
    shape.vertices = {{0, -0.3, 0}, {0, 0.3, 0}, {x, -0.3, z}, {x, 0.3, z}, {-x, -0.3, z}, {-x, 0.3, z}};
    shape.triangles = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}};
    return shape;
}

/// A mesh in ODE. It owns the data; the geom belongs to its space.
class OdeMesh
{
public:
    explicit OdeMesh(const MeshShape &shape) : data_(dGeomTriMeshDataCreate()) { set(shape); }
    ~OdeMesh() { dGeomTriMeshDataDestroy(data_); }
    OdeMesh(const OdeMesh &) = delete;
    OdeMesh &operator=(const OdeMesh &) = delete;

    /// Replaces the triangles in the same data.
    void set(const MeshShape &shape)
    {
        vertices_.clear();
        triangles_.clear();
        for (const Vector3 &vertex : shape.vertices)
            vertices_.insert(vertices_.end(), {vertex.x(), vertex.y(), vertex.z()});
        for (const auto &triangle : shape.triangles)
            for (const int vertex : triangle)
                triangles_.push_back(static_cast<dTriIndex>(vertex));
        dGeomTriMeshDataBuildDouble(data_, vertices_.data(), 3 * sizeof(double), static_cast<int>(vertices_.size() / 3),
                                    triangles_.data(), static_cast<int>(triangles_.size()), 3 * sizeof(dTriIndex));
    }

    dGeomID add_to(dSpaceID space) const { return dCreateTriMesh(space, data_, nullptr, nullptr, nullptr); }
    dTriMeshDataID data() const { return data_; }

private:
    dTriMeshDataID data_;
    std::vector<double> vertices_;
    std::vector<dTriIndex> triangles_;
};
} // namespace ode_predictive_space::haptics

#endif
