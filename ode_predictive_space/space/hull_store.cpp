#include "ode_predictive_space/space/hull_store.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "ode_predictive_space/broadphase/tuning.h"
#include "ode_predictive_space/prediction/envelope.h"
#include "ode_predictive_space/space/geom_scene.h"
#include "ode_predictive_space/space/height_data.h"
#include "ode_predictive_space/space/mesh_data.h"
#include "ode_predictive_space/surface/triangle_tree.h"

namespace ode_predictive_space
{
namespace
{
template <typename T> std::uint64_t word(T *pointer)
{
    return reinterpret_cast<std::uintptr_t>(pointer);
}

std::uint64_t word(int number)
{
    return static_cast<unsigned>(number);
}

std::uint64_t word(double number)
{
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    return bits;
}

DataKey key_of(const dxConvex *convex)
{
    return {word(convex->points), convex->pointcount, word(convex->planes), convex->planecount, word(convex->polygons)};
}

// ODE has a box for each data, also where several have arrays in common.
DataKey key_of(const TriangleArrays &mesh, dTriMeshDataID data)
{
    return {word(mesh.vertices),
            mesh.vertex_count,
            word(mesh.vertex_stride) << 1 | mesh.single,
            word(mesh.triangles),
            mesh.triangle_count,
            word(mesh.triangle_stride),
            word(data)};
}

DataKey key_of(const HeightSamples &heights)
{
    return {word(heights.samples),
            word(heights.user_data),
            word(heights.get_height),
            word(heights.columns) << 32 | word(heights.rows),
            word(heights.source) << 1 | (heights.repeats != 0),
            word(double{heights.cell_x}),
            word(double{heights.cell_z}),
            word(double{heights.scale}),
            word(double{heights.offset})};
}

// All zero for geoms that are not made of data, or without any.
DataKey key_of(dxGeom *geom)
{
    switch (geom->type)
    {
    case dConvexClass:
        return key_of(static_cast<const dxConvex *>(geom));
    case dTriMeshClass:
    {
        const TriangleArrays *mesh = mesh_data_of(geom);
        return mesh ? key_of(*mesh, dGeomTriMeshGetData(geom)) : DataKey{};
    }
    case dHeightfieldClass:
    {
        const HeightSamples *heights = height_data_of(geom);
        return heights ? key_of(*heights) : DataKey{};
    }
    default:
        return {};
    }
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
                hull.aspect,
                quotient(std::max({one.squaredNorm(), other.squaredNorm(), (one - other).squaredNorm()}), normal));
    }
}

// ODE keeps the box of a mesh's data from when they were built. It is the bounding box of a geom that has not been moved.
Box kept_box(dGeomID mesh)
{
    const dGeomID unplaced = dCreateTriMesh(nullptr, dGeomTriMeshGetData(mesh), nullptr, nullptr, nullptr);
    const Box box = to_box(valid_aabb(unplaced));
    dGeomDestroy(unplaced);
    return box;
}

bool has_old_box(dGeomID mesh, const Box &box)
{
    constexpr double rounding = 1e-6;
    const Vector3 slack = Vector3::Constant(rounding * box.diagonal().norm());
    return !Box(box.min() - slack, box.max() + slack).contains(kept_box(mesh));
}

// The corners of the grid, at no height: it lies around the origin. None of one without cells, or with too many.
Points points_of(const HeightSamples &heights)
{
    if (heights.columns < 2 || heights.rows < 2 || heights.columns > tuning::most_heights / heights.rows)
        return {};
    const double x = 0.5 * heights.width, z = 0.5 * heights.depth;
    return {Vector3(-x, 0, -z), Vector3(x, 0, z)};
}

// The data themselves may be destroyed before all heights are read, when others with the same samples are there.
void take_heights(const HeightSamples &heights, DataHull &hull)
{
    hull.surface = std::make_shared<HeightGrid>(heights.size(),
                                                [heights](int column, int row) { return heights.height(column, row); });
}

Points points_of(dxGeom *geom)
{
    switch (geom->type)
    {
    case dConvexClass:
        return points_of(static_cast<const dxConvex *>(geom));
    case dTriMeshClass:
        return points_of(*mesh_data_of(geom));
    default:
        return points_of(*height_data_of(geom));
    }
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
    {
        take_triangles(*mesh_data_of(geom), *hull);
        hull->has_old_box = has_old_box(geom, box);
    }
    else if (geom->type == dHeightfieldClass)
        take_heights(*height_data_of(geom), *hull);
    hulls_[key] = hull;
    return hull;
}

bool HullStore::is_outdated(dxGeom *geom, const VertexHull &hull)
{
    const DataHull &made = static_cast<const DataHull &>(hull);
    return made.outdated || made.key != key_of(geom);
}

// Also those of other data that are read from the same array.
void HullStore::outdate(dxGeom *geom)
{
    const std::uint64_t array = key_of(geom).front();
    for (auto known = hulls_.lower_bound(DataKey{array}); known != hulls_.end() && known->first.front() == array;)
    {
        if (const std::shared_ptr<DataHull> hull = known->second.lock())
            hull->outdated = true;
        known = hulls_.erase(known);
    }
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
