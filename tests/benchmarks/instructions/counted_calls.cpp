#include "tests/benchmarks/instructions/counted_calls.h"

using ode_predictive_space::benchmarks::Life;
using ode_predictive_space::benchmarks::Move;
using ode_predictive_space::benchmarks::Replay;
using ode_predictive_space::scenes::IndexPair;
using ode_predictive_space::scenes::PairList;
using ode_predictive_space::scenes::Scene;

void predictive_bench_counted_moves(Replay *replay, const std::vector<Move> *moves)
{
    replay->make(*moves);
}

void predictive_bench_bare_moves(Replay *replay, const std::vector<Move> *moves)
{
    replay->make(*moves);
}

void predictive_bench_counted_collide(Scene *scene, dSpaceID space, PairList *list)
{
    scene->collide(space, *list);
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

void predictive_bench_counted_advance(Scene *scene)
{
    scene->advance();
}

void predictive_bench_counted_respond(Scene *scene, const std::vector<IndexPair> *pairs)
{
    scene->respond(*pairs);
}
