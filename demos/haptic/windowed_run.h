// A run of the probe with a window. The loop runs in a separate thread, the window in the caller's.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_WINDOWED_RUN_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_WINDOWED_RUN_H

#include "demos/haptic/haptic_run.h"

namespace ode_predictive_space::demo
{
/// Runs until the time is over or the window is closed. There must be a display. Once per process.
/// @return the result of the last run. @throws what HapticRun throws; std::runtime_error when a screenshot cannot be written.
RunResult run_in_window(const Options &options, const worlds::WorldFactory &factory, DemoDevice &device,
                        const haptics::NoticeSink &notice);
} // namespace ode_predictive_space::demo

#endif
