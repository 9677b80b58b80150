// Statistics of periods and times of ticks.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_TIME_HISTOGRAM_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_TIME_HISTOGRAM_H

#include "ode_predictive_space/haptics/loop.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace ode_predictive_space::haptics
{
/// Counts of times in buckets of constant relative width. Allocates nothing after construction. One thread adds; any thread may
/// read at any time, and may miss the last value.
class TimeHistogram
{
public:
    /// @param seconds >= 0; clamped to 1 ns and 10,000 s.
    void add(double seconds)
    {
        const double time = std::clamp(seconds, 1 / nanoseconds, longest);
        increase(buckets_[bucket_of(std::max(1.0, time * nanoseconds))], std::uint64_t{1});
        increase(sum_, time);
        max_.store(std::max(max_.load(std::memory_order_relaxed), time), std::memory_order_relaxed);
        increase(count_, std::uint64_t{1});
    }

    std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }

    /// The quantile of a share, 0 to 1: never too short, and too long by less than 2 %.
    double quantile(double share) const
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

    TimeSummary summary() const
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

private:
    static constexpr double nanoseconds = 1e9; // per second
    static constexpr double longest = 1e4;     // s
    static constexpr int steps_per_octave = 64;
    static constexpr int octaves = 44; // 2^44 ns = 4.9 h

    /// With one writer, no atomic read-modify-write is needed.
    template <typename Number> static void increase(std::atomic<Number> &number, Number by)
    {
        number.store(number.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
    }

    /// The octave is the exponent of the time, the step the leading bits of its mantissa. @param time ns.
    static std::size_t bucket_of(double time)
    {
        int exponent = 0;
        const double mantissa = std::frexp(time, &exponent); // in [0.5, 1)
        const int step = static_cast<int>((2 * mantissa - 1) * steps_per_octave);
        return static_cast<std::size_t>(exponent - 1) * steps_per_octave + static_cast<std::size_t>(step);
    }

    /// ns.
    static double upper_end(std::size_t bucket)
    {
        const auto octave = static_cast<int>(bucket / steps_per_octave);
        const double step = static_cast<double>(bucket % steps_per_octave) + 1;
        return std::ldexp(1 + step / steps_per_octave, octave);
    }

    std::array<std::atomic<std::uint64_t>, std::size_t{octaves} * steps_per_octave> buckets_{};
    std::atomic<std::uint64_t> count_{0};
    std::atomic<double> sum_{0}; // seconds
    std::atomic<double> max_{0}; // seconds
};
} // namespace ode_predictive_space::haptics

#endif
