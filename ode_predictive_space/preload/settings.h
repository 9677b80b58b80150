#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_SETTINGS_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_SETTINGS_H

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace ode_predictive_space::preload
{
/// What the environment asks for.
struct Settings
{
    std::set<int> replaced; ///< classes of spaces (dHashSpaceClass and so on) that predictive ones stand in for
    int proximity;          ///< a dPredictiveProximity constant
    bool stats = false;     ///< at exit, say what each space did
    std::string stats_file; ///< where; empty: on standard error
    bool compare = false;   ///< check every collide against all pairs
    std::string trace_file; ///< a line for every collide; empty: none
    bool counted = false;   ///< a launcher shows the counts
    bool watches() const { return stats || compare || counted || !trace_file.empty(); }
};

/// Reads the variables ODE_PREDICTIVE_SPACE, _PROXIMITY, _STATS, _COMPARE, _COUNTS and _TRACE.
///
/// @param variable gives a variable's value, or 0.
/// @param complaints gets a sentence for each value that is not known, for which the default is taken.
Settings read_settings(const std::function<const char *(const char *)> &variable, std::vector<std::string> &complaints);

/// "hash" for dHashSpaceClass, and so on.
const char *name_of_space_class(int space_class);
} // namespace ode_predictive_space::preload

#endif
