// The sweep: compares each box with the row of boxes after it that may overlap it.

#include <algorithm>

#include "ode_predictive_space/broadphase/index/sort_and_sweep.h"

namespace ode_predictive_space
{
// The boxes in the order of their keys. Array addresses are copied, so that they need no reload after each stored pair. Places
// only give candidates, because they are coarser than coordinates and because rows of eight may reach beyond the last box that
// begins in time. Candidates are compared exactly.
class SortAndSweep::Rows
{
public:
    Rows(SortAndSweep &sweep, const Items &items, const Layout &layout)
        : items_(items.data()), order_(sweep.order_.data()), keys_(sweep.keys_.data()), low_y_(sweep.low_y_.data()),
          high_y_(sweep.high_y_.data()), low_z_(sweep.low_z_.data()), high_z_(sweep.high_z_.data()),
          slab_bits_(layout.slab_bits)
    {}

    // Compares the i-th box and the next one with the boxes whose keys are at most `end`, the farther of both ends. Neighbours
    // meet nearly the same boxes, which are loaded once for both, and both rows end in one mispredicted branch. The exact
    // comparison rejects boxes beyond the nearer end.
    std::size_t compare_two(std::size_t i, std::uint32_t end, Pairs &pairs) const
    {
        const Probe first(*this, i), second(*this, i + 1);
        std::size_t comparisons = 0;
        unsigned itself = 1u << row; // excludes the comparison of the second box with itself
        for (std::size_t j = i + 1; keys_[j] <= end; j += row)
        {
            const Eight eight(*this, j);
            const unsigned apart = bits_of(first.apart(eight), second.apart(eight)) | itself;
            itself = 0;
            for (unsigned close = ~apart & 0xffffu; close; close &= close - 1, ++comparisons)
            {
                const auto bit = static_cast<std::size_t>(__builtin_ctz(close));
                compare_exactly(i + bit / row, j + bit % row, pairs);
            }
        }
        return comparisons;
    }

    std::size_t compare_one(std::size_t i, std::uint32_t end, Pairs &pairs) const
    {
        std::size_t j = i + 1;
        for (; keys_[j] <= end; ++j)
            compare_exactly(i, j, pairs);
        return j - i - 1;
    }

private:
    const SweptProxy &item(std::size_t i) const { return items_[order_[i] & item_mask]; }

    // Reports each pair once, in the slab in which the later box begins.
    void compare_exactly(std::size_t i, std::size_t j, Pairs &pairs) const
    {
        const auto slab = static_cast<std::uint32_t>(std::max(low_y_[i], low_y_[j]) >> slab_bits_);
        if (keys_[i] >> 16 == slab && keys_[j] >> 16 == slab && item(i).box.overlaps(item(j).box))
            pairs.push_back(in_order(item(i).proxy, item(j).proxy));
    }

    struct Eight
    {
        Short8 low_y, high_y, low_z, high_z;

        Eight(const Rows &rows, std::size_t i)
            : low_y(Short8::load(rows.low_y_ + i)), high_y(Short8::load(rows.high_y_ + i)),
              low_z(Short8::load(rows.low_z_ + i)), high_z(Short8::load(rows.high_z_ + i))
        {}
    };

    class Probe
    {
    public:
        Probe(const Rows &rows, std::size_t i)
            : low_y_(Short8::all(rows.low_y_[i])), high_y_(Short8::all(rows.high_y_[i])),
              low_z_(Short8::all(rows.low_z_[i])), high_z_(Short8::all(rows.high_z_[i]))
        {}

        Short8 apart(const Eight &boxes) const
        {
            return ((boxes.low_y > high_y_) | (low_y_ > boxes.high_y)) |
                   ((boxes.low_z > high_z_) | (low_z_ > boxes.high_z));
        }

    private:
        Short8 low_y_, high_y_, low_z_, high_z_;
    };

    const SweptProxy *items_;
    const std::uint64_t *order_;
    const std::uint32_t *keys_;
    const std::int16_t *low_y_, *high_y_, *low_z_, *high_z_;
    int slab_bits_;
};

std::size_t SortAndSweep::sweep_rows(const Items &items, const Layout &layout, Pairs &pairs)
{
    const Rows rows(*this, items, layout);
    std::size_t comparisons = 0, i = 0;
    for (; i + 1 < ends_.size(); i += 2)
        comparisons += rows.compare_two(i, std::max(ends_[i], ends_[i + 1]), pairs);
    for (; i < ends_.size(); ++i)
        comparisons += rows.compare_one(i, ends_[i], pairs);
    return comparisons;
}
} // namespace ode_predictive_space
