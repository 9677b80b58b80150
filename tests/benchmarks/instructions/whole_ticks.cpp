// The process under callgrind, in which a scene makes its motion and contacts by itself.

#include "tests/benchmarks/instructions/counted_run.h"

#include "demos/runs/spaces.h"
#include "demos/runs/table.h"
#include "ode_predictive_space/haptics/device/random.h"
#include "tests/benchmarks/contenders/contenders.h"
#include "tests/benchmarks/instructions/callgrind_requests.h"
#include "tests/benchmarks/instructions/counted_calls.h"

#include <cstring>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

class WholeTicks
{
public:
    WholeTicks(const std::string &space, const WorldFactory &factory)
        : contender_(benchmarks::make_contender(space, factory)), scene_(factory.make(contender_->space()))
    {}

    /// What comes between the counted calls serves the comparison of spaces alone.
    void make()
    {
        list_.clear();
        CALLGRIND_TOGGLE_COLLECT;
        predictive_bench_counted_advance(scene_.get());
        predictive_bench_counted_collide(scene_.get(), contender_->space(), &list_, &PairList::near);
        CALLGRIND_TOGGLE_COLLECT;
        contender_->finish(list_);
        const std::vector<IndexPair> pairs = list_.sorted();
        CALLGRIND_TOGGLE_COLLECT;
        predictive_bench_counted_respond(scene_.get(), &pairs);
        CALLGRIND_TOGGLE_COLLECT;
        contender_->end_tick();
        calls_ += pairs.size();
        contacts_ += scene_->contacts();
    }

    void start_counting()
    {
        calls_ = 0;
        contacts_ = 0;
    }

    nlohmann::json record() const
    {
        return {{"calls", calls_}, {"contacts", contacts_}, {"state_hash", hexadecimal(hash_of_places())}};
    }

private:
    std::uint64_t hash_of_places() const
    {
        std::uint64_t hash = 0;
        for (const dGeomID geom : scene_->geoms())
        {
            for (int axis = 0; geom != nullptr && dGeomGetClass(geom) != dPlaneClass && axis < 3; ++axis)
            {
                const double place = dGeomGetPosition(geom)[axis];
                std::uint64_t bits = 0;
                std::memcpy(&bits, &place, sizeof bits);
                hash = haptics::mix_bits(hash ^ bits);
            }
        }
        return hash;
    }

    std::unique_ptr<Contender> contender_; // before the scene, whose geoms are in its space
    std::unique_ptr<World> scene_;
    PairList list_;
    std::uint64_t calls_ = 0;
    std::uint64_t contacts_ = 0;
};
} // namespace

nlohmann::json make_whole_ticks(const CountedRun &run)
{
    const WorldFactory factory = factory_of(run);
    WholeTicks whole(run.space, factory);
    for (int tick = 0; tick < run.warm_up_ticks; ++tick)
    {
        whole.make();
    }
    whole.start_counting();
    CALLGRIND_START_INSTRUMENTATION;
    for (int tick = 0; tick < run.ticks; ++tick)
    {
        whole.make();
    }
    return whole.record();
}
} // namespace ode_predictive_space::benchmarks
