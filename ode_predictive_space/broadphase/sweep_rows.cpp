// Comparing boxes that are in their order: each with the rows of others that it can meet.

#include "ode_predictive_space/broadphase/sweep.h"

#include <algorithm>

namespace ode_predictive_space
{
namespace
{
constexpr std::uint32_t one_strip = 1u << 16;
} // namespace

// Where the sides of boxes are, in their order: known not to change when a pair is stored.
struct Sweep::Columns
{
    const std::uint32_t *keys;
    const float *low_x, *low_y, *low_z, *high_x, *high_y, *high_z;

    explicit Columns(const Sweep &sweep)
        : keys(sweep.keys_.data()), low_x(sweep.sides_.low[0].data()), low_y(sweep.sides_.low[1].data()),
          low_z(sweep.sides_.low[2].data()), high_x(sweep.sides_.high[0].data()), high_y(sweep.sides_.high[1].data()),
          high_z(sweep.sides_.high[2].data())
    {}
};

#if defined(__SSE2__)
// The sides of four boxes by which they are compared with one that does not begin behind them.
struct Sweep::Four
{
    __m128 low_x, low_y, low_z, high_y, high_z;

    Four(const Columns &columns, std::size_t i)
        : low_x(_mm_loadu_ps(columns.low_x + i)), low_y(_mm_loadu_ps(columns.low_y + i)),
          low_z(_mm_loadu_ps(columns.low_z + i)), high_y(_mm_loadu_ps(columns.high_y + i)),
          high_z(_mm_loadu_ps(columns.high_z + i))
    {}
};

class Sweep::FourfoldProbe
{
public:
    explicit FourfoldProbe(const Probe &box)
        : x_end_(_mm_set1_ps(box.high[0])), y_end_(_mm_set1_ps(box.high[1])), z_end_(_mm_set1_ps(box.high[2])),
          y_begin_(_mm_set1_ps(box.low[1])), z_begin_(_mm_set1_ps(box.low[2]))
    {}

    __m128 apart(const Four &boxes) const
    {
        __m128 apart = _mm_cmpgt_ps(boxes.low_x, x_end_);
        apart = _mm_or_ps(apart, _mm_cmpgt_ps(boxes.low_y, y_end_));
        apart = _mm_or_ps(apart, _mm_cmpgt_ps(boxes.low_z, z_end_));
        apart = _mm_or_ps(apart, _mm_cmplt_ps(boxes.high_y, y_begin_));
        return _mm_or_ps(apart, _mm_cmplt_ps(boxes.high_z, z_begin_));
    }

private:
    __m128 x_end_, y_end_, z_end_, y_begin_, z_begin_;
};
#endif

// Compares with those from `begin` on whose keys are not greater than `end`.
inline void Sweep::compare_from(std::size_t begin, std::uint32_t end, const Probe &probe,
                                std::vector<CandidatePair> &pairs) const
{
    const Columns columns(*this);
    auto met = [&](std::size_t j) {
        // The order is by places, which are coarser than coordinates.
        if (probe.low[0] <= columns.high_x[j])
            pairs.push_back(in_order(probe.proxy, proxies_[j]));
    };
#if defined(__SSE2__)
    const __m128i last = _mm_set1_epi32(static_cast<int>(end));
    const FourfoldProbe box(probe);
    for (std::size_t j = begin; columns.keys[j] <= end; j += 4)
    {
        const __m128i these = _mm_loadu_si128(reinterpret_cast<const __m128i *>(columns.keys + j));
        const __m128 beyond = _mm_castsi128_ps(_mm_cmpgt_epi32(these, last));
        const __m128 apart = _mm_or_ps(box.apart(Four(columns, j)), beyond);
        for (int close = ~_mm_movemask_ps(apart) & 15; close; close &= close - 1)
            met(j + static_cast<std::size_t>(__builtin_ctz(static_cast<unsigned>(close))));
    }
#else
    for (std::size_t j = begin; columns.keys[j] <= end; ++j)
        if (columns.low_x[j] <= probe.high[0] && columns.low_y[j] <= probe.high[1] &&
            columns.low_z[j] <= probe.high[2] && probe.low[1] <= columns.high_y[j] && probe.low[2] <= columns.high_z[j])
            met(j);
#endif
}

Sweep::Probe Sweep::probe(std::size_t i) const
{
    return {proxies_[i],
            {sides_.low[0][i], sides_.low[1][i], sides_.low[2][i]},
            {sides_.high[0][i], sides_.high[1][i], sides_.high[2][i]}};
}

#if defined(__SSE2__)
// Two boxes beside each other in the same strip meet nearly the same others: these are loaded once for both, and both rows
// end in one branch that is mispredicted. What lies beyond the end of one of them in its strip is apart from it along the axis.
class Sweep::TwoProbes
{
public:
    TwoProbes(const Sweep &sweep, std::size_t first)
        : sweep_(sweep), first_index_(first), first_(sweep.probe(first)), second_(sweep.probe(first + 1))
    {}

    static constexpr std::size_t most_between = 4;

    // Compares the first with those from `begin` on, the second with those from `second_begin` on, which are at most
    // most_between behind it, whose keys are not greater than `end`.
    template <bool single_strip>
    void compare_from(std::size_t begin, std::size_t second_begin, std::uint32_t end,
                      std::vector<CandidatePair> &pairs) const
    {
        const Columns columns(sweep_);
        const __m128i last = _mm_set1_epi32(static_cast<int>(end));
        int not_of_second = (1 << (second_begin - begin)) - 1;
        for (std::size_t j = begin; columns.keys[j] <= end; j += 4)
        {
            const Four four(columns, j);
            const int apart_from_second = _mm_movemask_ps(second_.apart(four)) | not_of_second;
            int apart = _mm_movemask_ps(first_.apart(four)) | apart_from_second << 4;
            not_of_second = 0;
            if (!single_strip)
            {
                const __m128i these = _mm_loadu_si128(reinterpret_cast<const __m128i *>(columns.keys + j));
                apart |= _mm_movemask_ps(_mm_castsi128_ps(_mm_cmpgt_epi32(these, last))) * 17;
            }
            for (int close = ~apart & 255; close; close &= close - 1)
            {
                const int bit = __builtin_ctz(static_cast<unsigned>(close));
                const std::size_t one = first_index_ + static_cast<std::size_t>(bit >> 2);
                const std::size_t other = j + static_cast<std::size_t>(bit & 3);
                // The order is by places, which are coarser than coordinates.
                if (columns.low_x[one] <= columns.high_x[other])
                    pairs.push_back(in_order(sweep_.proxies_[one], sweep_.proxies_[other]));
            }
        }
    }

private:
    const Sweep &sweep_;
    std::size_t first_index_;
    FourfoldProbe first_, second_;
};
#endif

void Sweep::sweep_single_strip(std::vector<CandidatePair> &pairs) const
{
#if defined(__SSE2__)
    for (std::size_t i = 0; i + 1 < ends_.size(); i += 2)
        TwoProbes(*this, i).compare_from<true>(i + 1, i + 2, std::max(ends_[i], ends_[i + 1]), pairs);
#else
    for (std::size_t i = 0; i < ends_.size(); ++i)
        compare_from(i + 1, ends_[i], probe(i), pairs);
#endif
}

// Where the rows of a box begin in the strips beside its own. Boxes come in their order.
class Sweep::RowsBeside
{
public:
    explicit RowsBeside(const std::vector<std::uint32_t> &keys) : keys_(keys) {}

    void advance_to(std::uint32_t key)
    {
        while (keys_[after] < key + one_strip)
            ++after;
        while (keys_[before] <= key - one_strip)
            ++before;
    }

    std::size_t before = 0, after = 0;

private:
    const std::vector<std::uint32_t> &keys_;
};

// What begins at the same place or behind it, in the box's own strip and in the next, and what begins behind it in the strip
// before: so each pair is found once. Keys beyond a strip are those of the next; no search has to ask for its end.
void Sweep::sweep_strips(std::vector<CandidatePair> &pairs) const
{
    RowsBeside rows(keys_);
    for (std::size_t i = 0; i < ends_.size(); ++i)
    {
        rows.advance_to(keys_[i]);
        const RowsBeside own = rows;
#if defined(__SSE2__)
        const bool next_is_beside = i + 1 < ends_.size() && keys_[i] >> 16 == keys_[i + 1] >> 16;
        if (next_is_beside)
            rows.advance_to(keys_[i + 1]);
        if (next_is_beside && std::max(rows.before - own.before, rows.after - own.after) <= TwoProbes::most_between)
        {
            const TwoProbes both(*this, i);
            const std::uint32_t end = std::max(ends_[i], ends_[i + 1]);
            both.compare_from<false>(i + 1, i + 2, end, pairs);
            both.compare_from<false>(own.after, rows.after, end + one_strip, pairs);
            both.compare_from<false>(own.before, rows.before, end - one_strip, pairs);
            ++i;
            continue;
        }
#endif
        const Probe self = probe(i);
        compare_from(i + 1, ends_[i], self, pairs);
        compare_from(own.after, ends_[i] + one_strip, self, pairs);
        compare_from(own.before, ends_[i] - one_strip, self, pairs);
    }
}

// All that a wider box can meet begins between the strip before it and its last.
void Sweep::look_up(const SweptProxy &item, const Layout &layout, std::vector<CandidatePair> &pairs) const
{
    const FloatBox &box = item.box;
    const int x = layout.along, y = layout.across, z = layout.other;
    const Probe probe{item.proxy, {box.low[x], box.low[y], box.low[z]}, {box.high[x], box.high[y], box.high[z]}};
    const std::uint32_t last = layout.strip(probe.high[1]);
    auto begin = keys_.begin();
    for (std::uint32_t strip = layout.strip(probe.low[1]) - 1; strip <= last; ++strip)
    {
        begin = std::lower_bound(begin, keys_.end(), layout.key(strip, probe.low[0] - 1.001f * longest_));
        // Empty strips are passed over.
        if ((*begin >> 16) > strip)
            strip = *begin >> 16;
        if (strip <= last)
            compare_from(static_cast<std::size_t>(begin - keys_.begin()), layout.key(strip, probe.high[0]), probe,
                         pairs);
    }
}
} // namespace ode_predictive_space
