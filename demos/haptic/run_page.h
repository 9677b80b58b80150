#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_RUN_PAGE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_RUN_PAGE_H

#include "demos/haptic/haptic_run.h"
#include "demos/runs/world_run.h"
#include "ode_predictive_space/recording/page.h"

namespace ode_predictive_space::demo
{
/// Time per step, force, period of the servo, and predicted against actual contacts.
recording::Page page_of_run(const Options &options, const RunResult &result);

recording::Page page_of_comparison(const worlds::WorldRuns &runs, double tick_seconds);
} // namespace ode_predictive_space::demo

#endif
