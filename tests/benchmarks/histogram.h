// How often ticks take how long.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_HISTOGRAM_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_HISTOGRAM_H

#include <cstddef>
#include <iosfwd>
#include <vector>

namespace ode_predictive_space::benchmarks
{
/// Bins of equal ratio: counts[i] values lie from edges[i] on and below edges[i + 1], in the last bin also at its end.
struct Histogram
{
    std::vector<double> edges;
    std::vector<std::size_t> counts;
};

/// Of positive values; values of 0 or less count as the smallest positive one. Ten bins per factor of ten, as many as needed.
Histogram histogram_of(const std::vector<double> &values);

/// In text, one line per bin; the bars grow with the logarithm of the counts, so that a single tick can be seen.
void print(std::ostream &out, const Histogram &histogram);
} // namespace ode_predictive_space::benchmarks

#endif
