#include "demos/worlds/triangle_mesh.h"

#include "ode_predictive_space/haptics/device/random.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double wall = 0.5;            // half the thickness, metres
constexpr int squares_along_wall = 134; // of a rough room, two triangles each
constexpr double roughness = 0.02;      // metres
} // namespace

dTriIndex TriangleMesh::add_vertex(const Vector3 &place)
{
    vertices_.push_back({static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(place.z())});
    return static_cast<dTriIndex>(vertices_.size() - 1);
}

void TriangleMesh::build()
{
    dGeomTriMeshDataBuildSingle(data_, vertices_.data(), sizeof(Vertex), static_cast<int>(vertices_.size()),
                                triangles_.data(), static_cast<int>(3 * triangles_.size()), sizeof(Triangle));
}

void TriangleMesh::add_box(const Vector3 &centre, const Vector3 &half)
{
    const auto first = static_cast<dTriIndex>(vertices_.size());
    for (unsigned corner = 0; corner < 8; ++corner)
    {
        const Vector3 side((corner & 1u) != 0 ? 1 : -1, (corner & 2u) != 0 ? 1 : -1, (corner & 4u) != 0 ? 1 : -1);
        add_vertex(centre + side.cwiseProduct(half));
    }
    // Corners are numbered by the signs of x, y and z.
    constexpr Triangle faces[] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                  {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (const Triangle &face : faces)
        add_triangle({first + face[0], first + face[1], first + face[2]});
}

void TriangleMesh::add_room(const Vector3 &half, bool ceiling)
{
    for (int axis = 0; axis < 3; ++axis)
    {
        for (const double side : {-1.0, 1.0})
        {
            if (axis == 2 && side > 0 && !ceiling)
                continue;
            Vector3 centre = Vector3::Zero();
            Vector3 size = half + Vector3::Constant(2 * wall);
            centre[axis] = side * (half[axis] + wall);
            size[axis] = wall;
            add_box(centre, size);
        }
    }
}

void TriangleMesh::add_rough_room(double half, std::uint64_t seed)
{
    haptics::Random unevenness(seed);
    constexpr dTriIndex row = squares_along_wall + 1;
    const auto along = [half](dTriIndex number) { return half * (2.0 * number / squares_along_wall - 1); };
    for (int wall = 0; wall < 6; ++wall)
    {
        const int axis = wall / 2, side = wall % 2 == 0 ? -1 : 1;
        const auto first = static_cast<dTriIndex>(vertices_.size());
        for (dTriIndex i = 0; i < row * row; ++i)
        {
            Vector3 place;
            place[axis] = side * (half + unevenness.uniform(0, roughness));
            place[(axis + 1) % 3] = along(i / row);
            place[(axis + 2) % 3] = along(i % row);
            add_vertex(place);
        }
        for (dTriIndex i = 0; i < squares_along_wall * squares_along_wall; ++i)
        {
            const dTriIndex a = first + i / squares_along_wall * row + i % squares_along_wall;
            const dTriIndex b = a + row, c = a + 1, d = b + 1;
            add_triangle(side > 0 ? Triangle{a, c, b} : Triangle{a, b, c});
            add_triangle(side > 0 ? Triangle{b, c, d} : Triangle{b, d, c});
        }
    }
}

std::unique_ptr<TriangleMesh> make_ball(double radius)
{
    auto ball = std::make_unique<TriangleMesh>();
    ball->make_icosahedron(radius);
    ball->split_triangles(radius);
    ball->build();
    // ODE needs them to find contacts with convexes.
    dGeomTriMeshDataPreprocess2(ball->data_, 1u << dTRIDATAPREPROCESS_BUILD_FACE_ANGLES, nullptr);
    return ball;
}

void TriangleMesh::make_icosahedron(double radius)
{
    const double golden = (1 + std::sqrt(5.0)) / 2;
    for (const double a : {-1.0, 1.0})
    {
        for (const double b : {-golden, golden})
        {
            vertex_on_ball(radius, {a, b, 0});
            vertex_on_ball(radius, {0, a, b});
            vertex_on_ball(radius, {b, 0, a});
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
                add_triangle(outwards ? Triangle{i, j, k} : Triangle{i, k, j});
            }
        }
    }
}

void TriangleMesh::split_triangles(double radius)
{
    std::vector<Triangle> finer;
    const auto between = [&](dTriIndex a, dTriIndex b) {
        return vertex_on_ball(radius, direction_of(a) + direction_of(b));
    };
    for (const auto [a, b, c] : triangles_)
    {
        const dTriIndex ab = between(a, b), bc = between(b, c), ca = between(c, a);
        finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles_ = finer;
}

dTriIndex TriangleMesh::vertex_on_ball(double radius, const Vector3 &direction)
{
    const Eigen::Vector3f point = (radius * direction.normalized()).cast<float>();
    const Vertex vertex = {point.x(), point.y(), point.z()};
    const auto found = std::find(vertices_.begin(), vertices_.end(), vertex);
    const auto index = static_cast<dTriIndex>(found - vertices_.begin());
    if (found == vertices_.end())
        vertices_.push_back(vertex);
    return index;
}

Vector3 TriangleMesh::direction_of(dTriIndex vertex) const
{
    const Vertex &v = vertices_[vertex];
    return Vector3(v[0], v[1], v[2]).normalized();
}
} // namespace ode_predictive_space::worlds
