#include "ode_predictive_space/broadphase/index/sort_and_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace ode_predictive_space
{
namespace
{
constexpr float last_place = 65535; // along
constexpr int bits_beside = 15;     // of places on the other axes, which are compared as signed numbers
constexpr float places_beside = 1 << bits_beside;

constexpr std::uint32_t last_key = 0x7fffffff;

// The i-th number of a sample of `count`. Multiples of the golden ratio spread evenly over any order of the items: a fixed
// stride meets a single plane of a grid that was created row by row.
std::size_t sampled(std::size_t i, std::size_t count)
{
    const std::uint32_t fraction = static_cast<std::uint32_t>(i) * 0x9e3779b9u;
    return static_cast<std::size_t>((std::uint64_t{fraction} * count) >> 32);
}

// Mean and variance of a number that each item has, from a sample.
struct Moments
{
    double mean = 0, variance = 0;

    template <typename Value> Moments(const std::vector<SweptProxy> &items, Value value)
    {
        const std::size_t count = std::min(items.size(), tuning::spread_samples);
        double sum = 0, squares = 0;
        for (std::size_t i = 0; i < count; ++i)
        {
            const double number = value(items[sampled(i, items.size())].box);
            sum += number;
            squares += number * number;
        }
        mean = sum / static_cast<double>(count);
        variance = std::max(0.0, squares / static_cast<double>(count) - mean * mean);
    }
};

// Where the centres lie.
struct AxisSpread
{
    int axis;
    Moments centres;

    AxisSpread(const std::vector<SweptProxy> &items, int along)
        : axis(along),
          centres(items, [along](const FloatBox &box) { return 0.5f * (box.low[along] + box.high[along]); })
    {}

    bool operator>(const AxisSpread &other) const { return centres.variance > other.centres.variance; }
};

// Least significant digit first, of the upper halves. A digit that is the same in all is passed over.
void radix_sort(std::vector<std::uint64_t> &order, std::vector<std::uint64_t> &scratch)
{
    constexpr int bits = 8;
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

SortAndSweep::Layout SortAndSweep::Layout::fit_for(const Items &items)
{
    std::array<AxisSpread, 3> spreads = {AxisSpread(items, 0), AxisSpread(items, 1), AxisSpread(items, 2)};
    std::sort(spreads.begin(), spreads.end(), std::greater<>());
    const auto cut = [](const AxisSpread &spread, float places) {
        const auto half = static_cast<float>(tuning::deviations_per_half * std::sqrt(spread.centres.variance));
        return Scale{spread.axis, static_cast<float>(spread.centres.mean) - half, half > 0 ? places / (2 * half) : 0};
    };
    Layout layout{cut(spreads[0], last_place), cut(spreads[1], places_beside), cut(spreads[2], places_beside), 0};
    layout.slab_bits = layout.bits_of_slabs(items);
    return layout;
}

int SortAndSweep::Layout::bits_of_slabs(const Items &items) const
{
    constexpr int fewest_bits = 4;
    const int axis = across.axis;
    const double width = Moments(items, [axis](const FloatBox &box) { return box.high[axis] - box.low[axis]; }).mean;
    // Of boxes that lie evenly, all are within this part of the places.
    const double part = std::sqrt(3) / tuning::deviations_per_half;
    const double least =
        std::max(tuning::least_widths_per_slab * width * across.places_per_unit,
                 tuning::least_boxes_per_slab * part * places_beside / static_cast<double>(items.size()));
    int bits = fewest_bits;
    while (bits < bits_beside && (1 << bits) < least)
        ++bits;
    return bits;
}

std::uint32_t SortAndSweep::Layout::place_along(float coordinate) const
{
    const float place = (coordinate - along.begin) * along.places_per_unit;
    return place > 0 ? static_cast<std::uint32_t>(std::min(place, last_place)) : 0;
}

SortAndSweep::Sides SortAndSweep::Sides::of(const FloatBox &box, const Layout &layout)
{
    const Scale &y = layout.across, &z = layout.other;
    const Float4 coordinates(box.low[y.axis], box.high[y.axis], box.low[z.axis], box.high[z.axis]);
    const Float4 begin(y.begin, y.begin, z.begin, z.begin);
    const Float4 scale(y.places_per_unit, y.places_per_unit, z.places_per_unit, z.places_per_unit);
    // The larger of a number that is not one and 0 is 0.
    const Float4 positive = max((coordinates - begin) * scale, Float4::all(0));
    std::int16_t places[4];
    min(positive, Float4::all(places_beside - 1)).store_whole(places);
    return {places[0], places[1], places[2], places[3], layout.place_along(box.high[layout.along.axis])};
}

void SortAndSweep::Columns::resize(std::size_t count)
{
    for (std::vector<std::int16_t> *side : {&low_y, &high_y, &low_z, &high_z})
        side->resize(count);
}

void SortAndSweep::Columns::set(std::size_t i, const Sides &sides)
{
    low_y[i] = sides.low_y;
    high_y[i] = sides.high_y;
    low_z[i] = sides.low_z;
    high_z[i] = sides.high_z;
}

void SortAndSweep::sort_into_slabs(const Items &items, const Layout &layout)
{
    order_.clear();
    sides_.resize(items.size());
    for (std::size_t i = 0; i < items.size(); ++i)
    {
        const FloatBox &box = items[i].box;
        const Sides sides = sides_[i] = Sides::of(box, layout);
        const std::uint32_t place = layout.place_along(box.low[layout.along.axis]);
        const int last = std::max(sides.low_y, sides.high_y) >> layout.slab_bits; // also of an inverted box
        for (int slab = sides.low_y >> layout.slab_bits; slab <= last; ++slab)
            order_.push_back((std::uint64_t{static_cast<std::uint32_t>(slab)} << 16 | place) << 32 | i);
    }
    radix_sort(order_, other_order_);
    const std::size_t count = order_.size();
    keys_.assign(count + spare, last_key);
    ends_.resize(count);
    columns_.resize(count + spare);
    for (std::size_t i = 0; i < count; ++i)
    {
        const Sides &sides = sides_[order_[i] & item_mask];
        keys_[i] = static_cast<std::uint32_t>(order_[i] >> 32);
        ends_[i] = (keys_[i] & ~0xffffu) | sides.high_x;
        columns_.set(i, sides);
    }
}

std::size_t SortAndSweep::compare_each_with_each(const Items &items, Pairs &pairs)
{
    list_.clear();
    for (const SweptProxy &item : items)
        list_.add(item);
    list_.find_pairs([&](ProxyId one, ProxyId other) { pairs.push_back(in_order(one, other)); });
    return items.size() * (items.size() - 1) / 2;
}

std::size_t SortAndSweep::find_pairs(const std::vector<SweptProxy> &items, std::vector<CandidatePair> &pairs)
{
    const bool all_bounded =
        std::all_of(items.begin(), items.end(), [](const SweptProxy &item) { return item.box.bounded(); });
    if (items.size() <= tuning::few_boxes || all_bounded)
        return find_bounded_pairs(items, pairs);
    bounded_.clear();
    unbounded_.clear();
    for (const SweptProxy &item : items)
        (item.box.bounded() ? bounded_ : unbounded_).push_back(item);
    std::size_t comparisons = compare_each_with_each(unbounded_, pairs) + unbounded_.size() * bounded_.size();
    for (const SweptProxy &one : bounded_) // the others are in the list
        list_.walk(BoxProbe(one.box), [&](ProxyId other) { pairs.push_back(in_order(one.proxy, other)); });
    return comparisons + find_bounded_pairs(bounded_, pairs);
}

// Few boxes may be unbounded, too.
std::size_t SortAndSweep::find_bounded_pairs(const Items &items, Pairs &pairs)
{
    if (items.size() <= tuning::few_boxes)
        return items.empty() ? 0 : compare_each_with_each(items, pairs);
    const Layout layout = Layout::fit_for(items);
    sort_into_slabs(items, layout);
    return sweep_rows(items, layout, pairs);
}

std::size_t SortAndSweep::bytes() const
{
    return list_.bytes() + bytes_of(bounded_) + bytes_of(unbounded_) + bytes_of(order_) + bytes_of(other_order_) +
           bytes_of(keys_) + bytes_of(ends_) + bytes_of(sides_) + bytes_of(columns_.low_y) + bytes_of(columns_.high_y) +
           bytes_of(columns_.low_z) + bytes_of(columns_.high_z);
}
} // namespace ode_predictive_space
