#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_RUN_SUMMARY_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_RUN_SUMMARY_H

#include "demos/haptic/haptic_run.h"

#include <iosfwd>
#include <nlohmann/json.hpp>

namespace ode_predictive_space::demo
{
void print_beginning(std::ostream &out, const Options &options, bool window);

void print_summary(std::ostream &out, const Options &options, const RunResult &result);

nlohmann::json json_summary(const Options &options, const RunResult &result);
} // namespace ode_predictive_space::demo

#endif
