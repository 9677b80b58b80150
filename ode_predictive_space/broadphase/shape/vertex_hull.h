// The convex hull of many points. In: a direction. Out: the farthest point.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_VERTEX_HULL_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SHAPE_VERTEX_HULL_H

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "ode_predictive_space/prediction/path.h"
#include "ode_predictive_space/surface/surface.h"

namespace ode_predictive_space
{
/// The reach of a hull is that of its points, so its faces are not needed. Neighbouring points form blocks, blocks form a tree
/// of boxes, and a search visits only blocks whose boxes reach far enough. Coordinates are relative to centre().
class VertexHull
{
public:
    /// @param points finite; at least one. Equal points are kept once.
    explicit VertexHull(std::vector<Vector3> points);

    /// The middle and the half sides of the points' bounding box, in the coordinates of the constructor.
    const Vector3 &centre() const { return centre_; }
    const Vector3 &half_sides() const { return half_sides_; }

    /// The largest scalar product of a direction, of any length, with a point.
    double reach(const Vector3 &direction) const { return find(direction).reach; }
    /// Approximate number of visited blocks. It grows as the square root of all (measured with spheres and tori).
    float work_of_reach() const { return std::sqrt(static_cast<float>(blocks_.size())); }
    std::size_t elements() const { return block_size * blocks_.size() + (surface ? surface->count() : 0); }
    Vector3 farthest(const Vector3 &direction) const;

    /// The built surface of a mesh or heightfield, in the coordinates of the constructor; null for other hulls.
    std::shared_ptr<Surface> surface;

    std::uint32_t number = 0; ///< unique among the hulls of a scene, from 1 on

    std::size_t bytes() const;

private:
    static constexpr int block_size = 8;
    using Block = Eigen::Array<double, block_size, 3>; // a point per row; spare rows repeat the last point
    struct Bounds
    {
        Vector3 centre, half_sides;
        double reach(const Vector3 &direction, const Vector3 &absolute) const
        {
            return centre.dot(direction) + half_sides.dot(absolute);
        }
    };
    struct Farthest
    {
        double reach;
        std::size_t block;
    };

    // A tree over blocks `begin` to `end`. Its root is in place `node` of bounds_; the left half follows, then the right.
    struct Range
    {
        std::size_t node, begin, end;
        std::size_t middle() const { return begin + (end - begin) / 2; }
        Range left() const { return {node + 1, begin, middle()}; }
        Range right() const { return {node + 2 * (middle() - begin), middle(), end}; }
        bool is_leaf() const { return end - begin == 1; }
    };

    Range root() const { return {0, 0, blocks_.size()}; }
    void build(Vector3 *begin, Vector3 *end, const Range &range);
    Farthest find(const Vector3 &direction) const;
    void search(const Range &range, const Vector3 &direction, const Vector3 &absolute, Farthest &best) const;

    Vector3 centre_ = Vector3::Zero(), half_sides_ = Vector3::Zero();
    std::vector<Block> blocks_;
    std::vector<Bounds> bounds_; // indexed by Range::node
};
} // namespace ode_predictive_space

#endif
