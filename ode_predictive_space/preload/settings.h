#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_SETTINGS_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_SETTINGS_H

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace ode_predictive_space::preload
{
struct Settings
{
    std::set<int> replaced;         ///< classes of spaces (dHashSpaceClass and so on) that predictive ones stand in for
    int proximity;                  ///< a dPredictiveProximity constant
    bool stats = false;             ///< write statistics of each space at exit
    std::string stats_file;         ///< file of the statistics; empty: standard error
    std::string trace_file;         ///< a line for every collide; empty: none
    std::string record_file;        ///< the recording; empty: none
    std::uint64_t record_limit = 0; ///< bytes
    bool monitors() const { return stats || !trace_file.empty() || !record_file.empty(); }
};

/// Bytes of a recording unless ODE_PREDICTIVE_RECORD_LIMIT is set.
constexpr std::uint64_t default_record_limit = std::uint64_t{256} << 20;

/// A number of bytes, at most 2^60, with or without K, M or G for 2^10, 2^20 or 2^30 of them; 0 for any other text.
std::uint64_t bytes_named(const std::string &text);

/// Reads ODE_PREDICTIVE_SPACE, _PROXIMITY, _STATS, _TRACE, _RECORD and _RECORD_LIMIT. @param variable gives a value, or 0.
/// @param complaints gets a sentence for each value that is not known, for which the default is taken.
Settings read_settings(const std::function<const char *(const char *)> &variable, std::vector<std::string> &complaints);

bool is_name_of_spaces(const std::string &word);

/// "hash" for dHashSpaceClass, and so on.
const char *name_of_space_class(int space_class);
} // namespace ode_predictive_space::preload

#endif
