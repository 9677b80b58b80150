#include "ode_predictive_space/haptics/loop.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double nanoseconds = 1e9; // per second
constexpr double longest = 1e4;     // seconds

// There is one writer: no read-modify-write is needed.
template <typename Number> void increase(std::atomic<Number> &number, Number by)
{
    number.store(number.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
}
} // namespace

// The octave is the exponent of the time in nanoseconds, the step the leading bits of its mantissa.
std::size_t TimeHistogram::bucket_of(double nanoseconds)
{
    int exponent = 0;
    const double mantissa = std::frexp(nanoseconds, &exponent); // in [0.5, 1)
    const int step = static_cast<int>((2 * mantissa - 1) * steps_per_octave);
    return static_cast<std::size_t>(exponent - 1) * steps_per_octave + static_cast<std::size_t>(step);
}

double TimeHistogram::upper_end(std::size_t bucket)
{
    const auto octave = static_cast<int>(bucket / steps_per_octave);
    const double step = static_cast<double>(bucket % steps_per_octave) + 1;
    return std::ldexp(1 + step / steps_per_octave, octave);
}

void TimeHistogram::add(double seconds)
{
    const double time = std::clamp(seconds, 1 / nanoseconds, longest);
    increase(buckets_[bucket_of(std::max(1.0, time * nanoseconds))], std::uint64_t{1});
    increase(sum_, time);
    max_.store(std::max(max_.load(std::memory_order_relaxed), time), std::memory_order_relaxed);
    increase(count_, std::uint64_t{1});
}

double TimeHistogram::quantile(double share) const
{
    const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count())));
    std::uint64_t seen = 0;
    for (std::size_t bucket = 0; bucket < buckets_.size() && wanted > 0; ++bucket)
    {
        seen += buckets_[bucket].load(std::memory_order_relaxed);
        if (seen >= wanted)
            return std::min(upper_end(bucket) / nanoseconds, max_.load(std::memory_order_relaxed));
    }
    return 0;
}

TimeSummary TimeHistogram::summary() const
{
    TimeSummary summary;
    summary.count = count();
    if (summary.count > 0)
    {
        summary.mean = sum_.load(std::memory_order_relaxed) / static_cast<double>(summary.count);
        summary.p50 = quantile(0.5);
        summary.p99 = quantile(0.99);
        summary.p999 = quantile(0.999);
        summary.max = max_.load(std::memory_order_relaxed);
    }
    return summary;
}
} // namespace ode_predictive_space::haptics
