// Lower bounds for the time of any broad phase.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_FLOOR_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_FLOOR_H

#include "demos/runs/contender.h"
#include "demos/worlds/world.h"

namespace ode_predictive_space::benchmarks
{
/// dSpaceCollide() reads the position of each moved geom once, and calls the callback for pairs that are known beforehand:
/// another copy of the scene, some ticks ahead, has found them. The scene must not destroy geoms.
std::unique_ptr<worlds::Contender> make_floor(const worlds::WorldFactory &factory);

/// As above, with the bounding boxes of the moved geoms in these pairs: a report of exactly the overlapping boxes needs them.
std::unique_ptr<worlds::Contender> make_floor_with_boxes(const worlds::WorldFactory &factory);
} // namespace ode_predictive_space::benchmarks

#endif
