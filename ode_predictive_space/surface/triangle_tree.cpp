#include "ode_predictive_space/surface/triangle_tree.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace ode_predictive_space
{
namespace
{
using Box = Eigen::AlignedBox3d;

constexpr std::uint32_t leaf_size = 4;
constexpr std::uint32_t least_part = 16; // a side with at most a sixteenth of the triangles is too small

float rounded(double value, float towards)
{
    const auto nearest = static_cast<float>(value);
    const bool is_inside = towards < 0 ? nearest > value : nearest < value;
    return is_inside ? std::nextafter(nearest, towards) : nearest;
}

std::vector<std::uint32_t> numbers_below(std::size_t count)
{
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    return numbers;
}

Box box_of(const TriangleCorners &corners)
{
    Box box;
    for (const Vector3 &corner : corners)
        box.extend(corner);
    return box;
}
} // namespace

// Divides ranges of triangles at the middle of their extent. A step assigns one triangle to a side.
class TriangleTree::Builder
{
public:
    explicit Builder(TriangleTree &tree) : tree_(tree)
    {
        tree_.nodes_.reserve(tree_.order_.size() / 4 * 3 + 8); // enough for most meshes: no step then moves nodes
        tree_.nodes_.resize(1);
        current_.range.end = static_cast<std::uint32_t>(tree_.order_.size());
        current_.divides = false;
    }

    bool step()
    {
        if (current_.next == current_.range.end && !finish_pass())
            return false;
        const std::uint32_t place = current_.next++;
        std::uint32_t &triangle = tree_.order_[place];
        const Box box = box_of(tree_.corners(triangle));
        if (!goes_left(place, box))
        {
            current_.right.extend(box);
            return true;
        }
        current_.left.extend(box);
        std::swap(triangle, tree_.order_[current_.border++]);
        return true;
    }

private:
    struct Extent
    {
        Box box, middles; // around triangles, and around the centres of their boxes

        void extend(const Box &triangle)
        {
            box.extend(triangle);
            middles.extend(triangle.center());
        }
    };

    // Triangles below a node, as a range of order_.
    struct Range
    {
        std::uint32_t begin = 0, end = 0, node = 0, depth = 0;
        Extent extent;

        std::uint32_t count() const { return end - begin; }
    };

    // One pass over a range. Triangles of the left side are swapped to before the border.
    struct Pass
    {
        Range range;
        bool divides = true; // false: the pass only measures, with all triangles on the left
        bool in_halves = false;
        Eigen::Index axis = 0;
        double middle = 0;
        std::uint32_t next = 0, border = 0;
        Extent left, right;
    };

    bool goes_left(std::uint32_t place, const Box &triangle) const
    {
        if (!current_.divides)
            return true;
        if (current_.in_halves)
            return place - current_.range.begin < current_.range.count() / 2;
        return triangle.center()[current_.axis] < current_.middle;
    }

    bool finish_pass()
    {
        if (!current_.divides)
            add({current_.range.begin, current_.range.end, 0, 0, current_.left});
        else if (is_lopsided())
        {
            begin_pass(current_.range, true);
            return true;
        }
        else
            add_children();
        if (waiting_.empty())
            return false;
        const Range range = waiting_.back();
        waiting_.pop_back();
        begin_pass(range, range.depth > tree_.deepest / 3);
        return true;
    }

    bool is_lopsided() const
    {
        const Range &range = current_.range;
        const std::uint32_t left = current_.border - range.begin, right = range.end - current_.border;
        return !current_.in_halves && std::min(left, right) <= range.count() / least_part;
    }

    void begin_pass(Range range, bool in_halves)
    {
        current_ = {};
        current_.range = range;
        current_.in_halves = in_halves;
        range.extent.middles.sizes().maxCoeff(&current_.axis);
        current_.middle = range.extent.middles.center()[current_.axis];
        current_.next = current_.border = range.begin;
    }

    void add_children()
    {
        const Range range = current_.range;
        const auto first = static_cast<std::uint32_t>(tree_.nodes_.size());
        tree_.nodes_.resize(first + 2);
        tree_.nodes_[range.node].first = first;
        add({range.begin, current_.border, first, range.depth + 1, current_.left});
        add({current_.border, range.end, first + 1, range.depth + 1, current_.right});
    }

    // Fills the node of a range. A small range becomes a leaf; only the root can be an empty one.
    void add(const Range &range)
    {
        Node &node = tree_.nodes_[range.node];
        for (Eigen::Index i = 0; i < 3; ++i)
        {
            node.low[i] = rounded(range.extent.box.min()[i], -std::numeric_limits<float>::infinity());
            node.high[i] = rounded(range.extent.box.max()[i], std::numeric_limits<float>::infinity());
        }
        if (range.count() > leaf_size)
        {
            waiting_.push_back(range);
            return;
        }
        node.first = range.begin;
        node.end = range.end;
    }

    TriangleTree &tree_;
    Pass current_;
    std::vector<Range> waiting_;
};

TriangleTree::TriangleTree(const TriangleArrays &mesh) : TriangleTree(mesh, numbers_below(mesh.triangle_count)) {}

TriangleTree::TriangleTree(const TriangleArrays &mesh, std::vector<std::uint32_t> triangles)
    : mesh_(mesh), order_(std::move(triangles)), builder_(std::make_unique<Builder>(*this))
{}

TriangleTree::~TriangleTree() = default;

std::size_t TriangleTree::build(std::size_t steps)
{
    while (steps > 0 && builder_)
    {
        --steps;
        if (!builder_->step())
            builder_.reset();
    }
    return steps;
}

std::size_t TriangleTree::bytes() const
{
    return sizeof *this + order_.capacity() * sizeof order_[0] + nodes_.capacity() * sizeof nodes_[0];
}
} // namespace ode_predictive_space
