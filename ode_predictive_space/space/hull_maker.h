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

#include "ode_predictive_space/broadphase/base/memory.h"
#include "ode_predictive_space/broadphase/shape/vertex_hull.h"
#include "ode_predictive_space/ode/internals.h"
#include "ode_predictive_space/surface/triangle_arrays.h"

namespace ode_predictive_space
{
/// Squares of larger lengths may overflow.
constexpr double largest_length = 1e100;

/// The quotient of two lengths; infinite if `other` is 0, without a division, because programs may trap one.
inline double quotient(double one, double other)
{
    return other > 0 ? one / other : std::numeric_limits<double>::infinity();
}

/// The identity of a geom's data: addresses, counts and scales. All zero for a geom without data.
using DataKey = std::array<std::uint64_t, 9>;
DataKey key_of(dxGeom *geom);

struct DataHull : VertexHull
{
    DataHull(VertexHull &&points, const DataKey &data) : VertexHull(std::move(points)), key(data) {}

    DataKey key;
    /// Twice the area of the smallest triangle of a mesh; infinite for other data.
    double least_normal = std::numeric_limits<double>::infinity();
    /// The largest aspect ratio of a mesh's triangles: longest side by the height on it; 1 for other data.
    double aspect = 1;
    bool outdated = false; ///< the data have been changed in place
    bool has_old_box =
        false; ///< ODE's box of a mesh exceeds its vertices: the data were changed in place, and not built again
};

/// The points of a hull: all or, if they are too many, the corners of their box.
class PointCloud
{
public:
    void add(const Vector3 &point);

    const Eigen::AlignedBox3d &box() const { return box_; }
    /// Are there points, and is each coordinate within largest_length?
    bool is_usable() const { return is_usable_ && !box_.isEmpty(); }
    std::size_t count() const { return points_.size(); }

    std::vector<Vector3> take_points();
    std::vector<Vector3> corners() const;
    std::size_t bytes() const { return bytes_of(points_); }

private:
    std::vector<Vector3> points_; // if there are too many, one more than allowed
    Eigen::AlignedBox3d box_;
    bool is_usable_ = true;
};

/// Reads the vertices that the triangles of a mesh use.
class MeshReader
{
public:
    explicit MeshReader(const TriangleArrays &mesh) : mesh_(mesh), used_(mesh.vertex_count) {}

    /// @return the unused steps; 0 if there is more to read.
    std::size_t read(std::size_t steps, PointCloud &points);
    bool is_done() const { return !is_readable_ || (triangle_ == mesh_.triangle_count && vertex_ == used_.size()); }

    /// The vertices of all triangles exist, as far as they were read.
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

/// Works in slices of any size, so that no tick waits for large data. The data must not change meanwhile.
class HullMaker
{
public:
    static constexpr std::size_t all_steps = std::numeric_limits<std::size_t>::max();

    /// @param key key_of(geom). @pre the geom has data.
    HullMaker(dxGeom *geom, const DataKey &key);

    /// Continues for up to `steps` steps of about 20 ns each. If a whole slice is too small for the points, the hull is that of
    /// their box. @return the unused steps; 0 if the work is not done.
    std::size_t go_on(std::size_t steps);
    bool is_done() const { return stage_ == Stage::done; }

    /// Null for data that cannot be read, and for points that are not usable. @pre is_done().
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

    std::size_t make_hull(std::size_t steps);
    void begin_surface();

    dxGeom *geom_;
    DataKey key_;
    Stage stage_ = Stage::read;
    PointCloud points_;
    std::optional<MeshReader> mesh_;
    bool has_waited_ = false; // for a new slice, which may be large enough for the points
    std::shared_ptr<DataHull> hull_;
};
} // namespace ode_predictive_space

#endif
