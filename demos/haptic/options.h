// What predictive_haptic_demo can be asked for.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_OPTIONS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_OPTIONS_H

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace ode_predictive_space::demo
{
struct Options
{
    std::string scene = "mix";
    std::vector<std::string> spaces; ///< empty: predictive alone, or all when they are compared
    std::string device = "virtual";
    std::string law = "penalty";
    double stiffness = 500; ///< N/m, at the hand
    double damping = 0;     ///< N s/m, at the hand
    double friction = 0;
    int objects = 1000;
    double seconds = 0; ///< simulated; 0: not said
    std::uint64_t seed = 1;
    bool decoupled = false;
    bool fast = false; ///< simulated time, as fast as it goes
    double rate = 0;   ///< Hz; of the servo; 0: not said
    std::string record_file;
    std::string replay_file;
    std::string json_file;
    bool headless = false;
    bool compare = false;
    std::string screenshot_file;
    double screenshot_time = 1; ///< simulated seconds
    bool wants_one_run = false; ///< something was asked for that only a run of one probe in one space has
};

/// The scenes in which a probe has something to do.
const std::vector<std::string> &scenes_for_probes();

/// Declare them all; `options` must outlive the parsing.
void declare_options(CLI::App &app, Options &options);

/// What parsing alone does not see: options that contradict each other.
///
/// @throws std::invalid_argument
void complete(Options &options, const CLI::App &app);
} // namespace ode_predictive_space::demo

#endif
