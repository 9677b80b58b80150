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

/// Empty if the variant is not faster than the first space in the table. The times are medians of whole ticks.
std::string faster_variant_text(const std::string &variant, double variant_time, const std::string &first,
                                double first_time);

void print_introduction(std::ostream &out, const WorldSpec &spec, int ticks, std::size_t spaces);

void print_report(std::ostream &out, const WorldRuns &runs);

nlohmann::json json_report(const WorldRuns &runs, const WorldSpec &spec);
} // namespace ode_predictive_space::worlds

#endif
