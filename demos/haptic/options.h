#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_OPTIONS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_OPTIONS_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ode_predictive_space::demo
{
struct Options
{
    std::string scene = "mix";
    std::string space = "predictive-box";
    std::string device = "virtual";
    std::string law;        ///< empty: that of the recording in a replay, otherwise proxy
    double stiffness = 500; ///< N/m, at the hand
    double damping = 0;     ///< N s/m, at the hand
    double friction = 0;
    int objects = 1000;
    double seconds = 0; ///< simulated; 0: not given
    std::uint64_t seed = 1;
    bool decoupled = false;
    bool fast = false; ///< simulated time, as fast as possible
    double rate = 0;   ///< Hz; of the servo; 0: not given
    std::string record_file;
    std::string json_file;
    std::string report_folder; ///< empty: no page
    bool headless = false;
    std::string screenshot_file;
    double screenshot_time = 1; ///< simulated seconds
};

const std::vector<std::string> &scenes_for_probes();

/// @return the exit status when the program has to end without a run: it has printed its help, or what is wrong.
std::optional<int> parse_command_line(int argc, char **argv, Options &options);
} // namespace ode_predictive_space::demo

#endif
