#include "ode_predictive_space/preload/counts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_predictive_space::preload
{
unsigned Durations::bucket_of(std::uint32_t nanoseconds)
{
    unsigned shift = 0;
    while (nanoseconds >> shift >= 2u << bits)
        ++shift;
    return (shift << bits) + (nanoseconds >> shift);
}

void Durations::add(double seconds)
{
    constexpr std::uint32_t longest = std::numeric_limits<std::uint32_t>::max();
    const double nanoseconds = 1e9 * seconds;
    std::uint32_t &bucket =
        buckets_[bucket_of(nanoseconds < longest ? static_cast<std::uint32_t>(std::max(0.0, nanoseconds)) : longest)];
    if (bucket < std::numeric_limits<std::uint32_t>::max())
        ++bucket;
}

double Durations::median() const
{
    std::uint64_t count = 0;
    for (std::uint32_t bucket : buckets_)
        count += bucket;
    std::uint64_t left = count / 2;
    for (unsigned i = 0; i < bucket_count && count > 0; ++i)
    {
        if (left < buckets_[i])
        {
            const unsigned shift = std::max(i >> bits, 1u) - 1;
            const double part = (static_cast<double>(left) + 0.5) / buckets_[i];
            return 1e-9 * std::ldexp((i - (shift << bits)) + part, static_cast<int>(shift));
        }
        left -= buckets_[i];
    }
    return 0;
}

void CallTimes::add(double seconds, double callback_seconds)
{
    ++calls;
    total += seconds;
    largest = std::max(largest, seconds);
    in_callbacks += callback_seconds;
    durations.add(seconds);
}
} // namespace ode_predictive_space::preload
