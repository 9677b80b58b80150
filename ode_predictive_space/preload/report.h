// The text of statistics and comparisons.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_REPORT_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_REPORT_H

#include <deque>
#include <string>

#include "ode_predictive_space/preload/counts.h"
#include "ode_predictive_space/preload/settings.h"

namespace ode_predictive_space::preload
{
/// The statistics of one process, as the settings ask for them: for each space a line, for a predictive one that was collided a
/// second; then a line about the comparison. Empty when nothing is asked, or there is nothing to say.
std::string report_text(const Settings &settings, const char *program, int process_id,
                        const std::deque<SpaceCounts> &spaces);

/// Writes a report to where the settings want it, or else to standard error, unless it is empty.
///
/// @return whether it is where it is wanted.
bool write_report(const Settings &settings, const std::string &text);
} // namespace ode_predictive_space::preload

#endif
