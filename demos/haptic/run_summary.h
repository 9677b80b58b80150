// What a run of the probe has to say at its end.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_RUN_SUMMARY_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_RUN_SUMMARY_H

#include "demos/haptic/haptic_run.h"

#include <iosfwd>
#include <nlohmann/json.hpp>

namespace ode_predictive_space::demo
{
/// What is going to be run.
void print_beginning(std::ostream &out, const Options &options, bool window);

/// What came of it.
void print_summary(std::ostream &out, const Options &options, const RunResult &result);

/// The same for other programs.
nlohmann::json json_summary(const Options &options, const RunResult &result);
} // namespace ode_predictive_space::demo

#endif
