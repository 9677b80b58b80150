#ifndef ODE_PREDICTIVE_SPACE_RECORDING_DRAWING_H
#define ODE_PREDICTIVE_SPACE_RECORDING_DRAWING_H

#include "ode_predictive_space/recording/page.h"

namespace ode_predictive_space::recording
{
std::string escaped(const std::string &text);

/// The heading, the plot and its legend as HTML; empty for a plot without points.
std::string svg(const Plot &plot);
} // namespace ode_predictive_space::recording

#endif
