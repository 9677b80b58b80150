#include "tests/benchmarks/histogram.h"

#include "demos/runs/table.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <ostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
constexpr double bins_per_decade = 10;
constexpr int marks_per_decade = 10;

double smallest_positive(const std::vector<double> &values)
{
    double smallest = std::numeric_limits<double>::infinity();
    for (const double value : values)
    {
        smallest = value > 0 ? std::min(smallest, value) : smallest;
    }
    return smallest;
}

std::string bar(std::size_t count)
{
    const double marks = count == 0 ? 0 : 1 + marks_per_decade * std::log10(static_cast<double>(count));
    return std::string(static_cast<std::size_t>(marks), '#');
}
} // namespace

Histogram histogram_of(const std::vector<double> &values)
{
    Histogram histogram;
    const double smallest = smallest_positive(values);
    if (!std::isfinite(smallest))
    {
        return histogram;
    }
    const double largest = *std::max_element(values.begin(), values.end());
    const auto bin_of = [](double value) { return std::floor(bins_per_decade * std::log10(value)); };
    const double first = bin_of(smallest);
    const auto bins = static_cast<std::size_t>(bin_of(largest) - first) + 1;
    for (std::size_t i = 0; i <= bins; ++i)
    {
        histogram.edges.push_back(std::pow(10.0, (first + static_cast<double>(i)) / bins_per_decade));
    }
    histogram.counts.resize(bins);
    for (const double value : values)
    {
        ++histogram.counts[static_cast<std::size_t>(bin_of(std::max(value, smallest)) - first)];
    }
    return histogram;
}

void print(std::ostream &out, const Histogram &histogram)
{
    out << "   from (µs)      ticks\n";
    for (std::size_t i = 0; i < histogram.counts.size(); ++i)
    {
        const std::size_t count = histogram.counts[i];
        out << std::setw(12) << worlds::fixed(histogram.edges[i], 1) << std::setw(11) << worlds::grouped(count) << "  "
            << bar(count) << '\n';
    }
}
} // namespace ode_predictive_space::benchmarks
