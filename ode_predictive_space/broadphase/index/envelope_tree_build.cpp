// Building trees from the top: for batches in which many boxes change at once.

#include "ode_predictive_space/broadphase/index/envelope_tree.h"

#include <algorithm>

namespace ode_predictive_space
{
class EnvelopeTree::Builder
{
public:
    Builder(EnvelopeTree &tree, const std::vector<SweptProxy> &leaves)
        : tree_(tree), leaves_(leaves.data()), centres_(leaves.size()), upper_(leaves.size())
    {
        for (std::size_t i = 0; i < leaves.size(); ++i)
        {
            const FloatBox &box = leaves[i].box;
            for (int axis = 0; axis < 3; ++axis)
                centres_[i].place[axis] = box.low[axis] + box.high[axis];
            centres_[i].leaf = static_cast<std::uint32_t>(i);
        }
    }

    void build(Index root) { build(root, centres_.data(), centres_.data() + centres_.size()); }

private:
    /// A leaf while it is sorted: its centre, times two, and its place in the list of leaves.
    struct Centre
    {
        float place[3];
        std::uint32_t leaf;
    };
    static_assert(sizeof(Centre) == 16, "moved as a whole");

    /// What the centres spread over.
    struct Spread
    {
        float low[4], high[4]; // the fourth means nothing

        Spread(const Centre *begin, const Centre *end)
        {
            Float4 least = Float4::load(begin->place), most = least;
            for (const Centre *centre = begin + 1; centre < end; ++centre)
            {
                const Float4 place = Float4::load(centre->place);
                least = min(least, place);
                most = max(most, place);
            }
            least.store(low);
            most.store(high);
        }

        float width(int axis) const { return high[axis] - low[axis]; }

        int widest() const
        {
            const int wider = width(1) > width(0) ? 1 : 0;
            return width(2) > width(wider) ? 2 : wider;
        }

        float middle(int axis) const { return 0.5f * low[axis] + 0.5f * high[axis]; }
    };

    void build(Index index, Centre *begin, Centre *end)
    {
        if (end - begin == 1)
        {
            tree_.nodes_[index].box = leaves_[begin->leaf].box;
            tree_.nodes_[index].content = static_cast<Index>(~leaves_[begin->leaf].proxy);
            tree_.adopt(index);
            return;
        }
        Centre *middle = split(begin, end);
        const Index pair = tree_.allocate_pair();
        tree_.nodes_[index].content = pair;
        tree_.adopt(index);
        build(pair, begin, middle);
        build(pair + 1, middle, end);
        tree_.nodes_[index].box = tree_.nodes_[pair].box.merged(tree_.nodes_[pair + 1].box);
    }

    // At the middle of the widest spread, or at the median where that would leave nearly all on one side: no tree gets deep.
    Centre *split(Centre *begin, Centre *end)
    {
        constexpr std::ptrdiff_t least_part = 8;
        const Spread spread(begin, end);
        const int axis = spread.widest();
        Centre *middle = partition(begin, end, axis, spread.middle(axis));
        const std::ptrdiff_t smaller = std::min(middle - begin, end - middle);
        if (smaller > 0 && least_part * smaller >= end - begin)
            return middle;
        middle = begin + (end - begin) / 2;
        std::nth_element(begin, middle, end, [this, axis](const Centre &a, const Centre &b) {
            return a.place[axis] != b.place[axis] ? a.place[axis] < b.place[axis]
                                                  : leaves_[a.leaf].proxy < leaves_[b.leaf].proxy;
        });
        return middle;
    }

    // The side of each is as good as random: store always on both sides, advance on one (branch-free).
    Centre *partition(Centre *begin, Centre *end, int axis, float at)
    {
        Centre *below = begin, *above = upper_.data();
        for (const Centre *centre = begin; centre < end; ++centre)
        {
            const Centre moved = *centre;
            const bool is_below = moved.place[axis] < at;
            *below = *above = moved;
            below += is_below;
            above += !is_below;
        }
        std::copy(upper_.data(), above, below);
        return below;
    }

    EnvelopeTree &tree_;
    const SweptProxy *leaves_;
    std::vector<Centre> centres_;
    std::vector<Centre> upper_;
};

void EnvelopeTree::build(const std::vector<SweptProxy> &leaves)
{
    clear();
    if (leaves.empty())
        return;
    for (const SweptProxy &leaf : leaves)
        make_room(leaf.proxy);
    nodes_.reserve(2 * leaves.size());
    nodes_.resize(2);
    nodes_[0].parent = none;
    Builder(*this, leaves).build(0);
}
} // namespace ode_predictive_space
