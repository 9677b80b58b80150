// A scene whose ticks are counted: one process moves it, another one, under callgrind, has it in a space.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_COUNTED_RUN_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_COUNTED_RUN_H

#include "demos/worlds/world.h"
#include "tests/benchmarks/instructions/counts.h"
#include "tests/benchmarks/instructions/whole_counts.h"

#include <string>

namespace ode_predictive_space::benchmarks
{
struct CountedRun
{
    worlds::WorldSpec spec;
    std::string space; ///< a contender's name
    int warm_up_ticks = 0;
    int ticks = 0;      ///< that are counted
    int period = 1;     ///< ticks from one that is counted to the next; not used for whole ticks
    bool whole = false; ///< the whole tick, with the step of the world
    int lives = 0; ///< not 0: the scene is made and destroyed so often, and lives for `ticks`; that is counted, too
    bool caches = false; ///< simulate caches

    int ticks_to_make() const { return warm_up_ticks + (ticks - 1) * period + 1; }
};

/// What a run counts the ticks of: a scene of the library, one that is stepped, or a world.
worlds::WorldFactory factory_of(const CountedRun &run);

/// Count it: run this program again under callgrind and feed it with the motion of the scene, so that only what is counted, and
/// not the scene, has to run in a simulated processor.
///
/// @param factory of run.spec
/// @throws std::runtime_error when valgrind is not there, or the other process fails.
Count count_instructions(const CountedRun &run, const worlds::WorldFactory &factory);

/// In the other process: make the ticks that come on the standard input.
///
/// @return the record that count_instructions() reads: {pairs, pair_hash}.
/// @throws std::runtime_error when the program was built without the headers of valgrind, or the input ends early.
nlohmann::json make_counted_ticks(const CountedRun &run);

/// Count whole ticks: run this program again under callgrind, where the scene makes its motion and contacts by itself.
///
/// @throws std::runtime_error when valgrind is not there, or the other process fails.
WholeCount count_whole_ticks(const CountedRun &run);

/// In the other process: make whole ticks.
///
/// @return the record that count_whole_ticks() reads: {calls, contacts, state_hash}.
/// @throws std::runtime_error when the program was built without the headers of valgrind.
nlohmann::json make_whole_ticks(const CountedRun &run);
} // namespace ode_predictive_space::benchmarks

#endif
