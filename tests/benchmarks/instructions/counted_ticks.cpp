// The process under callgrind.

#include "tests/benchmarks/instructions/counted_run.h"

#include "demos/scenes/spaces.h"
#include "demos/scenes/table.h"
#include "tests/benchmarks/contenders/contenders.h"
#include "tests/benchmarks/instructions/callgrind_requests.h"
#include "tests/benchmarks/instructions/counted_calls.h"
#include "tests/benchmarks/instructions/motion_stream.h"

#include <cstdio>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace scenes;

/// The scene in the space that is counted, and once more in one that only moves.
class CountedTicks
{
public:
    CountedTicks(const std::string &space, const SceneFactory &factory)
        : contender_(benchmarks::make_contender(space, factory)), replay_(factory, contender_->space()),
          bare_space_(make_space(SpaceKind::simple, factory)), bare_replay_(factory, bare_space_.get())
    {}

    void begin(const std::vector<Move> &start, int ticks)
    {
        replay_.make(start);
        bare_replay_.make(start);
        contender_->prepare(ticks);
    }

    void make(const std::vector<Move> &moves)
    {
        list_.clear();
        CALLGRIND_TOGGLE_COLLECT;
        predictive_bench_bare_moves(&bare_replay_, &moves);
        predictive_bench_counted_moves(&replay_, &moves);
        predictive_bench_counted_collide(contender_->space(), &list_);
        CALLGRIND_TOGGLE_COLLECT;
        contender_->finish(list_);
        pairs_ += list_.size();
        hash_.add_tick(hash_pairs(list_.sorted()));
        contender_->end_tick();
    }

    nlohmann::json record() const { return {{"pairs", pairs_}, {"pair_hash", hexadecimal(hash_.value())}}; }

private:
    std::unique_ptr<Contender> contender_; // before the replay, whose geoms are in its space
    Replay replay_;
    OwnedSpace bare_space_;
    Replay bare_replay_;
    PairList list_;
    std::uint64_t pairs_ = 0;
    PairHash hash_;
};
} // namespace

nlohmann::json make_counted_ticks(const CountedRun &run)
{
    SceneSpec spec = run.spec;
    spec.settled = false; // where a pile has come to rest is in the motion
    const SceneFactory factory(spec);
    CountedTicks counted(run.space, factory);
    counted.begin(read_moves(stdin), run.warm_up_ticks + run.ticks);
    for (int tick = 0; tick < run.warm_up_ticks; ++tick)
    {
        counted.make(read_moves(stdin));
    }
    // Before this nothing is counted, and the processor is simulated at a fraction of the cost.
    CALLGRIND_START_INSTRUMENTATION;
    for (int tick = 0; tick < run.ticks; ++tick)
    {
        counted.make(read_moves(stdin));
    }
    return counted.record();
}
} // namespace ode_predictive_space::benchmarks
