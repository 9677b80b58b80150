// Triangle meshes: a ball, buildings made of boxes, a room with rough walls.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_TRIANGLE_MESH_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_TRIANGLE_MESH_H

#include "demos/worlds/vector.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace ode_predictive_space::worlds
{
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

    /// Floor and four walls around a room, and a ceiling if there is one.
    void add_room(const Vector3 &half, bool ceiling);

    /// A cube whose walls are uneven, of 215,472 triangles.
    void add_rough_room(double half, std::uint64_t seed);

    /// After the last triangle.
    void build();

    /// After build().
    dGeomID make_geom(dSpaceID space) const { return dCreateTriMesh(space, data_, nullptr, nullptr, nullptr); }

private:
    using Vertex = std::array<float, 3>;

    friend std::unique_ptr<TriangleMesh> make_ball(double radius);
    void make_icosahedron(double radius);
    void split_triangles(double radius);
    dTriIndex vertex_on_ball(double radius, const Vector3 &direction);
    Vector3 direction_of(dTriIndex vertex) const;

    std::vector<Vertex> vertices_;
    std::vector<Triangle> triangles_;
    dTriMeshDataID data_;
};

/// A faceted ball of 80 triangles.
std::unique_ptr<TriangleMesh> make_ball(double radius);
} // namespace ode_predictive_space::worlds

#endif
