#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_STATISTICS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_STATISTICS_H

#include <vector>

namespace ode_predictive_space::worlds
{
/// All in the unit of the series.
struct Statistics
{
    double mean = 0;
    double median = 0;
    double p99 = 0;  ///< 99 of 100 values do not exceed it
    double p999 = 0; ///< 999 of 1000 values do not exceed it
    double max = 0;
};

/// All 0 for an empty series. Percentiles are by nearest rank, so each is one of the measured values.
Statistics summarise(std::vector<double> series);
} // namespace ode_predictive_space::worlds

#endif
