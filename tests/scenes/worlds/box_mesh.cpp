#include "tests/scenes/worlds/box_mesh.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double wall = 0.5; // half the thickness, metres
} // namespace

BoxMesh::BoxMesh() : data_(dGeomTriMeshDataCreate()) {}

BoxMesh::~BoxMesh()
{
    dGeomTriMeshDataDestroy(data_);
}

void BoxMesh::add(const Vector3 &centre, const Vector3 &half)
{
    const auto first = static_cast<dTriIndex>(vertices_.size());
    for (unsigned corner = 0; corner < 8; ++corner)
    {
        Vertex vertex{};
        for (unsigned axis = 0; axis < 3; ++axis)
        {
            const double sign = (corner >> axis & 1u) != 0 ? 1 : -1;
            vertex[axis] = static_cast<float>(centre[axis] + sign * half[axis]);
        }
        vertices_.push_back(vertex);
    }
    // Corners are numbered by the signs of x, y and z; triangles are counterclockwise from outside.
    constexpr std::array<std::array<dTriIndex, 3>, 12> faces = {{{0, 2, 1},
                                                                 {1, 2, 3},
                                                                 {4, 5, 6},
                                                                 {5, 7, 6},
                                                                 {0, 1, 4},
                                                                 {1, 5, 4},
                                                                 {2, 6, 3},
                                                                 {3, 6, 7},
                                                                 {0, 4, 2},
                                                                 {2, 4, 6},
                                                                 {1, 3, 5},
                                                                 {3, 7, 5}}};
    for (const auto &face : faces)
        triangles_.push_back({first + face[0], first + face[1], first + face[2]});
}

void BoxMesh::add_room(const Vector3 &half, bool ceiling)
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
            add(centre, size);
        }
    }
}

dGeomID BoxMesh::make_geom(dSpaceID space)
{
    dGeomTriMeshDataBuildSingle(data_, vertices_.data(), sizeof(Vertex), static_cast<int>(vertices_.size()),
                                triangles_.data(), static_cast<int>(3 * triangles_.size()), sizeof(Triangle));
    return dCreateTriMesh(space, data_, nullptr, nullptr, nullptr);
}
} // namespace ode_predictive_space::scenes
