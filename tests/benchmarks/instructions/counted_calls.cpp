#include "tests/benchmarks/instructions/counted_calls.h"

using ode_predictive_space::benchmarks::Life;
using ode_predictive_space::benchmarks::Move;
using ode_predictive_space::benchmarks::Replay;
using ode_predictive_space::worlds::IndexPair;
using ode_predictive_space::worlds::NearCallbacks;
using ode_predictive_space::worlds::PairList;
using ode_predictive_space::worlds::World;

void predictive_bench_counted_moves(Replay *replay, const std::vector<Move> *moves)
{
    replay->make(*moves);
}

void predictive_bench_bare_moves(Replay *replay, const std::vector<Move> *moves)
{
    replay->make(*moves);
}

void predictive_bench_counted_collide(World *scene, dSpaceID space, PairList *list, const NearCallbacks *near)
{
    scene->collide(space, list, *near);
}

void predictive_bench_counted_birth(Life *life)
{
    life->begin();
}

void predictive_bench_bare_birth(Life *life)
{
    life->begin();
}

void predictive_bench_counted_death(Life *life)
{
    life->end();
}

void predictive_bench_bare_death(Life *life)
{
    life->end();
}

void predictive_bench_counted_advance(World *scene)
{
    scene->advance();
}

void predictive_bench_counted_respond(World *scene, const std::vector<IndexPair> *pairs)
{
    scene->respond(*pairs);
}
