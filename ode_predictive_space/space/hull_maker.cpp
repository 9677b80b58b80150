#include "ode_predictive_space/space/hull_maker.h"

#include <algorithm>
#include <cstring>

#include "ode_predictive_space/broadphase/tuning.h"
#include "ode_predictive_space/ode/height_data.h"
#include "ode_predictive_space/ode/mesh_data.h"
#include "ode_predictive_space/prediction/envelope.h"
#include "ode_predictive_space/space/geom_scene.h"
#include "ode_predictive_space/surface/triangle_tree.h"

namespace ode_predictive_space
{
namespace
{
constexpr std::size_t steps_per_triangle = 3, steps_per_point = 13; // to read a triangle, and to add a point to a hull

// The bytes of an address or a number, or of two short numbers.
template <typename T> std::uint64_t word(T value)
{
    std::uint64_t bits = 0;
    // T may be a pointer: its own size is meant. NOLINTNEXTLINE(bugprone-sizeof-expression)
    std::memcpy(&bits, &value, sizeof value);
    return bits;
}

DataKey key_of(const dxConvex *convex)
{
    return {word(convex->points), convex->pointcount, word(convex->planes), convex->planecount, word(convex->polygons)};
}

// The address of ODE's data is included, because data that share arrays still have separate boxes.
DataKey key_of(const TriangleArrays &mesh)
{
    return {word(mesh.vertices),  mesh.vertex_count,   word(std::array{mesh.vertex_stride, int{mesh.single}}),
            word(mesh.triangles), mesh.triangle_count, word(mesh.triangle_stride),
            word(&mesh)};
}

DataKey key_of(const HeightSamples &heights)
{
    return {word(heights.samples),
            word(heights.user_data),
            word(heights.get_height),
            word(std::array{heights.columns, heights.rows}),
            word(std::array{heights.source, int{heights.repeats != 0}}),
            word(heights.cell_x),
            word(heights.cell_z),
            word(heights.scale),
            word(heights.offset)};
}

// The box that ODE stores when a mesh's data are built. It is the bounding box of an unmoved geom.
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

// Adds opposite corners of the grid, which is centred at the origin; none if it has no cells, or too many samples.
void add_corners(const HeightSamples &heights, PointCloud &points)
{
    if (heights.columns < 2 || heights.rows < 2 || heights.columns > tuning::most_heights / heights.rows)
        return;
    const double x = 0.5 * heights.width, z = 0.5 * heights.depth;
    points.add(Vector3(-x, 0, -z));
    points.add(Vector3(x, 0, z));
}

void add_points(const dxConvex &convex, PointCloud &points)
{
    for (unsigned i = 0; i < convex.pointcount; ++i)
        points.add(Vector3(convex.points[3 * i], convex.points[3 * i + 1], convex.points[3 * i + 2]));
}

// Copies the data's members, because ODE's data may be destroyed before all heights are read, if other data share the samples.
std::shared_ptr<Surface> grid_of(const HeightSamples &heights)
{
    return std::make_shared<HeightGrid>(heights.size(),
                                        [heights](int column, int row) { return heights.height(column, row); });
}
} // namespace

DataKey key_of(dxGeom *geom)
{
    switch (geom->type)
    {
    case dConvexClass:
        return key_of(static_cast<const dxConvex *>(geom));
    case dTriMeshClass:
    {
        const TriangleArrays *mesh = mesh_data_of(geom);
        return mesh ? key_of(*mesh) : DataKey{};
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

void PointCloud::add(const Vector3 &point)
{
    is_usable_ &= point.lpNorm<Eigen::Infinity>() <= largest_length;
    box_.extend(point);
    if (points_.size() <= tuning::most_hull_points)
        points_.push_back(point);
}

std::vector<Vector3> PointCloud::corners() const
{
    std::vector<Vector3> corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back(box_.corner(static_cast<Box::CornerType>(i)));
    return corners;
}

std::vector<Vector3> PointCloud::take_points()
{
    return points_.size() <= tuning::most_hull_points ? std::exchange(points_, {}) : corners();
}

std::size_t MeshReader::read(std::size_t steps, PointCloud &points)
{
    for (; triangle_ < mesh_.triangle_count && is_readable_; steps -= steps_per_triangle)
    {
        if (steps < steps_per_triangle)
            return 0;
        read_triangle();
    }
    for (; vertex_ < used_.size() && is_readable_; --steps)
    {
        if (steps == 0)
            return 0;
        if (used_[vertex_])
            points.add(mesh_.vertex(vertex_));
        ++vertex_;
    }
    return steps;
}

// Triangles with coinciding corners count only for the least normal: in ODE, no shapes but meshes touch them.
void MeshReader::read_triangle()
{
    for (std::uint32_t index : mesh_.indices(triangle_))
    {
        is_readable_ &= index < used_.size();
        if (!is_readable_)
            return;
        used_[index] = true;
    }
    const TriangleCorners corners = mesh_.corners(triangle_++);
    const Vector3 one = corners[1] - corners[0], other = corners[2] - corners[0];
    const double normal = one.cross(other).norm();
    least_normal_ = std::min(least_normal_, normal);
    if (!one.isZero(0) && !other.isZero(0) && one != other)
        aspect_ = std::max(
            aspect_, quotient(std::max({one.squaredNorm(), other.squaredNorm(), (one - other).squaredNorm()}), normal));
}

HullMaker::HullMaker(dxGeom *geom, const DataKey &key) : geom_(geom), key_(key)
{
    if (geom_->type == dTriMeshClass)
        mesh_.emplace(*mesh_data_of(geom_));
}

std::size_t HullMaker::go_on(std::size_t steps)
{
    if (stage_ == Stage::read)
    {
        if (mesh_)
            steps = mesh_->read(steps, points_);
        else if (geom_->type == dConvexClass)
            add_points(*static_cast<const dxConvex *>(geom_), points_);
        else
            add_corners(*height_data_of(geom_), points_);
        if (mesh_ && !mesh_->is_done())
            return 0;
        const bool is_usable = points_.is_usable() && (!mesh_ || mesh_->is_readable());
        stage_ = is_usable ? Stage::hull : Stage::done;
    }
    if (stage_ == Stage::hull)
        steps = make_hull(steps);
    if (stage_ == Stage::surface)
    {
        steps = hull_->surface->build(steps);
        if (hull_->surface->is_ready())
            stage_ = Stage::done;
    }
    return is_done() ? steps : 0;
}

std::size_t HullMaker::make_hull(std::size_t steps)
{
    const std::size_t needed = steps_per_point * points_.count();
    const bool is_too_large = needed > steps;
    if (is_too_large && !std::exchange(has_waited_, true))
        return 0;
    hull_ = std::make_shared<DataHull>(VertexHull(is_too_large ? points_.corners() : points_.take_points()), key_);
    begin_surface();
    points_ = {};
    mesh_.reset();
    stage_ = hull_->surface ? Stage::surface : Stage::done;
    return steps - std::min(steps, needed);
}

void HullMaker::begin_surface()
{
    if (mesh_)
    {
        hull_->surface = std::make_shared<TriangleTree>(*mesh_data_of(geom_));
        hull_->least_normal = mesh_->least_normal();
        hull_->aspect = mesh_->aspect();
        hull_->has_old_box = has_old_box(geom_, points_.box());
    }
    else if (geom_->type == dHeightfieldClass)
        hull_->surface = grid_of(*height_data_of(geom_));
}

std::size_t HullMaker::bytes() const
{
    return sizeof *this + points_.bytes() + (mesh_ ? mesh_->bytes() : 0) + (hull_ ? hull_->bytes() : 0);
}
} // namespace ode_predictive_space
