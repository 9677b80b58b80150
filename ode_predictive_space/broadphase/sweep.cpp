#include "ode_predictive_space/broadphase/sweep.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

namespace ode_predictive_space
{
namespace
{
// A sample tells how the boxes lie.
constexpr std::size_t sample_size = 24;

constexpr float last_place = 65535; // along
constexpr int bits_beside = 15;     // of places on the other axes, which are compared as signed numbers
constexpr float places_beside = 1 << bits_beside;

// Standard ones, from the middle of an axis to the ends of its places. What lies outside is put at the ends.
constexpr double deviations = 4;

// A slab is as wide as so many boxes or more, so that few boxes are in two; and it has so many or more.
constexpr double least_widths = 4;
constexpr double least_boxes = 1000;

constexpr std::uint32_t last_key = 0x7fffffff;

// Of a number that each item has; a sample tells.
struct Moments
{
    double mean = 0, variance = 0;

    template <typename Value> Moments(const std::vector<SweptProxy> &items, Value value)
    {
        const std::size_t stride = (items.size() + sample_size - 1) / sample_size;
        double sum = 0, squares = 0, count = 0;
        for (std::size_t i = 0; i < items.size(); i += stride)
        {
            const double number = value(items[i].box);
            sum += number;
            squares += number * number;
            ++count;
        }
        mean = sum / count;
        variance = std::max(0.0, squares / count - mean * mean);
    }
};

// Where the centres lie.
struct Spread
{
    int axis;
    Moments centres;

    Spread(const std::vector<SweptProxy> &items, int axis)
        : axis(axis), centres(items, [axis](const FloatBox &box) { return 0.5f * (box.low[axis] + box.high[axis]); })
    {}

    bool operator>(const Spread &other) const { return centres.variance > other.centres.variance; }
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

Sweep::Layout Sweep::Layout::fit_for(const Items &items)
{
    std::array<Spread, 3> spreads = {Spread(items, 0), Spread(items, 1), Spread(items, 2)};
    std::sort(spreads.begin(), spreads.end(), std::greater<>());
    const auto cut = [](const Spread &spread, float places) {
        const auto half = static_cast<float>(deviations * std::sqrt(spread.centres.variance));
        return Scale{spread.axis, static_cast<float>(spread.centres.mean) - half, half > 0 ? places / (2 * half) : 0};
    };
    Layout layout{cut(spreads[0], last_place), cut(spreads[1], places_beside), cut(spreads[2], places_beside), 0};
    layout.slab_bits = layout.bits_of_slabs(items);
    return layout;
}

int Sweep::Layout::bits_of_slabs(const Items &items) const
{
    constexpr int fewest_bits = 4;
    const int axis = across.axis;
    const double width = Moments(items, [axis](const FloatBox &box) { return box.high[axis] - box.low[axis]; }).mean;
    // Of boxes that lie evenly, all are within this part of the places.
    const double part = std::sqrt(3) / deviations;
    const double least = std::max(least_widths * width * across.places_per_unit,
                                  least_boxes * part * places_beside / static_cast<double>(items.size()));
    int bits = fewest_bits;
    while (bits < bits_beside && (1 << bits) < least)
        ++bits;
    return bits;
}

std::uint32_t Sweep::Layout::place_along(float coordinate) const
{
    const float place = (coordinate - along.begin) * along.places_per_unit;
    return place > 0 ? static_cast<std::uint32_t>(std::min(place, last_place)) : 0;
}

Sweep::Sides Sweep::Sides::of(const FloatBox &box, const Layout &layout)
{
    const Scale &y = layout.across, &z = layout.other;
#if defined(__SSE2__)
    const __m128 coordinates = _mm_setr_ps(box.low[y.axis], box.high[y.axis], box.low[z.axis], box.high[z.axis]);
    const __m128 begin = _mm_setr_ps(y.begin, y.begin, z.begin, z.begin);
    const __m128 scale = _mm_setr_ps(y.places_per_unit, y.places_per_unit, z.places_per_unit, z.places_per_unit);
    // The larger of what is not a number and 0 is 0.
    const __m128 positive = _mm_max_ps(_mm_mul_ps(_mm_sub_ps(coordinates, begin), scale), _mm_setzero_ps());
    const __m128i places = _mm_cvttps_epi32(_mm_min_ps(positive, _mm_set1_ps(places_beside - 1)));
    const __m128i packed = _mm_packs_epi32(places, places);
    Sides sides;
    _mm_storel_epi64(reinterpret_cast<__m128i *>(&sides), packed);
    sides.high_x = layout.place_along(box.high[layout.along.axis]);
    return sides;
#else
    const auto place = [](const Scale &scale, float coordinate) {
        const float place = (coordinate - scale.begin) * scale.places_per_unit;
        return static_cast<std::int16_t>(place > 0 ? std::min(place, places_beside - 1) : 0);
    };
    return {place(y, box.low[y.axis]), place(y, box.high[y.axis]), place(z, box.low[z.axis]),
            place(z, box.high[z.axis]), layout.place_along(box.high[layout.along.axis])};
#endif
}

void Sweep::Columns::resize(std::size_t count)
{
    for (std::vector<std::int16_t> *side : {&low_y, &high_y, &low_z, &high_z})
        side->resize(count);
}

void Sweep::Columns::set(std::size_t i, const Sides &sides)
{
    low_y[i] = sides.low_y;
    high_y[i] = sides.high_y;
    low_z[i] = sides.low_z;
    high_z[i] = sides.high_z;
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

void Sweep::sort_into_slabs(const Items &items, const Layout &layout)
{
    order_.clear();
    sides_.resize(items.size());
    for (std::size_t i = 0; i < items.size(); ++i)
    {
        const FloatBox &box = items[i].box;
        const Sides sides = sides_[i] = Sides::of(box, layout);
        const std::uint32_t place = layout.place_along(box.low[layout.along.axis]);
        const int last = sides.high_y >> layout.slab_bits;
        for (int slab = sides.low_y >> layout.slab_bits; slab <= last; ++slab)
            order_.push_back((std::uint64_t{static_cast<std::uint32_t>(slab)} << 16 | place) << 32 | i);
    }
    sort_keys();
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

void Sweep::compare_each_with_each(const Items &items, Pairs &pairs)
{
    list_.clear();
    for (const SweptProxy &item : items)
        list_.add(item);
    list_.find_pairs([&](ProxyId one, ProxyId other) { pairs.push_back(in_order(one, other)); });
}

void Sweep::find_pairs(const std::vector<SweptProxy> &items, std::vector<CandidatePair> &pairs)
{
    if (items.size() <= few)
    {
        compare_each_with_each(items, pairs);
        return;
    }
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
        order_.push_back(std::uint64_t{layout.place_along(items[i].box.low[layout.along.axis])} << 32 | i);
    sort_keys();
    for (std::uint64_t element : order_)
        order.push_back(items[element & item_mask].proxy);
}

void Sweep::find_bounded_pairs(const Items &items, Pairs &pairs)
{
    if (items.size() <= few)
    {
        compare_each_with_each(items, pairs);
        return;
    }
    const Layout layout = Layout::fit_for(items);
    sort_into_slabs(items, layout);
    sweep_rows(items, layout, pairs);
}

std::size_t Sweep::bytes() const
{
    const std::size_t sides =
        columns_.low_y.capacity() + columns_.high_y.capacity() + columns_.low_z.capacity() + columns_.high_z.capacity();
    return list_.bytes() + (bounded_.capacity() + unbounded_.capacity()) * sizeof(SweptProxy) +
           (order_.capacity() + other_order_.capacity()) * sizeof(std::uint64_t) +
           (keys_.capacity() + ends_.capacity()) * sizeof(std::uint32_t) + sides_.capacity() * sizeof(Sides) +
           sides * sizeof(std::int16_t);
}
} // namespace ode_predictive_space
