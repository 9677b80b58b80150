// The summary of a run of the probe.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_RUN_SUMMARY_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_RUN_SUMMARY_H

#include "demos/haptic/haptic_run.h"

#include <iosfwd>
#include <nlohmann/json.hpp>

namespace ode_predictive_space::demo
{
/// The run to come.
void print_beginning(std::ostream &out, const Options &options, bool window);

/// Its result.
void print_summary(std::ostream &out, const Options &options, const RunResult &result);

/// The summary as JSON.
nlohmann::json json_summary(const Options &options, const RunResult &result);
} // namespace ode_predictive_space::demo

#endif
