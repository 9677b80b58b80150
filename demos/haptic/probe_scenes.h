// The scenes that are fit for a probe.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_PROBE_SCENES_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_PROBE_SCENES_H

#include "demos/worlds/world.h"

namespace ode_predictive_space::demo
{
const std::vector<std::string> &scenes_for_probes();

/// Without a probe of the scene's own.
///
/// @param spec its name is one of scenes_for_probes().
worlds::WorldFactory factory_for_probe(worlds::WorldSpec spec);
} // namespace ode_predictive_space::demo

#endif
