#include "ode_predictive_space/broadphase/sweep.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace ode_predictive_space
{
namespace
{
// Fewer are compared each with each.
constexpr std::size_t few = 40;

// Fewer are swept in a single strip: more comparisons, but they come in longer rows.
constexpr std::size_t many = 2000;

// A sample tells how the boxes lie.
constexpr std::size_t sample_size = 24;

constexpr float places = 65535;
constexpr float most_strips = 30000;

// Of a strip: single precision may put a box one hundredth of a strip beside where it belongs.
constexpr float safe_part = 0.98f;

constexpr std::uint32_t one_strip = 1u << 16;
constexpr std::uint32_t last_key = 0x7fffffff;

void add_pair(std::vector<CandidatePair> &pairs, ProxyId one, ProxyId other)
{
    pairs.push_back({std::min(one, other), std::max(one, other)});
}

void compare_each_with_each(const std::vector<SweptProxy> &items, std::vector<CandidatePair> &pairs)
{
    for (std::size_t i = 0; i < items.size(); ++i)
    {
        const BoxProbe probe(items[i].box);
        for (std::size_t j = i + 1; j < items.size(); ++j)
            if (probe.overlaps(items[j].box))
                add_pair(pairs, items[i].proxy, items[j].proxy);
    }
}

// Some numbers, one for each of a sample of the items.
class Sample
{
public:
    template <typename Value> Sample(const std::vector<SweptProxy> &items, Value value)
    {
        const std::size_t stride = (items.size() + sample_size - 1) / sample_size;
        for (std::size_t i = 0; i < items.size(); i += stride)
            values_[count_++] = value(items[i].box);
    }

    double variance() const
    {
        double sum = 0, squares = 0;
        for (std::size_t i = 0; i < count_; ++i)
        {
            sum += values_[i];
            squares += double{values_[i]} * values_[i];
        }
        const double count = static_cast<double>(count_);
        return squares / count - (sum / count) * (sum / count);
    }

    void sort() { std::sort(values_.begin(), values_.begin() + static_cast<std::ptrdiff_t>(count_)); }

    // The number that this part of them, sorted, does not exceed.
    float quantile(double part) const
    {
        return values_[static_cast<std::size_t>(part * static_cast<double>(count_ - 1))];
    }

private:
    std::array<float, sample_size> values_;
    std::size_t count_ = 0;
};

Sample centres(const std::vector<SweptProxy> &items, int axis)
{
    return Sample(items, [axis](const FloatBox &box) { return 0.5f * (box.low[axis] + box.high[axis]); });
}

// Where most values are, with half as much again on both sides. What lies outside is put at its ends.
struct Range
{
    float begin, length;
    explicit Range(Sample values)
    {
        values.sort();
        const float low = values.quantile(0.06), high = values.quantile(0.94);
        begin = low - 0.5f * (high - low);
        length = 2 * (high - low);
    }
};

// Least significant digit first, of the upper halves. A digit that is the same in all is passed over.
template <int bits> void radix_sort(std::vector<std::uint64_t> &order, std::vector<std::uint64_t> &scratch)
{
    constexpr std::uint32_t mask = (1u << bits) - 1;
    std::uint64_t varying = 0;
    for (std::uint64_t element : order)
        varying |= element ^ order.front();
    scratch.resize(order.size());
    for (int shift = 32; shift < 64; shift += bits)
    {
        if (((varying >> shift) & mask) == 0)
            continue;
        std::array<std::uint32_t, mask + 1> starts{};
        for (std::uint64_t element : order)
            ++starts[(element >> shift) & mask];
        std::uint32_t total = 0;
        for (std::uint32_t &start : starts)
            total += std::exchange(start, total);
        for (std::uint64_t element : order)
            scratch[starts[(element >> shift) & mask]++] = element;
        order.swap(scratch);
    }
}
} // namespace

Sweep::Layout Sweep::Layout::fit_for(const std::vector<SweptProxy> &items)
{
    const std::array<double, 3> spread = {centres(items, 0).variance(), centres(items, 1).variance(),
                                          centres(items, 2).variance()};
    std::array<int, 3> axes = {0, 1, 2};
    std::sort(axes.begin(), axes.end(),
              [&](int a, int b) { return spread[static_cast<std::size_t>(a)] > spread[static_cast<std::size_t>(b)]; });
    Layout layout;
    layout.along = axes[0];
    layout.across = axes[1];
    layout.other = axes[2];
    const Range range(centres(items, layout.along));
    layout.begin = range.begin;
    layout.scale = range.length > 0 ? places / range.length : 0;
    layout.widest = std::numeric_limits<float>::infinity();
    if (items.size() > many)
        layout.cut_into_strips(items);
    return layout;
}

// As wide as all boxes are, when they differ little; never narrower than half of them.
void Sweep::Layout::cut_into_strips(const std::vector<SweptProxy> &items)
{
    Sample widths(items, [this](const FloatBox &box) { return box.high[across] - box.low[across]; });
    const Range range(centres(items, across));
    widths.sort();
    const float typical = std::min(widths.quantile(1), 2 * widths.quantile(0.75));
    const float width = std::max(typical / safe_part, range.length / most_strips);
    first = range.begin;
    strips_per_unit = width > 0 ? 1 / width : 0;
    widest = std::max(typical, safe_part * width);
}

// Does not decrease with the coordinate, whatever the rounding; 0 also when it is not a number.
std::uint32_t Sweep::Layout::place(float coordinate) const
{
    const float place = (coordinate - begin) * scale;
    return place > 0 ? static_cast<std::uint32_t>(std::min(place, places)) : 0;
}

std::uint32_t Sweep::Layout::strip(float coordinate) const
{
    const float strip = (coordinate - first) * strips_per_unit;
    return 1 + (strip > 0 ? static_cast<std::uint32_t>(std::min(strip, most_strips)) : 0);
}

void Sweep::Sides::resize(std::size_t count)
{
    for (std::vector<float> &side : low)
        side.resize(count);
    for (std::vector<float> &side : high)
        side.resize(count);
}

void Sweep::sort_keys()
{
    if (order_.empty())
        return;
    if (order_.size() < 4096)
        radix_sort<8>(order_, other_order_);
    else
        radix_sort<11>(order_, other_order_);
}

// Leaves those that are wider than a strip in wider_.
void Sweep::sort_into_strips(const std::vector<SweptProxy> &items, const Layout &layout)
{
    order_.clear();
    still_wider_.clear();
    longest_ = 0;
    for (std::size_t i = 0; i < items.size(); ++i)
    {
        const FloatBox &box = items[i].box;
        if (!layout.fits(box))
        {
            still_wider_.push_back(items[i]);
            continue;
        }
        const std::uint32_t key = layout.key(layout.strip(box.low[layout.across]), box.low[layout.along]);
        order_.push_back(std::uint64_t{key} << 32 | i);
        longest_ = std::max(longest_, box.high[layout.along] - box.low[layout.along]);
    }
    sort_keys();
    const std::size_t count = order_.size();
    keys_.assign(count + spare, last_key);
    ends_.resize(count);
    proxies_.resize(count);
    sides_.resize(count + spare);
    std::fill_n(sides_.low[0].begin() + static_cast<std::ptrdiff_t>(count), spare,
                std::numeric_limits<float>::infinity());
    const int axes[] = {layout.along, layout.across, layout.other};
    for (std::size_t i = 0; i < count; ++i)
    {
        const SweptProxy &item = items[order_[i] & 0xffffffffu];
        keys_[i] = static_cast<std::uint32_t>(order_[i] >> 32);
        ends_[i] = layout.key(keys_[i] >> 16, item.box.high[layout.along]);
        proxies_[i] = item.proxy;
        for (std::size_t side = 0; side < 3; ++side)
        {
            sides_.low[side][i] = item.box.low[axes[side]];
            sides_.high[side][i] = item.box.high[axes[side]];
        }
    }
}

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
            add_pair(pairs, probe.proxy, proxies_[j]);
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
                    add_pair(pairs, sweep_.proxies_[one], sweep_.proxies_[other]);
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

void Sweep::find_pairs(const std::vector<SweptProxy> &items, std::vector<CandidatePair> &pairs)
{
    const bool all_bounded =
        std::all_of(items.begin(), items.end(), [](const SweptProxy &item) { return item.box.bounded(); });
    if (all_bounded)
    {
        find_bounded_pairs(items, pairs);
        return;
    }
    bounded_.clear();
    unbounded_.clear();
    for (const SweptProxy &item : items)
        (item.box.bounded() ? bounded_ : unbounded_).push_back(item);
    compare_each_with_each(unbounded_, pairs);
    for (const SweptProxy &one : unbounded_)
    {
        const BoxProbe probe(one.box);
        for (const SweptProxy &other : bounded_)
            if (probe.overlaps(other.box))
                add_pair(pairs, one.proxy, other.proxy);
    }
    find_bounded_pairs(bounded_, pairs);
}

void Sweep::sort_along_widest(const std::vector<SweptProxy> &items, std::vector<ProxyId> &order)
{
    // The others tell nothing about where most are; they are put at an end.
    bounded_.clear();
    std::copy_if(items.begin(), items.end(), std::back_inserter(bounded_),
                 [](const SweptProxy &item) { return item.box.bounded(); });
    const Layout layout = bounded_.empty() ? Layout() : Layout::fit_for(bounded_);
    order_.clear();
    for (std::size_t i = 0; i < items.size(); ++i)
        order_.push_back(std::uint64_t{layout.place(items[i].box.low[layout.along])} << 32 | i);
    sort_keys();
    for (std::uint64_t element : order_)
        order.push_back(items[element & 0xffffffffu].proxy);
}

void Sweep::find_bounded_pairs(const std::vector<SweptProxy> &items, std::vector<CandidatePair> &pairs)
{
    const std::vector<SweptProxy> *left = &items;
    while (left->size() > few)
    {
        const Layout layout = Layout::fit_for(*left);
        sort_into_strips(*left, layout);
        if (layout.strips_per_unit > 0)
            sweep_strips(pairs);
        else
            sweep_single_strip(pairs);
        for (const SweptProxy &item : still_wider_)
            look_up(item, layout, pairs);
        wider_.swap(still_wider_);
        left = &wider_;
    }
    compare_each_with_each(*left, pairs);
}

std::size_t Sweep::bytes() const
{
    std::size_t floats = 0;
    for (std::size_t side = 0; side < 3; ++side)
        floats += sides_.low[side].capacity() + sides_.high[side].capacity();
    return (wider_.capacity() + still_wider_.capacity() + bounded_.capacity() + unbounded_.capacity()) *
               sizeof(SweptProxy) +
           (order_.capacity() + other_order_.capacity()) * sizeof(std::uint64_t) +
           (keys_.capacity() + ends_.capacity()) * sizeof(std::uint32_t) + proxies_.capacity() * sizeof(ProxyId) +
           floats * sizeof(float);
}
} // namespace ode_predictive_space
