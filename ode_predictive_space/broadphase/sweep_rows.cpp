// Comparing boxes that are in their order: each with the rows of others that it can meet.

#include "ode_predictive_space/broadphase/sweep.h"

#include <algorithm>

namespace ode_predictive_space
{
// The boxes in their order. Where their arrays are is known not to change when a pair is stored.
//
// Places only tell who may overlap: along the axis of the order a row ends at the first box that begins too late, and up to
// seven behind it are compared, too; across it places are coarser than coordinates. Who seems to overlap is looked at closely.
class Sweep::Rows
{
public:
    Rows(const Sweep &sweep, const Items &items, const Layout &layout)
        : items_(items.data()), order_(sweep.order_.data()), keys_(sweep.keys_.data()),
          low_y_(sweep.columns_.low_y.data()), high_y_(sweep.columns_.high_y.data()),
          low_z_(sweep.columns_.low_z.data()), high_z_(sweep.columns_.high_z.data()), slab_bits_(layout.slab_bits)
    {}

#if defined(__SSE2__)
    // Two boxes beside each other, the i-th and the next, meet nearly the same others: these are loaded once for both, and
    // both rows end in one branch that is mispredicted: at the keys greater than `end`, which is that of the farther of both.
    // What lies beyond the end of the nearer is apart from it.
    void compare_two(std::size_t i, std::uint32_t end, Pairs &pairs) const
    {
        const Probe first(*this, i), second(*this, i + 1);
        int itself = 1 << row; // the first that the second is compared with
        for (std::size_t j = i + 1; keys_[j] <= end; j += row)
        {
            const Eight eight(*this, j);
            const int apart = _mm_movemask_epi8(_mm_packs_epi16(first.apart(eight), second.apart(eight))) | itself;
            itself = 0;
            for (int close = ~apart & 0xffff; close; close &= close - 1)
            {
                const auto bit = static_cast<std::size_t>(__builtin_ctz(static_cast<unsigned>(close)));
                meet(i + bit / row, j + bit % row, pairs);
            }
        }
    }
#endif

    // The i-th with all behind it whose keys are not greater than `end`.
    void compare_one(std::size_t i, std::uint32_t end, Pairs &pairs) const
    {
        for (std::size_t j = i + 1; keys_[j] <= end; ++j)
            meet(i, j, pairs);
    }

private:
    const SweptProxy &item(std::size_t i) const
    {
        return items_[order_[i] & item_mask];
    }

    // Each pair is reported once: in the slab in which the later of both begins.
    void meet(std::size_t i, std::size_t j, Pairs &pairs) const
    {
        const auto slab = static_cast<std::uint32_t>(std::max(low_y_[i], low_y_[j]) >> slab_bits_);
        if (keys_[i] >> 16 == slab && keys_[j] >> 16 == slab && item(i).box.overlaps(item(j).box))
            pairs.push_back(in_order(item(i).proxy, item(j).proxy));
    }

#if defined(__SSE2__)
    // The sides of eight boxes.
    struct Eight
    {
        __m128i low_y, high_y, low_z, high_z;

        Eight(const Rows &rows, std::size_t i)
            : low_y(load(rows.low_y_ + i)), high_y(load(rows.high_y_ + i)), low_z(load(rows.low_z_ + i)),
              high_z(load(rows.high_z_ + i))
        {}

    private:
        static __m128i load(const std::int16_t *side)
        {
            return _mm_loadu_si128(reinterpret_cast<const __m128i *>(side));
        }
    };

    // The sides of one box, eight times.
    class Probe
    {
    public:
        Probe(const Rows &rows, std::size_t i)
            : y_begin_(_mm_set1_epi16(rows.low_y_[i])), y_end_(_mm_set1_epi16(rows.high_y_[i])),
              z_begin_(_mm_set1_epi16(rows.low_z_[i])), z_end_(_mm_set1_epi16(rows.high_z_[i]))
        {}

        __m128i apart(const Eight &boxes) const
        {
            const __m128i y =
                _mm_or_si128(_mm_cmpgt_epi16(boxes.low_y, y_end_), _mm_cmpgt_epi16(y_begin_, boxes.high_y));
            const __m128i z =
                _mm_or_si128(_mm_cmpgt_epi16(boxes.low_z, z_end_), _mm_cmpgt_epi16(z_begin_, boxes.high_z));
            return _mm_or_si128(y, z);
        }

    private:
        __m128i y_begin_, y_end_, z_begin_, z_end_;
    };
#endif

    const SweptProxy *items_;
    const std::uint64_t *order_;
    const std::uint32_t *keys_;
    const std::int16_t *low_y_, *high_y_, *low_z_, *high_z_;
    int slab_bits_;
};

void Sweep::sweep_rows(const Items &items, const Layout &layout, Pairs &pairs) const
{
    const Rows rows(*this, items, layout);
    std::size_t i = 0;
#if defined(__SSE2__)
    for (; i + 1 < ends_.size(); i += 2)
        rows.compare_two(i, std::max(ends_[i], ends_[i + 1]), pairs);
#endif
    for (; i < ends_.size(); ++i)
        rows.compare_one(i, ends_[i], pairs);
}
} // namespace ode_predictive_space
