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

constexpr std::uint32_t last_key = 0x7fffffff;

void compare_each_with_each(const std::vector<SweptProxy> &items, std::vector<CandidatePair> &pairs)
{
    for (std::size_t i = 0; i < items.size(); ++i)
    {
        const BoxProbe probe(items[i].box);
        for (std::size_t j = i + 1; j < items.size(); ++j)
            if (probe.overlaps(items[j].box))
                pairs.push_back(in_order(items[i].proxy, items[j].proxy));
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
                pairs.push_back(in_order(one.proxy, other.proxy));
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
