// What no way to find pairs can be faster than.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_FLOOR_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_FLOOR_H

#include "demos/runs/contender.h"
#include "demos/worlds/world.h"

namespace ode_predictive_space::benchmarks
{
/// dSpaceCollide() reads the position of each geom that has moved, once, and calls the callback for the pairs, which it
/// knows beforehand: another copy of the scene, a turn ahead, has found them. For scenes that destroy no geoms.
std::unique_ptr<worlds::Contender> make_floor(const worlds::WorldFactory &factory);

/// The same, and has the bounding boxes of these pairs computed where they have moved, "floor-boxes": whoever reports the
/// pairs whose boxes overlap, and no others, must know them, unless it can be told from elsewhere.
std::unique_ptr<worlds::Contender> make_floor_with_boxes(const worlds::WorldFactory &factory);
} // namespace ode_predictive_space::benchmarks

#endif
