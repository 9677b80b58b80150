// The triangles of a mesh in a tree of boxes. In: a point and a distance. Out: the triangles that may be within the distance.

#ifndef ODE_PREDICTIVE_SPACE_SURFACE_TRIANGLE_TREE_H
#define ODE_PREDICTIVE_SPACE_SURFACE_TRIANGLE_TREE_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include "ode_predictive_space/surface/surface.h"
#include "ode_predictive_space/surface/triangle_arrays.h"

namespace ode_predictive_space
{
/// The tree takes about 28 bytes per triangle. Corners stay in the program's arrays, which must not change while the tree is in
/// use. Lengths and points are in the mesh's frame.
class TriangleTree final : public Surface
{
public:
    /// The two children of a node are adjacent, and have larger numbers than the node.
    struct Node
    {
        Eigen::Vector3f low, high; ///< rounded outwards
        std::uint32_t first = 0;   ///< leaf: begin of its triangles in order(); otherwise its first child
        std::uint32_t end = 0;     ///< leaf: end of its triangles in order(); otherwise 0

        bool is_leaf() const { return first <= end; }

        double squared_distance(const Vector3 &point) const
        {
            double sum = 0;
            for (Eigen::Index i = 0; i < 3; ++i)
            {
                const double outside = std::max(std::max(low[i] - point[i], point[i] - high[i]), 0.0);
                sum += outside * outside;
            }
            return sum;
        }
    };

    /// A tree of all triangles, whose vertices must exist and be finite. The arrays are not read yet.
    explicit TriangleTree(const TriangleArrays &mesh);

    /// A tree of some triangles, which keep their numbers. Only their vertices must exist and be finite.
    TriangleTree(const TriangleArrays &mesh, std::vector<std::uint32_t> triangles);
    ~TriangleTree() override;

    /// Number of all triangles of the mesh, also if the tree holds only some of them.
    std::size_t count() const override { return mesh_.triangle_count; }
    TriangleCorners corners(std::uint32_t triangle) const { return mesh_.corners(triangle); }

    std::size_t build(std::size_t steps) override;
    bool is_ready() const override { return !builder_; }

    /// Calls visit(triangle number) for each triangle of the leaves whose boxes are within `distance` of the point, until visit
    /// returns false. The nearer of two children is searched first. Visits may reduce `distance`. @pre the tree is ready.
    template <typename Visit> void walk(const Vector3 &point, const double &distance, Visit visit) const;

    /// Calls enter(node number) from the root down, and visit(triangle number) in the leaves, always in the same order. If
    /// enter returns false, the subtree is skipped. @pre the tree is ready.
    template <typename Enter, typename Visit> void descend(Enter enter, Visit visit) const;

    /// The root is the first node. @pre the tree is ready.
    const std::vector<Node> &nodes() const { return nodes_; }

    const std::vector<std::uint32_t> &order() const { return order_; } ///< triangle numbers, leaf by leaf

    std::size_t bytes() const override;

private:
    class Builder;

    struct Waiting
    {
        std::uint32_t node;
        double squared_distance;
    };

    static constexpr std::size_t deepest = 96; // maximum depth, which the builder respects

    TriangleArrays mesh_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
    std::unique_ptr<Builder> builder_; // null once the tree is ready
};

template <typename Visit> void TriangleTree::walk(const Vector3 &point, const double &distance, Visit visit) const
{
    std::array<Waiting, deepest> waiting;
    std::size_t count = 0;
    waiting[count++] = {0, nodes_[0].squared_distance(point)};
    while (count > 0)
    {
        const Waiting next = waiting[--count];
        if (!(next.squared_distance <= distance * distance))
            continue;
        const Node &node = nodes_[next.node];
        if (node.is_leaf())
        {
            for (std::uint32_t i = node.first; i < node.end; ++i)
                if (!visit(order_[i]))
                    return;
            continue;
        }
        const Waiting one = {node.first, nodes_[node.first].squared_distance(point)},
                      other = {node.first + 1, nodes_[node.first + 1].squared_distance(point)};
        const bool other_first = other.squared_distance < one.squared_distance;
        waiting[count++] = other_first ? one : other;
        waiting[count++] = other_first ? other : one;
    }
}

template <typename Enter, typename Visit> void TriangleTree::descend(Enter enter, Visit visit) const
{
    std::array<std::uint32_t, deepest> waiting;
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0)
    {
        const std::uint32_t index = waiting[--count];
        if (!enter(index))
            continue;
        const Node &node = nodes_[index];
        if (node.is_leaf())
        {
            for (std::uint32_t i = node.first; i < node.end; ++i)
                visit(order_[i]);
            continue;
        }
        waiting[count++] = node.first + 1;
        waiting[count++] = node.first;
    }
}
} // namespace ode_predictive_space

#endif
