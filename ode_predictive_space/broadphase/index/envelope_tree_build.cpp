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

    Index build()
    {
        std::ptrdiff_t room_below = 1; // leaves that a node below has room for
        while (width * room_below < static_cast<std::ptrdiff_t>(centres_.size()))
            room_below *= width;
        return build(centres_.data(), centres_.data() + centres_.size(), room_below);
    }

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

    Index build(Centre *begin, Centre *end, std::ptrdiff_t room_below)
    {
        const Index index = tree_.allocate();
        Centre *const middle = split(begin, end, room_below, 2 * room_below);
        for (const auto &[from, to] : {std::pair(begin, middle), std::pair(middle, end)})
        {
            Centre *const quarter = split(from, to, room_below, room_below);
            add_part(index, from, quarter, room_below);
            add_part(index, quarter, to, room_below);
        }
        return index;
    }

    void add_part(Index index, Centre *begin, Centre *end, std::ptrdiff_t room)
    {
        if (begin == end)
            return;
        if (room == 1)
            return tree_.add(index, {leaves_[begin->leaf].box, static_cast<Index>(~leaves_[begin->leaf].proxy)});
        const Index below = build(begin, end, room / width);
        tree_.add(index, {tree_.nodes_[below].boxes.merged(), below});
    }

    // None when all have room in one node below. At the middle of the widest spread, or at the median where that would leave nearly all on
    // one side, or more than there is room for.
    Centre *split(Centre *begin, Centre *end, std::ptrdiff_t room_below, std::ptrdiff_t most)
    {
        const std::ptrdiff_t count = end - begin;
        if (count <= room_below)
            return end;
        constexpr std::ptrdiff_t least_part = 8;
        const Spread spread(begin, end);
        const int axis = spread.widest();
        Centre *middle = partition(begin, end, axis, spread.middle(axis));
        const std::ptrdiff_t smaller = std::min(middle - begin, end - middle);
        if (smaller > 0 && least_part * smaller >= count && count - smaller <= most)
            return middle;
        middle = begin + count / 2;
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
    root_ = Builder(*this, leaves).build();
}
} // namespace ode_predictive_space
