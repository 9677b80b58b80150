#include "tests/benchmarks/limit_costs.h"

#include "demos/runs/statistics.h"
#include "tests/benchmarks/weight.h"

#include <algorithm>
#include <ctime>
#include <map>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

/// The processor time that this thread has used, in milliseconds.
double processor_time()
{
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

template <typename Action> double time_of(Action action)
{
    const double before = processor_time();
    action();
    return processor_time() - before;
}

/// Pairs of one tick, without a list: there may be fifty million.
struct PairCount
{
    static void count(void *self, dGeomID, dGeomID) { ++static_cast<PairCount *>(self)->pairs; }

    static void count_and_hash(void *self, dGeomID first, dGeomID second)
    {
        auto &counts = *static_cast<PairCount *>(self);
        ++counts.pairs;
        const auto [low, high] = std::minmax({geom_index(first), geom_index(second)});
        counts.hash += hash_pairs({{low, high}});
    }

    static constexpr NearCallbacks counting = near_callbacks<&PairCount::count>;
    static constexpr NearCallbacks hashing = near_callbacks<&PairCount::count_and_hash>;

    std::uint64_t pairs = 0;
    std::uint64_t hash = 0;
};

OwnedSpace make_space_of(SpaceKind kind)
{
    return OwnedSpace(make_space(kind, WorldFactory({"gas", 1})));
}

void run_ticks(World &scene, dSpaceID space, const Limit &limit, LimitCosts &costs)
{
    PairCount counted;
    costs.first = time_of([&] { scene.collide(space, &counted, PairCount::counting); });
    for (int tick = 0; tick < limit.ticks; ++tick)
    {
        costs.move += time_of([&] { scene.advance(); }) / limit.ticks;
        costs.collide += time_of([&] { scene.collide(space, &counted, PairCount::counting); }) / limit.ticks;
    }
    costs.heap += static_cast<std::int64_t>(heap_in_use());
    PairCount last;
    scene.collide(space, &last, PairCount::hashing);
    costs.pairs = last.pairs;
    costs.pair_hash = last.hash;
}

LimitCosts median_of(const std::vector<LimitCosts> &runs)
{
    const auto median = [&](double LimitCosts::*member) {
        std::vector<double> values;
        for (const LimitCosts &costs : runs)
        {
            values.push_back(costs.*member);
        }
        return summarise(values).median;
    };
    LimitCosts result = runs.front();
    for (double LimitCosts::*member :
         {&LimitCosts::fill, &LimitCosts::first, &LimitCosts::move, &LimitCosts::collide, &LimitCosts::empty})
    {
        result.*member = median(member);
    }
    return result;
}
} // namespace

const WorldEntry &limit_world(const std::string &scene)
{
    const std::map<std::string, std::string> names = {{"many", "gas"},
                                                      {"nested", "spaces_in_spaces"},
                                                      {"beside", "spaces_side_by_side"},
                                                      {"planes-all", "planes_all"},
                                                      {"planes-apart", "planes_apart"}};
    const auto found = names.find(scene);
    return world_named(found == names.end() ? scene : found->second);
}

LimitCosts measure_once(const Limit &limit, SpaceKind kind, bool collides)
{
    LimitCosts costs;
    const WorldFactory factory({limit_world(limit.scene).name, limit.objects});
    costs.heap = -static_cast<std::int64_t>(heap_in_use());
    const OwnedSpace space = make_space_of(kind);
    std::unique_ptr<World> scene;
    costs.fill = time_of([&] { scene = factory.make(space.get()); });
    if (collides)
    {
        run_ticks(*scene, space.get(), limit, costs);
    }
    else
    {
        costs.heap += static_cast<std::int64_t>(heap_in_use());
    }
    costs.empty = time_of([&] { scene.reset(); });
    return costs;
}

std::vector<LimitCosts> measure_by_turns(const Limit &limit, const std::vector<SpaceKind> &kinds)
{
    std::vector<std::vector<LimitCosts>> runs(kinds.size());
    for (int round = 0; round < limit.rounds; ++round)
    {
        for (std::size_t i = 0; i < kinds.size(); ++i)
        {
            runs[i].push_back(measure_once(limit, kinds[i]));
        }
    }
    std::vector<LimitCosts> medians;
    for (const std::vector<LimitCosts> &of_space : runs)
    {
        medians.push_back(median_of(of_space));
    }
    return medians;
}
} // namespace ode_predictive_space::benchmarks
