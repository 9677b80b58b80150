#include "ode_predictive_space/recording/curves.h"

namespace ode_predictive_space::recording
{
namespace
{
template <typename Value>
Curve curve_of(std::string name, const BoundedSeries &series, double x_per_value, Value value_of_column)
{
    Curve curve;
    curve.name = std::move(name);
    const double column_width = x_per_value * static_cast<double>(series.values_per_column());
    for (std::size_t i = 0; i < series.columns(); ++i)
        curve.points.push_back({(static_cast<double>(i) + 0.5) * column_width, value_of_column(i)});
    return curve;
}
} // namespace

Curve means(std::string name, const BoundedSeries &series, double x_per_value, double scale)
{
    return curve_of(std::move(name), series, x_per_value, [&](std::size_t i) { return scale * series.mean(i); });
}

Curve largest(std::string name, const BoundedSeries &series, double x_per_value, double scale)
{
    return curve_of(std::move(name), series, x_per_value, [&](std::size_t i) { return scale * series.largest(i); });
}
} // namespace ode_predictive_space::recording
