// Makes the hull of a geom's data, in steps. In: a convex, mesh or heightfield. Out: its hull, with the surface built.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_HULL_MAKER_H
#define ODE_PREDICTIVE_SPACE_SPACE_HULL_MAKER_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "ode_predictive_space/broadphase/shape/vertex_hull.h"
#include "ode_predictive_space/space/ode_internals.h"
#include "ode_predictive_space/surface/triangle_arrays.h"

namespace ode_predictive_space
{
/// Beyond this, squares of lengths may overflow.
constexpr double largest_length = 1e100;

/// Divides two lengths. The result is infinite when the second is 0; the division is then left out, as programs may trap it.
inline double quotient(double one, double other)
{
    return other > 0 ? one / other : std::numeric_limits<double>::infinity();
}

/// Where a geom's data are and how many: pointers, counts and scales. All zero for geoms that are not made of data, or without any.
using DataKey = std::array<std::uint64_t, 9>;
DataKey key_of(dxGeom *geom);

/// The hull of a geom's data.
struct DataHull : VertexHull
{
    DataHull(VertexHull &&points, const DataKey &data) : VertexHull(std::move(points)), key(data) {}

    DataKey key;
    /// Twice the area of the smallest triangle of a mesh; infinite for a convex.
    double least_normal = std::numeric_limits<double>::infinity();
    /// The largest aspect ratio of a triangle of a mesh: its longest side by the height on it. Of a convex, 1.
    double aspect = 1;
    bool outdated = false; ///< the data have been changed in place
    bool has_old_box =
        false; ///< ODE's box of a mesh's data does not fit: they were changed in place, and not built again
};

/// The points that hulls are made of: all, or when these are too many, the corners of the box around them.
class PointCloud
{
public:
    void add(const Vector3 &point);

    const Eigen::AlignedBox3d &box() const { return box_; }
    /// Not empty, and all are finite and near enough for squares of lengths?
    bool is_usable() const { return is_usable_ && !box_.isEmpty(); }
    std::size_t count() const { return points_.size(); }

    std::vector<Vector3> take_points();
    std::vector<Vector3> corners() const;
    std::size_t bytes() const;

private:
    std::vector<Vector3> points_; // one more than allowed when there are too many
    Eigen::AlignedBox3d box_;
    bool is_usable_ = true;
};

/// Reads the vertices that the triangles of a mesh have, and measures the triangles.
class MeshReader
{
public:
    explicit MeshReader(const TriangleArrays &mesh) : mesh_(mesh), used_(mesh.vertex_count) {}

    /// @return the steps that are left; none when there is more to read.
    std::size_t read(std::size_t steps, PointCloud &points);
    bool is_done() const { return !is_readable_ || (triangle_ == mesh_.triangle_count && vertex_ == used_.size()); }

    /// Do all triangles have vertices that are there?
    bool is_readable() const { return is_readable_; }
    double least_normal() const { return least_normal_; }
    double aspect() const { return aspect_; }
    std::size_t bytes() const { return used_.size() / 8; }

private:
    void read_triangle();

    TriangleArrays mesh_;
    std::vector<bool> used_; // vertices
    std::uint32_t triangle_ = 0, vertex_ = 0;
    bool is_readable_ = true;
    double least_normal_ = std::numeric_limits<double>::infinity(), aspect_ = 1;
};

/// Works in slices, as large as the caller likes, so that no tick waits for large data. They must not change meanwhile.
class HullMaker
{
public:
    static constexpr std::size_t all_steps = std::numeric_limits<std::size_t>::max();

    /// @param key of the geom, which has data.
    HullMaker(dxGeom *geom, const DataKey &key);

    /// Goes on, for so many steps; each takes some 20 ns. When its points alone would take more, a hull is that of the box around them.
    ///
    /// @return the steps that are left; none when it is not done.
    std::size_t go_on(std::size_t steps);
    bool is_done() const { return stage_ == Stage::done; }

    /// None of data that cannot be read, and of points that are not finite or too far away for squares of lengths.
    const std::shared_ptr<DataHull> &hull() const { return hull_; }
    const DataKey &key() const { return key_; }
    std::size_t bytes() const;

private:
    enum class Stage
    {
        read, ///< points and triangles
        hull,
        surface,
        done
    };

    void read_points();
    void finish_reading();
    std::size_t make_hull(std::size_t steps);
    void begin_surface();

    dxGeom *geom_;
    DataKey key_;
    Stage stage_ = Stage::read;
    PointCloud points_;
    std::optional<MeshReader> mesh_;
    bool has_waited_ = false; // for a slice that is large enough for the points
    std::shared_ptr<DataHull> hull_;
};
} // namespace ode_predictive_space

#endif
