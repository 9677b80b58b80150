#ifndef ODE_PREDICTIVE_SPACE_RECORDING_CURVES_H
#define ODE_PREDICTIVE_SPACE_RECORDING_CURVES_H

#include "ode_predictive_space/recording/bounded_series.h"
#include "ode_predictive_space/recording/page.h"

namespace ode_predictive_space::recording
{
/// A curve through the mean of each column, in the middle of the column.
/// @param x_per_value from one value to the next on the x axis. @param scale from the unit of the values to that of the plot.
Curve means(std::string name, const BoundedSeries &series, double x_per_value, double scale);

Curve largest(std::string name, const BoundedSeries &series, double x_per_value, double scale);
} // namespace ode_predictive_space::recording

#endif
