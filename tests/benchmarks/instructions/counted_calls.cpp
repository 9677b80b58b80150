#include "tests/benchmarks/instructions/counted_calls.h"

using ode_predictive_space::benchmarks::Move;
using ode_predictive_space::benchmarks::Replay;
using ode_predictive_space::scenes::PairList;

void predictive_bench_counted_moves(Replay *replay, const std::vector<Move> *moves)
{
    replay->make(*moves);
}

void predictive_bench_bare_moves(Replay *replay, const std::vector<Move> *moves)
{
    replay->make(*moves);
}

void predictive_bench_counted_collide(dSpaceID space, PairList *list)
{
    dSpaceCollide(space, list, &PairList::collect);
}
