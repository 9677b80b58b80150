// The calls whose instructions are counted. They have C names, by which they are found in what callgrind writes, and a file of
// their own, so that the compiler cannot merge them with their callers.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_COUNTED_CALLS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_COUNTED_CALLS_H

#include "demos/worlds/world.h"
#include "tests/benchmarks/instructions/life.h"

extern "C" {
/// The moves of one tick in the space that is measured: motion and notices.
void predictive_bench_counted_moves(ode_predictive_space::benchmarks::Replay *replay,
                                    const std::vector<ode_predictive_space::benchmarks::Move> *moves);

/// The same moves in a space that is never collided. All its geoms stay dirty, and ODE gives it no notice of them: this
/// is the motion by itself.
void predictive_bench_bare_moves(ode_predictive_space::benchmarks::Replay *replay,
                                 const std::vector<ode_predictive_space::benchmarks::Move> *moves);

/// dSpaceCollide(), or what a scene calls in its place.
void predictive_bench_counted_collide(ode_predictive_space::worlds::World *scene, dSpaceID space,
                                      ode_predictive_space::worlds::PairList *list,
                                      const ode_predictive_space::worlds::NearCallbacks *near);

/// A world begins: its space and its geoms are made. Without a space, or with one.
void predictive_bench_counted_birth(ode_predictive_space::benchmarks::Life *life);
void predictive_bench_bare_birth(ode_predictive_space::benchmarks::Life *life);

/// A world ends, and its space with it.
void predictive_bench_counted_death(ode_predictive_space::benchmarks::Life *life);
void predictive_bench_bare_death(ode_predictive_space::benchmarks::Life *life);

/// The motion of a tick that a scene makes by itself, with the step of its world.
void predictive_bench_counted_advance(ode_predictive_space::worlds::World *scene);

/// What a scene does with the pairs of a tick: dCollide() and contact joints.
void predictive_bench_counted_respond(ode_predictive_space::worlds::World *scene,
                                      const std::vector<ode_predictive_space::worlds::IndexPair> *pairs);
}

#endif
