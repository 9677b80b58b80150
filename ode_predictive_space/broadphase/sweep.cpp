#include "ode_predictive_space/broadphase/sweep.h"

#include <algorithm>
#include <array>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace ode_predictive_space
{
namespace
{
// Maps floats to integers of the same order.
std::uint32_t sortable(float value)
{
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

// The axis along which the centres vary most. Boxes with infinite sides say nothing and are left out.
int widest_axis(const std::vector<SweptProxy> &items)
{
    double sum[3] = {}, squares[3] = {};
    int count = 0;
    for (const SweptProxy &item : items)
    {
        if (!item.box.bounded())
            continue;
        ++count;
        for (int axis = 0; axis < 3; ++axis)
        {
            const double centre = 0.5 * (double{item.box.low[axis]} + item.box.high[axis]);
            sum[axis] += centre;
            squares[axis] += centre * centre;
        }
    }
    int widest = 0;
    auto variance = [&](int axis) { return squares[axis] * count - sum[axis] * sum[axis]; };
    for (int axis = 1; axis < 3; ++axis)
        if (variance(axis) > variance(widest))
            widest = axis;
    return widest;
}

// Least significant digit first, three passes of 11 bits over the key in the upper half.
void radix_sort(std::vector<std::uint64_t> &keys, std::vector<std::uint64_t> &scratch)
{
    scratch.resize(keys.size());
    for (int shift = 32; shift < 64; shift += 11)
    {
        std::array<std::uint32_t, 2048> starts{};
        for (std::uint64_t key : keys)
            ++starts[(key >> shift) & 2047];
        std::uint32_t total = 0;
        for (std::uint32_t &start : starts)
        {
            const std::uint32_t count = start;
            start = total;
            total += count;
        }
        for (std::uint64_t key : keys)
            scratch[starts[(key >> shift) & 2047]++] = key;
        keys.swap(scratch);
    }
}

#if defined(__SSE2__)
struct Probe
{
    __m128 limit;
    explicit Probe(const float *component)
    {
        const __m128 own = _mm_load_ps(component);
        limit = _mm_sub_ps(_mm_setzero_ps(), _mm_shuffle_ps(own, own, _MM_SHUFFLE(1, 0, 3, 2)));
    }
    bool overlaps(const float *component) const
    {
        return _mm_movemask_ps(_mm_cmple_ps(_mm_load_ps(component), limit)) == 15;
    }
};
#else
struct Probe
{
    float limit[4];
    explicit Probe(const float *component) : limit{-component[2], -component[3], -component[0], -component[1]} {}
    bool overlaps(const float *component) const
    {
        return component[0] <= limit[0] && component[1] <= limit[1] && component[2] <= limit[2] &&
               component[3] <= limit[3];
    }
};
#endif
} // namespace

void Sweep::sort_along(const std::vector<SweptProxy> &items, int axis)
{
    const std::size_t count = items.size();
    keys_.resize(count);
    for (std::size_t i = 0; i < count; ++i)
        keys_[i] = (std::uint64_t{sortable(items[i].box.low[axis])} << 32) | i;
    if (count < 256)
        std::sort(keys_.begin(), keys_.end());
    else
        radix_sort(keys_, other_keys_);

    const int y = (axis + 1) % 3, z = (axis + 2) % 3;
    low_.resize(count);
    high_.resize(count);
    slabs_.resize(count);
    proxies_.resize(count);
    for (std::size_t i = 0; i < count; ++i)
    {
        const SweptProxy &item = items[keys_[i] & 0xffffffffu];
        low_[i] = item.box.low[axis];
        high_[i] = item.box.high[axis];
        slabs_[i] = {{item.box.low[y], item.box.low[z], -item.box.high[y], -item.box.high[z]}};
        proxies_[i] = item.proxy;
    }
}

void Sweep::find_pairs(const std::vector<SweptProxy> &items, std::vector<CandidatePair> &pairs)
{
    if (items.empty())
        return;
    sort_along(items, widest_axis(items));
    const std::size_t count = items.size();
    for (std::size_t i = 0; i + 1 < count; ++i)
    {
        const float end = high_[i];
        const Probe probe(slabs_[i].component);
        for (std::size_t j = i + 1; j < count && low_[j] <= end; ++j)
            if (probe.overlaps(slabs_[j].component))
                pairs.push_back({std::min(proxies_[i], proxies_[j]), std::max(proxies_[i], proxies_[j])});
    }
}

std::size_t Sweep::bytes() const
{
    return (keys_.capacity() + other_keys_.capacity()) * sizeof(std::uint64_t) +
           (low_.capacity() + high_.capacity()) * sizeof(float) + slabs_.capacity() * sizeof(Slab) +
           proxies_.capacity() * sizeof(ProxyId);
}
} // namespace ode_predictive_space
