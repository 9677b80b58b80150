// What a space takes for a scene at a limit: from the first geom to the last.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_LIMIT_COSTS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_LIMIT_COSTS_H

#include "demos/runs/spaces.h"

#include <cstdint>

namespace ode_predictive_space::benchmarks
{
/// Times are of the processor in this thread, in milliseconds.
struct LimitCosts
{
    double fill = 0;             ///< all geoms created in the space
    double first = 0;            ///< the first collide
    double move = 0;             ///< the motion of a later tick, with the notices to the space: the mean
    double collide = 0;          ///< the collide of a later tick: the mean
    double empty = 0;            ///< all geoms destroyed
    std::int64_t heap = 0;       ///< bytes from the heap after the last tick, with the geoms
    std::uint64_t pairs = 0;     ///< after the last tick
    std::uint64_t pair_hash = 0; ///< of these pairs
};

/// What is measured.
struct Limit
{
    std::string scene; ///< see limit_world()
    int objects;
    int ticks;  ///< after the first one
    int rounds; ///< measurements per space
};

/// The world of a limit: those whose names other worlds have are called otherwise.
///
/// @throws std::invalid_argument for a name that no world has.
const worlds::WorldEntry &limit_world(const std::string &scene);

/// Fill an empty space with this scene, make its ticks, empty the space.
///
/// @param collides false: the geoms are made and destroyed only.
LimitCosts measure_once(const Limit &limit, worlds::SpaceKind kind, bool collides = true);

/// Measure some spaces in turn, limit.rounds times: of each time the median. The load of the machine affects all of them alike.
std::vector<LimitCosts> measure_by_turns(const Limit &limit, const std::vector<worlds::SpaceKind> &kinds);
} // namespace ode_predictive_space::benchmarks

#endif
