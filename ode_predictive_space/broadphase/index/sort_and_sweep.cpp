#include "ode_predictive_space/broadphase/index/sort_and_sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ode_predictive_space
{
namespace
{
constexpr float last_place = 65535; // on the sorted axis
constexpr int bits_beside = 15;     // bits of places on the other axes, which are compared as signed numbers
constexpr float places_beside = 1 << bits_beside;

constexpr std::uint32_t last_key = 0x7fffffff;

// The i-th index of a sample of `count` items. Multiples of the golden ratio spread evenly, whereas a fixed stride may meet a
// single plane of a grid that was created row by row.
std::size_t sampled(std::size_t i, std::size_t count)
{
    const std::uint32_t fraction = static_cast<std::uint32_t>(i) * 0x9e3779b9u;
    return static_cast<std::size_t>((std::uint64_t{fraction} * count) >> 32);
}

struct Moments
{
    double mean = 0, variance = 0;

    template <typename Value> Moments(const std::vector<SweptProxy> &items, Value value)
    {
        const std::size_t count = std::min(items.size(), tuning::few_boxes);
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

// Sorts by the upper halves, from the least significant digit on. Digits are as wide as allowed and cover only bits that vary.
void radix_sort(std::vector<std::uint64_t> &order, std::vector<std::uint64_t> &scratch)
{
    constexpr int widest = 11;
    std::uint64_t varying = 0;
    for (std::uint64_t element : order)
        varying |= element ^ order.front();
    const auto keys = static_cast<std::uint32_t>(varying >> 32);
    const int bits = keys ? 32 - __builtin_clz(keys) : 0;
    const int digits = (bits + widest - 1) / widest, width = digits ? (bits + digits - 1) / digits : 0;
    const std::uint32_t mask = (1u << width) - 1;
    scratch.resize(order.size());
    for (int shift = 32; shift < 32 + bits; shift += width)
    {
        std::array<std::uint32_t, 1u << widest> starts;
        std::fill_n(starts.begin(), mask + 1, 0);
        for (std::uint64_t element : order)
            ++starts[(element >> shift) & mask];
        std::uint32_t total = 0;
        for (std::uint32_t digit = 0; digit <= mask; ++digit)
            total += std::exchange(starts[digit], total);
        std::uint64_t *const sorted = scratch.data();
        for (std::uint64_t element : order)
            sorted[starts[(element >> shift) & mask]++] = element;
        order.swap(scratch);
    }
}
} // namespace

SortAndSweep::Layout SortAndSweep::Layout::fit_for(const Items &items)
{
    const auto centres = [&items](int axis) {
        return Moments(items, [axis](const FloatBox &box) { return 0.5f * (box.low[axis] + box.high[axis]); });
    };
    const std::array<Moments, 3> of_axis = {centres(0), centres(1), centres(2)};
    std::array<int, 3> axes = {0, 1, 2}; // the widest spread first
    std::sort(axes.begin(), axes.end(), [&](int a, int b) { return of_axis[a].variance > of_axis[b].variance; });
    const auto cut = [&](int axis, float places) {
        const auto half = static_cast<float>(tuning::deviations_per_half * std::sqrt(of_axis[axis].variance));
        return Scale{axis, static_cast<float>(of_axis[axis].mean) - half, half > 0 ? places / (2 * half) : 0};
    };
    Layout layout{cut(axes[0], last_place), cut(axes[1], places_beside), cut(axes[2], places_beside), 0};
    layout.slab_bits = layout.bits_of_slabs(items);
    return layout;
}

int SortAndSweep::Layout::bits_of_slabs(const Items &items) const
{
    const int axis = across.axis;
    const double width = Moments(items, [axis](const FloatBox &box) { return box.high[axis] - box.low[axis]; }).mean;
    // Evenly distributed boxes occupy this part of the places.
    const double part = std::sqrt(3) / tuning::deviations_per_half;
    const double least = std::max(width * across.places_per_unit, tuning::least_boxes_per_slab * part * places_beside /
                                                                      static_cast<double>(items.size()));
    int bits = 1; // keys stay below last_key
    while (bits < bits_beside && (1 << bits) < least)
        ++bits;
    return bits;
}

SortAndSweep::Grid::Grid(const Layout &layout) : x_(layout.along.axis), y_(layout.across.axis), z_(layout.other.axis)
{
    float begin[3], scale[3], last[3];
    for (const Scale &axis : {layout.along, layout.across, layout.other})
    {
        begin[axis.axis] = axis.begin;
        scale[axis.axis] = axis.places_per_unit;
        last[axis.axis] = axis.axis == x_ ? last_place : places_beside - 1;
    }
    low_ = {Float4(begin[0], begin[1], begin[2], 0), Float4(scale[0], scale[1], scale[2], 0),
            Float4(last[0], last[1], last[2], 0)};
    high_ = {Float4(0, begin[0], begin[1], begin[2]), Float4(0, scale[0], scale[1], scale[2]),
             Float4(0, last[0], last[1], last[2])};
}

// max() returns 0 for NaN.
inline void SortAndSweep::Grid::Cut::operator()(const float *four, std::int32_t *places) const
{
    min(max((Float4::load(four) - begin) * scale, Float4::all(0)), last).store_whole(places);
}

// Both loads stay within the box: the load of the high sides begins with the last low side.
inline SortAndSweep::Sides SortAndSweep::Grid::sides(const FloatBox &box) const
{
    std::int32_t low[4], high[4];
    low_(&box.low[0], low);
    high_(&box.low[2], high);
    const std::int32_t *const highs = high + 1;
    return {static_cast<std::int16_t>(low[y_]),  static_cast<std::int16_t>(highs[y_]),
            static_cast<std::int16_t>(low[z_]),  static_cast<std::int16_t>(highs[z_]),
            static_cast<std::uint32_t>(low[x_]), static_cast<std::uint32_t>(highs[x_])};
}

void SortAndSweep::sort_into_slabs(const Items &items, const Layout &layout)
{
    const Grid grid(layout);
    sides_.resize(items.size());
    order_.resize(std::max(order_.size(), items.size()));
    Sides *const all_sides = sides_.data();
    std::size_t count = 0;
    for (std::size_t i = 0; i < items.size(); ++i)
    {
        const Sides sides = all_sides[i] = grid.sides(items[i].box);
        const int last = std::max(sides.low_y, sides.high_y) >> layout.slab_bits; // valid for inverted boxes, too
        for (int slab = sides.low_y >> layout.slab_bits; slab <= last; ++slab)
        {
            if (count == order_.size())
                order_.resize(2 * count);
            order_[count++] = (std::uint64_t{static_cast<std::uint32_t>(slab)} << 16 | sides.low_x) << 32 | i;
        }
    }
    order_.resize(count);
    radix_sort(order_, other_order_);
    set_columns(all_sides);
}

void SortAndSweep::set_columns(const Sides *sides)
{
    const std::size_t count = order_.size();
    keys_.assign(count + spare, last_key);
    ends_.resize(count);
    for (std::vector<std::int16_t> *column : {&low_y_, &high_y_, &low_z_, &high_z_})
        column->resize(count + spare);
    const std::uint64_t *const order = order_.data();
    std::uint32_t *const keys = keys_.data(), *const ends = ends_.data();
    std::int16_t *const low_y = low_y_.data(), *const high_y = high_y_.data(), *const low_z = low_z_.data(),
                        *const high_z = high_z_.data();
    for (std::size_t i = 0; i < count; ++i)
    {
        const Sides &of_box = sides[order[i] & item_mask];
        keys[i] = static_cast<std::uint32_t>(order[i] >> 32);
        ends[i] = (keys[i] & ~0xffffu) | of_box.high_x;
        low_y[i] = of_box.low_y;
        high_y[i] = of_box.high_y;
        low_z[i] = of_box.low_z;
        high_z[i] = of_box.high_z;
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
    for (const SweptProxy &one : bounded_) // list_ holds the unbounded ones
        list_.walk(BoxProbe(one.box), [&](ProxyId other) { pairs.push_back(in_order(one.proxy, other)); });
    return comparisons + find_bounded_pairs(bounded_, pairs);
}

// Up to few_boxes items may be unbounded.
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
           bytes_of(keys_) + bytes_of(ends_) + bytes_of(sides_) + 4 * bytes_of(low_y_);
}
} // namespace ode_predictive_space
