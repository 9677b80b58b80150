// Bullet's broad phases on ODE's geoms.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_BULLET_SPACE_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_BULLET_SPACE_H

#include "demos/runs/contender.h"
#include "demos/worlds/world.h"

namespace ode_predictive_space::benchmarks
{
/// btDbvtBroadphase. Each tick tells it the boxes of the geoms that have moved, rounded outwards to its single precision,
/// lets it find its pairs, and passes on those whose exact boxes overlap.
std::unique_ptr<worlds::Contender> make_bullet_dbvt();

/// The same with btAxisSweep3 or, where that has too few handles, bt32BitAxisSweep3; without their accelerators for rays,
/// which nobody asks here.
std::unique_ptr<worlds::Contender> make_bullet_sap(const worlds::WorldFactory &factory);
} // namespace ode_predictive_space::benchmarks

#endif
