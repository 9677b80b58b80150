#include "tests/shape/polyhedron_geom.h"

#include <algorithm>
#include <utility>

#include <Eigen/Geometry>

namespace ode_predictive_space
{
Polyhedron Polyhedron::cube()
{
    Polyhedron cube;
    for (int i = 0; i < 8; ++i)
        cube.corners.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    cube.faces = {{1, 3, 7, 5}, {2, 6, 7, 3}, {4, 5, 7, 6}, {0, 4, 6, 2}, {0, 1, 5, 4}, {0, 2, 3, 1}};
    return cube;
}

Polyhedron Polyhedron::octahedron()
{
    Polyhedron octahedron;
    for (int axis = 0; axis < 3; ++axis)
        for (int side : {1, -1})
            octahedron.corners.push_back(side * Eigen::Vector3d::Unit(axis));
    octahedron.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return octahedron;
}

Polyhedron Polyhedron::tetrahedron()
{
    return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

Polyhedron Polyhedron::square()
{
    return {{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}}, {{0, 1, 2, 3}}};
}

Polyhedron Polyhedron::sheet(unsigned columns, unsigned rows,
                             const std::function<Eigen::Vector3d(double, double)> &point)
{
    Polyhedron sheet;
    for (unsigned j = 0; j <= rows; ++j)
        for (unsigned i = 0; i <= columns; ++i)
        {
            const auto here = static_cast<unsigned>(sheet.corners.size()), above = here + columns + 1;
            sheet.corners.push_back(point(1.0 * i / columns, 1.0 * j / rows));
            if (i == columns || j == rows)
                continue;
            sheet.faces.push_back({here, here + 1, above});
            sheet.faces.push_back({here + 1, above + 1, above});
        }
    return sheet;
}

void Polyhedron::add(const Polyhedron &other)
{
    const auto first = static_cast<unsigned>(corners.size());
    corners.insert(corners.end(), other.corners.begin(), other.corners.end());
    for (std::vector<unsigned> face : other.faces)
    {
        for (unsigned &corner : face)
            corner += first;
        faces.push_back(face);
    }
}

Polyhedron Polyhedron::changed(const Eigen::Vector3d &factors, const Eigen::Vector3d &by) const
{
    Polyhedron result = *this;
    for (Eigen::Vector3d &corner : result.corners)
        corner = corner.cwiseProduct(factors) + by;
    return result;
}

ConvexArrays::ConvexArrays(const Polyhedron &polyhedron)
{
    for (const Eigen::Vector3d &corner : polyhedron.corners)
        for (int axis = 0; axis < 3; ++axis)
            points_.push_back(static_cast<dReal>(corner[axis]));
    for (const std::vector<unsigned> &face : polyhedron.faces)
    {
        const Eigen::Vector3d &first = polyhedron.corners[face[0]];
        const Eigen::Vector3d normal =
            (polyhedron.corners[face[1]] - first).cross(polyhedron.corners[face[2]] - first).normalized();
        for (int axis = 0; axis < 3; ++axis)
            planes_.push_back(static_cast<dReal>(normal[axis]));
        planes_.push_back(static_cast<dReal>(normal.dot(first)));
        polygons_.push_back(static_cast<unsigned>(face.size()));
        polygons_.insert(polygons_.end(), face.begin(), face.end());
    }
}

dGeomID ConvexArrays::create(dSpaceID space) const
{
    return dCreateConvex(space, planes_.data(), static_cast<unsigned>(planes_.size() / 4), points_.data(),
                         static_cast<unsigned>(points_.size() / 3), polygons_.data());
}

void ConvexArrays::give_to(dGeomID convex) const
{
    dGeomSetConvex(convex, planes_.data(), static_cast<unsigned>(planes_.size() / 4), points_.data(),
                   static_cast<unsigned>(points_.size() / 3), polygons_.data());
}

void ConvexArrays::change(const Polyhedron &polyhedron)
{
    const ConvexArrays changed(polyhedron);
    std::copy(changed.points_.begin(), changed.points_.end(), points_.begin());
    std::copy(changed.planes_.begin(), changed.planes_.end(), planes_.begin());
}

// Many programs store normals between the corners, so these arrays have unused numbers there.
constexpr std::size_t per_vertex = 5, per_triangle = 4;
constexpr int unused = 77;

MeshArrays::MeshArrays(const Polyhedron &polyhedron, bool single) : single_(single)
{
    build(polyhedron);
}

MeshArrays::~MeshArrays()
{
    dGeomTriMeshDataDestroy(id_);
}

void MeshArrays::rebuild(const Polyhedron &polyhedron)
{
    old_vertices_.push_back(std::exchange(vertices_, {}));
    old_single_vertices_.push_back(std::exchange(single_vertices_, {}));
    build(polyhedron);
}

void ConvexArrays::move_points(const Eigen::Vector3d &by)
{
    for (std::size_t i = 0; i < points_.size(); ++i)
        points_[i] += static_cast<dReal>(by[static_cast<Eigen::Index>(i % 3)]);
}

void MeshArrays::build(const Polyhedron &polyhedron)
{
    triangles_.clear();
    for (const Eigen::Vector3d &corner : polyhedron.corners)
        vertices_.insert(vertices_.end(), {corner[0], corner[1], corner[2], unused, unused});
    single_vertices_.assign(vertices_.begin(), vertices_.end());
    for (const std::vector<unsigned> &face : polyhedron.faces)
        for (std::size_t i = 2; i < face.size(); ++i)
            triangles_.insert(triangles_.end(), {face[0], face[i - 1], face[i], unused});
    const int count = static_cast<int>(polyhedron.corners.size()),
              indices = static_cast<int>(triangles_.size() / per_triangle * 3);
    if (single_)
        dGeomTriMeshDataBuildSingle(id_, single_vertices_.data(), per_vertex * sizeof(float), count, triangles_.data(),
                                    indices, per_triangle * sizeof(dTriIndex));
    else
        dGeomTriMeshDataBuildDouble(id_, vertices_.data(), per_vertex * sizeof(double), count, triangles_.data(),
                                    indices, per_triangle * sizeof(dTriIndex));
}

void MeshArrays::build_face_angles()
{
    dGeomTriMeshDataPreprocess2(id_, 1u << dTRIDATAPREPROCESS_BUILD_FACE_ANGLES, nullptr);
}

void MeshArrays::move_corners(const Eigen::Vector3d &by)
{
    for (std::size_t i = 0; i < vertices_.size(); ++i)
        if (const std::size_t axis = i % per_vertex; axis < 3)
            single_vertices_[i] = static_cast<float>(vertices_[i] += by[static_cast<Eigen::Index>(axis)]);
    dGeomTriMeshDataUpdate(id_);
}
} // namespace ode_predictive_space
