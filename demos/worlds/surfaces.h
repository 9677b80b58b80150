#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_SURFACES_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_SURFACES_H

#include "demos/worlds/vector.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace ode_predictive_space::worlds
{
struct Wall
{
    Vector3 centre;
    Vector3 half;
};

/// The walls around a room with this half, along each axis the lower one first; without the upper one if there is no lid.
/// Metres.
std::vector<Wall> walls_of(const Vector3 &half_room, double thickness, bool lid);

/// ODE keeps pointers into it: it must outlive the geoms made of it.
class TriangleMesh
{
public:
    using Triangle = std::array<dTriIndex, 3>;

    TriangleMesh() : data_(dGeomTriMeshDataCreate()) {}
    ~TriangleMesh() { dGeomTriMeshDataDestroy(data_); }
    TriangleMesh(const TriangleMesh &) = delete;
    TriangleMesh &operator=(const TriangleMesh &) = delete;

    /// @return its number, from 0 on.
    dTriIndex add_vertex(const Vector3 &place);

    /// Counterclockwise from outside.
    void add_triangle(const Triangle &corners) { triangles_.push_back(corners); }

    void add_box(const Vector3 &centre, const Vector3 &half);

    void add_room(const Vector3 &half, bool ceiling);

    /// A cube whose walls are uneven, of 215,472 triangles.
    void add_rough_room(double half, std::uint64_t seed);

    /// A faceted ball of 80 triangles: an icosahedron whose triangles are split once. The first in a mesh.
    void add_ball(double radius);

    /// Call after the last triangle. @param for_convexes find the angles of faces, which ODE needs for contacts with convexes.
    void build(bool for_convexes = false);

    /// Call after build().
    dGeomID make_geom(dSpaceID space) const { return dCreateTriMesh(space, data_, nullptr, nullptr, nullptr); }

private:
    using Vertex = std::array<float, 3>;

    std::vector<Vertex> vertices_;
    std::vector<Triangle> triangles_;
    dTriMeshDataID data_;
};

/// ODE keeps pointers into the heights: they must outlive the geom made of them.
class Heightfield
{
public:
    /// @param width along x, metres. @param depth along y, metres. @param thickness below the lowest height, metres.
    /// @param height of the sample in this column, along x, and row, against y, metres.
    Heightfield(double width, double depth, int columns, int rows, const std::function<double(int, int)> &height,
                double thickness);

    /// A square around the middle, with the height of each place, at most `highest` above or below 0.
    Heightfield(double half, int samples, double (*height)(double, double), double highest);

    ~Heightfield() { dGeomHeightfieldDataDestroy(data_); }
    Heightfield(const Heightfield &) = delete;
    Heightfield &operator=(const Heightfield &) = delete;

    /// z is up.
    dGeomID make_geom(dSpaceID space) const;

private:
    std::vector<double> heights_;
    dHeightfieldDataID data_;
};
} // namespace ode_predictive_space::worlds

#endif
