#include "ode_predictive_space/space/hull_store.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "ode_predictive_space/broadphase/tuning.h"
#include "ode_predictive_space/prediction/envelope.h"
#include "ode_predictive_space/space/mesh_data.h"

namespace ode_predictive_space
{
namespace
{
template <typename T> std::uintptr_t word(const T *pointer)
{
    return reinterpret_cast<std::uintptr_t>(pointer);
}

std::uintptr_t word(int number)
{
    return static_cast<std::uintptr_t>(static_cast<unsigned>(number));
}

DataKey key_of(const dxConvex *convex)
{
    return {word(convex->points), convex->pointcount, word(convex->planes), convex->planecount, word(convex->polygons)};
}

DataKey key_of(const TriangleArrays &mesh)
{
    return {word(mesh.vertices),  mesh.vertex_count,   word(mesh.vertex_stride) << 1 | mesh.single,
            word(mesh.triangles), mesh.triangle_count, word(mesh.triangle_stride)};
}

// All zero for geoms that are not made of data, or without any.
DataKey key_of(dxGeom *geom)
{
    if (geom->type == dConvexClass)
        return key_of(static_cast<const dxConvex *>(geom));
    const TriangleArrays *mesh = geom->type == dTriMeshClass ? mesh_data_of(geom) : nullptr;
    return mesh ? key_of(*mesh) : DataKey{};
}

using Points = std::vector<Vector3>;

Points points_of(const dxConvex *convex)
{
    Points points;
    for (unsigned i = 0; i < convex->pointcount; ++i)
        points.emplace_back(convex->points[3 * i], convex->points[3 * i + 1], convex->points[3 * i + 2]);
    return points;
}

// Those that a triangle has; none when one has a vertex that is not there.
Points points_of(const TriangleArrays &mesh)
{
    std::vector<bool> used(mesh.vertex_count);
    for (unsigned i = 0; i < mesh.triangle_count; ++i)
        for (std::uint32_t index : mesh.indices(i))
        {
            if (index >= mesh.vertex_count)
                return {};
            used[index] = true;
        }
    Points points;
    for (unsigned i = 0; i < mesh.vertex_count; ++i)
        if (used[i])
            points.push_back(mesh.vertex(i));
    return points;
}

// Triangles whose corners coincide count for the least normal only: to ODE, they are never touched by other shapes than meshes.
void take_triangles(const TriangleArrays &mesh, DataHull &hull)
{
    hull.surface = std::make_shared<TriangleTree>(mesh);
    for (unsigned i = 0; i < mesh.triangle_count; ++i)
    {
        const TriangleCorners corners = mesh.corners(i);
        const Vector3 one = corners[1] - corners[0], other = corners[2] - corners[0];
        const double normal = one.cross(other).norm();
        hull.least_normal = std::min(hull.least_normal, normal);
        if (!one.isZero(0) && !other.isZero(0) && one != other)
            hull.aspect = std::max(
                hull.aspect, std::max({one.squaredNorm(), other.squaredNorm(), (one - other).squaredNorm()}) / normal);
    }
}

Points points_of(dxGeom *geom)
{
    return geom->type == dConvexClass ? points_of(static_cast<const dxConvex *>(geom)) : points_of(*mesh_data_of(geom));
}

Points corners_of(const Box &box)
{
    Points corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back(box.corner(static_cast<Box::CornerType>(i)));
    return corners;
}
} // namespace

std::shared_ptr<const DataHull> HullStore::hull_of(dxGeom *geom, const std::shared_ptr<const VertexHull> &before)
{
    if (before && !is_outdated(geom, *before))
        return std::static_pointer_cast<const DataHull>(before);
    const DataKey key = key_of(geom);
    if (key == DataKey{})
        return nullptr;
    const auto known = hulls_.find(key);
    if (known != hulls_.end())
        if (std::shared_ptr<DataHull> hull = known->second.lock(); hull && !hull->outdated)
            return hull;
    return make_hull(geom, key);
}

std::shared_ptr<const DataHull> HullStore::make_hull(dxGeom *geom, const DataKey &key)
{
    Points points = points_of(geom);
    Box box;
    for (const Vector3 &point : points)
    {
        if (!(point.lpNorm<Eigen::Infinity>() <= largest_length))
            return nullptr;
        box.extend(point);
    }
    if (points.empty())
        return nullptr;
    if (points.size() > tuning::most_hull_points)
        points = corners_of(box);
    forget_unused();
    const auto hull = std::make_shared<DataHull>(VertexHull(std::move(points)), key);
    if (geom->type == dTriMeshClass)
        take_triangles(*mesh_data_of(geom), *hull);
    hulls_[key] = hull;
    return hull;
}

bool HullStore::is_outdated(dxGeom *geom, const VertexHull &hull)
{
    const DataHull &made = static_cast<const DataHull &>(hull);
    return made.outdated || made.key != key_of(geom);
}

void HullStore::outdate(dxGeom *geom)
{
    const auto known = hulls_.find(key_of(geom));
    if (known == hulls_.end())
        return;
    if (const std::shared_ptr<DataHull> hull = known->second.lock())
        hull->outdated = true;
    hulls_.erase(known);
}

void HullStore::forget_unused()
{
    for (auto hull = hulls_.begin(); hull != hulls_.end();)
        hull = hull->second.expired() ? hulls_.erase(hull) : std::next(hull);
}

std::size_t HullStore::bytes() const
{
    std::size_t bytes = 0;
    for (const auto &[key, unused] : hulls_)
        if (const std::shared_ptr<DataHull> hull = unused.lock())
            bytes += sizeof key + sizeof unused + hull->bytes();
    return bytes;
}
} // namespace ode_predictive_space
