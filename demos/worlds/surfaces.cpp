#include "demos/worlds/surfaces.h"

#include "ode_predictive_space/haptics/device/random.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double building_wall = 1;     // thickness, metres
constexpr int squares_along_wall = 134; // of a rough room, two triangles each
constexpr double roughness = 0.02;      // metres
} // namespace

std::vector<Wall> walls_of(const Vector3 &half_room, double thickness, bool lid)
{
    std::vector<Wall> walls;
    for (int axis = 0; axis < 3; ++axis)
    {
        for (const double side : {-1.0, 1.0})
        {
            Wall wall{Vector3::Zero(), half_room + Vector3::Constant(thickness)};
            wall.centre[axis] = side * (half_room[axis] + thickness / 2);
            wall.half[axis] = thickness / 2;
            if (axis != 2 || side < 0 || lid)
                walls.push_back(wall);
        }
    }
    return walls;
}

dTriIndex TriangleMesh::add_vertex(const Vector3 &place)
{
    vertices_.push_back({static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(place.z())});
    return static_cast<dTriIndex>(vertices_.size() - 1);
}

void TriangleMesh::build(bool for_convexes)
{
    dGeomTriMeshDataBuildSingle(data_, vertices_.data(), sizeof(Vertex), static_cast<int>(vertices_.size()),
                                triangles_.data(), static_cast<int>(3 * triangles_.size()), sizeof(Triangle));
    if (for_convexes)
        dGeomTriMeshDataPreprocess2(data_, 1u << dTRIDATAPREPROCESS_BUILD_FACE_ANGLES, nullptr);
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
    for (const Wall &wall : walls_of(half, building_wall, ceiling))
        add_box(wall.centre, wall.half);
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

void TriangleMesh::add_ball(double radius)
{
    const auto direction_of = [this](dTriIndex vertex) {
        const Vertex &v = vertices_[vertex];
        return Vector3(v[0], v[1], v[2]).normalized();
    };
    const auto vertex_at = [this, radius](const Vector3 &direction) {
        const Eigen::Vector3f point = (radius * direction.normalized()).cast<float>();
        const Vertex vertex = {point.x(), point.y(), point.z()};
        const auto found = std::find(vertices_.begin(), vertices_.end(), vertex);
        const auto index = static_cast<dTriIndex>(found - vertices_.begin());
        if (found == vertices_.end())
            vertices_.push_back(vertex);
        return index;
    };
    const double golden = (1 + std::sqrt(5.0)) / 2;
    for (const double a : {-1.0, 1.0})
    {
        for (const double b : {-golden, golden})
        {
            for (const Vector3 &corner : {Vector3(a, b, 0), Vector3(0, a, b), Vector3(b, 0, a)})
                vertex_at(corner);
        }
    }
    constexpr Triangle faces[] = {{0, 2, 1},  {0, 1, 6},   {0, 8, 2},  {0, 6, 4}, {0, 4, 8},  {1, 2, 7},  {1, 5, 6},
                                  {1, 7, 5},  {2, 3, 7},   {2, 8, 3},  {3, 9, 7}, {3, 8, 10}, {3, 10, 9}, {4, 6, 11},
                                  {4, 10, 8}, {4, 11, 10}, {5, 11, 6}, {5, 7, 9}, {5, 9, 11}, {9, 10, 11}};
    for (const auto [a, b, c] : faces)
    {
        const dTriIndex ab = vertex_at(direction_of(a) + direction_of(b));
        const dTriIndex bc = vertex_at(direction_of(b) + direction_of(c));
        const dTriIndex ca = vertex_at(direction_of(c) + direction_of(a));
        for (const Triangle &part :
             {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}})
            add_triangle(part);
    }
}

// ODE's heightfields have y upwards; turned upright by a quarter about x, their z runs against our y.
Heightfield::Heightfield(double width, double depth, int columns, int rows,
                         const std::function<double(int, int)> &height, double thickness)
    : data_(dGeomHeightfieldDataCreate())
{
    for (int row = 0; row < rows; ++row)
    {
        for (int column = 0; column < columns; ++column)
            heights_.push_back(height(column, row));
    }
    dGeomHeightfieldDataBuildDouble(data_, heights_.data(), 0, width, depth, columns, rows, 1, 0, thickness, 0);
}

Heightfield::Heightfield(double half, int samples, double (*height)(double, double), double highest)
    : Heightfield(
          2 * half, 2 * half, samples, samples,
          [=](int column, int row) {
              return height(half * (2.0 * column / (samples - 1) - 1), -half * (2.0 * row / (samples - 1) - 1));
          },
          1)
{
    dGeomHeightfieldDataSetBounds(data_, -highest, highest);
}

dGeomID Heightfield::make_geom(dSpaceID space) const
{
    const dGeomID geom = dCreateHeightfield(space, data_, 1);
    set_orientation(geom, Quaternion(Eigen::AngleAxisd(pi / 2, Vector3::UnitX())));
    return geom;
}
} // namespace ode_predictive_space::worlds
