#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_STATISTICS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_STATISTICS_H

#include <algorithm>
#include <numeric>
#include <vector>

namespace ode_predictive_space::benchmarks
{
/// By nearest rank, so it is one of the values; in whole numbers, as 0.99 * 100 in floating point is not always 99.
/// @pre the values are sorted, and not empty.
inline double percentile(const std::vector<double> &sorted, std::size_t per_mille)
{
    const std::size_t rank = (sorted.size() * per_mille + 999) / 1000;
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}

inline double mean(const std::vector<double> &values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
} // namespace ode_predictive_space::benchmarks

#endif
