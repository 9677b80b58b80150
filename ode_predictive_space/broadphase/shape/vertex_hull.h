// The convex hull of many points. In: a direction. Out: the farthest of the points.

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
/// How far a convex hull reaches in a direction is how far its points reach. So no faces of the hull are needed, and no point has
/// to be left out: points that lie near each other are put into a block, blocks into a tree of boxes, and of the blocks only those
/// are looked at whose boxes reach far enough.
///
/// All coordinates are relative to centre().
class VertexHull
{
public:
    /// @param points finite; at least one. Equal points are kept once.
    explicit VertexHull(std::vector<Vector3> points);

    /// The middle of the bounding box of the points, in their coordinates.
    const Vector3 &centre() const { return centre_; }
    /// Of that box.
    const Vector3 &half_sides() const { return half_sides_; }

    /// The largest scalar product of a direction, of any length, with a point.
    double reach(const Vector3 &direction) const { return find(direction).reach; }
    /// About the number of blocks that are visited. It grows as the root of all (measured with spheres and tori).
    float work_of_reach() const { return std::sqrt(static_cast<float>(blocks_.size())); }
    /// The number of points and of triangles, or about.
    std::size_t elements() const { return block_size * blocks_.size() + (surface ? surface->count() : 0); }
    /// That point.
    Vector3 farthest(const Vector3 &direction) const;

    /// The triangles of a mesh or the heights of a heightfield, in the coordinates of the points that were given; ready. Null for other
    /// hulls.
    std::shared_ptr<Surface> surface;

    std::uint32_t number = 0; ///< of the hull, among all that were made for a scene; from 1 on

    std::size_t bytes() const;

private:
    static constexpr int block_size = 8;
    using Block = Eigen::Array<double, block_size, 3>; // a point in each row; the last one again in rows that are left
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

    // A tree over the blocks from `begin` to `end`: its root is in place `node` of bounds_, the left half follows, then the right.
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
    std::vector<Bounds> bounds_; // of the ranges of blocks
};
} // namespace ode_predictive_space

#endif
