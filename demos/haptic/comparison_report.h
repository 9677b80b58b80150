// The output of a comparison of spaces: before, after, and to a file.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_COMPARISON_REPORT_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_COMPARISON_REPORT_H

#include "demos/runs/world_run.h"

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

namespace ode_predictive_space::worlds
{
/// The gain in the sense of Vogiannou et al.: (T_other - T_ours) / T_other, in percent.
double gain_percent(double ours, double other);

/// Says by how much a variant of the predictive space is faster than the first one in the table, and how to choose it; empty if
/// it is not faster. The times are medians of whole ticks.
std::string faster_variant_text(const std::string &variant, double variant_time, const std::string &first,
                                double first_time);

/// The run to come.
void print_introduction(std::ostream &out, const WorldSpec &spec, int ticks, std::size_t spaces);

/// The table and its interpretation.
void print_report(std::ostream &out, const WorldRuns &runs);

/// The report as JSON.
nlohmann::json json_report(const WorldRuns &runs, const WorldSpec &spec);
} // namespace ode_predictive_space::worlds

#endif
