#ifndef ODE_PREDICTIVE_SPACE_DEMOS_ODE_OPTIONS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_ODE_OPTIONS_H

#include <string>

namespace ode_predictive_space::ode_demos
{
struct Options
{
    std::string program;   ///< the demo's name
    std::string device;    ///< of the probe; empty: no probe
    std::string keys;      ///< pressed one after the other
    bool headless = false; ///< without a window: drawstuff reads the number of steps
};

/// Ignores unknown options, as drawstuff does. @throws std::invalid_argument when an option lacks its value.
Options read_options(int argc, char **argv);
} // namespace ode_predictive_space::ode_demos

#endif
