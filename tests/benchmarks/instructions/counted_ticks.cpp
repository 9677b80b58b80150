// The process under callgrind.

#include "tests/benchmarks/instructions/counted_run.h"

#include "demos/runs/spaces.h"
#include "demos/runs/table.h"
#include "tests/benchmarks/instructions/callgrind_requests.h"
#include "tests/benchmarks/instructions/counted_calls.h"
#include "tests/benchmarks/instructions/motion_stream.h"

#include <cstdio>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

/// The scene in the space that is counted, and once more where it only moves: in a space that is never collided or, where the
/// making of a space is counted, in none.
class CountedTicks
{
public:
    CountedTicks(const CountedRun &run, const WorldFactory &factory)
        : counted_(run.space, factory), bare_(run.lives > 0 ? "" : space_name(SpaceKind::simple), factory)
    {}

    void begin(const std::vector<Move> &start, int ticks)
    {
        CALLGRIND_TOGGLE_COLLECT;
        predictive_bench_bare_birth(&bare_);
        predictive_bench_counted_birth(&counted_);
        CALLGRIND_TOGGLE_COLLECT;
        counted_.replay().make(start);
        bare_.replay().make(start);
        counted_.contender().prepare(ticks);
    }

    void end()
    {
        CALLGRIND_TOGGLE_COLLECT;
        predictive_bench_bare_death(&bare_);
        predictive_bench_counted_death(&counted_);
        CALLGRIND_TOGGLE_COLLECT;
    }

    void make(const std::vector<Move> &moves, bool is_counted = true)
    {
        list_.clear();
        toggle_if(is_counted);
        predictive_bench_bare_moves(&bare_.replay(), &moves);
        predictive_bench_counted_moves(&counted_.replay(), &moves);
        predictive_bench_counted_collide(&counted_.replay().scene(), counted_.contender().space(), &list_,
                                         &PairList::near);
        toggle_if(is_counted);
        counted_.contender().finish(list_);
        pairs_ += list_.size();
        hash_.add_tick(hash_pairs(list_.sorted()));
        counted_.contender().end_tick();
    }

    nlohmann::json record() const { return {{"pairs", pairs_}, {"pair_hash", hexadecimal(hash_.value())}}; }

private:
    static void toggle_if(bool is_counted)
    {
        if (is_counted)
        {
            CALLGRIND_TOGGLE_COLLECT;
        }
    }

    Life counted_;
    Life bare_;
    PairList list_;
    std::uint64_t pairs_ = 0;
    PairHash hash_;
};

nlohmann::json make_one_life(const CountedRun &run, const WorldFactory &factory)
{
    CountedTicks counted(run, factory);
    counted.begin(read_moves(stdin), run.ticks_to_make());
    for (int tick = 0; tick < run.warm_up_ticks; ++tick)
    {
        counted.make(read_moves(stdin));
    }
    // Before this nothing is counted, and the processor is simulated at a fraction of the cost.
    CALLGRIND_START_INSTRUMENTATION;
    for (int tick = 0; tick < run.ticks_to_make() - run.warm_up_ticks; ++tick)
    {
        counted.make(read_moves(stdin), tick % run.period == 0);
    }
    return counted.record();
}

/// All lives are the same; the first one, which finds the heap empty, is not counted.
nlohmann::json make_lives(const CountedRun &run, const WorldFactory &factory)
{
    const std::vector<Move> start = read_moves(stdin);
    Motion motion;
    for (int tick = 0; tick < run.ticks; ++tick)
    {
        motion.push_back(read_moves(stdin));
    }
    CountedTicks counted(run, factory);
    for (int life = 0; life <= run.lives; ++life)
    {
        if (life == 1)
        {
            CALLGRIND_START_INSTRUMENTATION;
        }
        counted.begin(start, run.ticks);
        for (const std::vector<Move> &moves : motion)
        {
            counted.make(moves);
        }
        counted.end();
    }
    return counted.record();
}
} // namespace

nlohmann::json make_counted_ticks(const CountedRun &run)
{
    CountedRun unsettled = run;
    if (run.spec.name == "pile")
    {
        unsettled.spec.name = "settling"; // where it has come to rest is in the motion
    }
    const WorldFactory factory = factory_of(unsettled);
    return run.lives > 0 ? make_lives(run, factory) : make_one_life(run, factory);
}
} // namespace ode_predictive_space::benchmarks
