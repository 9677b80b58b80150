// Bullet's broad phases on ODE's geoms.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_BULLET_SPACE_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_BULLET_SPACE_H

#include "demos/worlds/world.h"
#include "tests/benchmarks/contenders/contender.h"

namespace ode_predictive_space::benchmarks
{
/// btDbvtBroadphase gets the boxes of moved geoms, rounded outwards to floats. Pairs of overlapping exact boxes are reported.
std::unique_ptr<Contender> make_bullet_dbvt();

/// As above with btAxisSweep3 or, if that has too few handles, bt32BitAxisSweep3; without their accelerators for rays.
std::unique_ptr<Contender> make_bullet_sap(const worlds::WorldFactory &factory);
} // namespace ode_predictive_space::benchmarks

#endif
