#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_REPORT_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_REPORT_H

#include "demos/haptic/haptic_run.h"
#include "ode_predictive_space/recording/page.h"

#include <nlohmann/json.hpp>

namespace ode_predictive_space::demo
{
/// What is printed; with plots, what is written with --report.
recording::Page page_of(const Options &options, const RunResult &result);

nlohmann::json json_of(const Options &options, const RunResult &result);
} // namespace ode_predictive_space::demo

#endif
