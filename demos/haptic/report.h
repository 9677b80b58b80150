#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_REPORT_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_REPORT_H

#include "demos/haptic/haptic_run.h"
#include "ode_predictive_space/recording/page.h"

#include <nlohmann/json.hpp>

namespace ode_predictive_space::demo
{
struct Report
{
    recording::Page page; ///< its text is also printed
    nlohmann::json json;
    bool is_good = true; ///< false: compared spaces did not report the same pairs
};

Report report_of(const Options &options, const RunResult &result);

/// Measures the costs of spaces, alternating. ODE must be initialised.
Report compare_spaces(const Options &options);
} // namespace ode_predictive_space::demo

#endif
