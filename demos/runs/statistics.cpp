#include "demos/runs/statistics.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace ode_predictive_space::worlds
{
namespace
{
// In whole numbers, as 0.99 * 100 in floating point is not always 99.
double nearest_rank(const std::vector<double> &sorted, std::size_t per_mille)
{
    const std::size_t rank = (sorted.size() * per_mille + 999) / 1000;
    return sorted[std::max<std::size_t>(rank, 1) - 1];
}
} // namespace

Statistics summarise(std::vector<double> series)
{
    if (series.empty())
        return {};
    std::sort(series.begin(), series.end());
    Statistics result;
    result.mean = std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
    result.median = nearest_rank(series, 500);
    result.p99 = nearest_rank(series, 990);
    result.p999 = nearest_rank(series, 999);
    result.max = series.back();
    return result;
}
} // namespace ode_predictive_space::worlds
