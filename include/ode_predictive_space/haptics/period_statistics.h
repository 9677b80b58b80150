// How regular a loop is: times in histograms of fixed size.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PERIOD_STATISTICS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PERIOD_STATISTICS_H

#include <array>
#include <atomic>
#include <cstdint>

namespace ode_predictive_space::haptics
{
/// Of many times, in seconds. All 0 when there were none.
struct TimeSummary
{
    std::uint64_t count = 0; ///< how many times
    double mean = 0;         ///< of all
    double p50 = 0;          ///< half of the times are not longer
    double p99 = 0;          ///< 99 % are not longer
    double p999 = 0;         ///< 99.9 % are not longer
    double max = 0;          ///< the longest
};

/// Times, by their size, in buckets of constant relative width. Nothing is allocated after the constructor.
///
/// One thread adds; any thread may ask at any time, and then sees all but the very last.
class TimeHistogram
{
public:
    /// @param seconds >= 0. What is shorter than a nanosecond counts as one, what is longer than 10,000 s as that.
    void add(double seconds);

    /// How many times were added.
    std::uint64_t count() const { return count_.load(std::memory_order_relaxed); }

    /// The time that the given share of all times, 0 to 1, does not exceed: never too short, and too long by less than 2 %.
    double quantile(double share) const;

    /// Of all times that were added.
    TimeSummary summary() const;

private:
    static constexpr int steps_per_octave = 64;
    static constexpr int octaves = 44; // 2^44 ns are 4.9 hours

    static std::size_t bucket_of(double nanoseconds);
    static double upper_end(std::size_t bucket); // nanoseconds

    std::array<std::atomic<std::uint64_t>, std::size_t{octaves} * steps_per_octave> buckets_{};
    std::atomic<std::uint64_t> count_{0};
    std::atomic<double> sum_{0}; // seconds
    std::atomic<double> max_{0}; // seconds
};
} // namespace ode_predictive_space::haptics

#endif
