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

/// As above, and computes the bounding boxes of the moved geoms in these pairs, "floor-boxes": a broad phase that reports
/// exactly the overlapping boxes needs them, unless they are known from elsewhere.
std::unique_ptr<worlds::Contender> make_floor_with_boxes(const worlds::WorldFactory &factory);
} // namespace ode_predictive_space::benchmarks

#endif
