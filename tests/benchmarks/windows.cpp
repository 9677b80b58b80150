#include "tests/benchmarks/windows.h"

#include <algorithm>

namespace ode_predictive_space::benchmarks
{
namespace
{
std::size_t measured_ticks(const Comparison &comparison)
{
    std::size_t most = 0;
    for (const Result &result : comparison.results)
    {
        most = std::max(most, result.clock_times.size());
    }
    return most;
}

/// A contender that was stopped early may have nothing in a window.
std::vector<double> part_of(const std::vector<double> &times, std::size_t begin, std::size_t end)
{
    const auto at = [&](std::size_t tick) {
        return times.begin() + static_cast<std::ptrdiff_t>(std::min(tick, times.size()));
    };
    return {at(begin), at(end)};
}
} // namespace

std::vector<Comparison> windows_of(const Comparison &whole, std::size_t ticks_per_window)
{
    std::vector<Comparison> windows;
    const std::size_t ticks = measured_ticks(whole);
    for (std::size_t begin = 0; begin < ticks; begin += ticks_per_window)
    {
        windows.push_back(whole);
        for (Result &result : windows.back().results)
        {
            const std::size_t warm_up = result.ticks - result.clock_times.size();
            result.times = part_of(result.times, begin, begin + ticks_per_window);
            result.clock_times = part_of(result.clock_times, begin, begin + ticks_per_window);
            result.tick_times = part_of(result.tick_times, begin, begin + ticks_per_window);
            result.ticks = warm_up + begin + result.clock_times.size();
        }
    }
    return windows;
}
} // namespace ode_predictive_space::benchmarks
