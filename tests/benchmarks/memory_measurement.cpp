#include "tests/benchmarks/memory_measurement.h"

#include "tests/benchmarks/weight.h"

#include <algorithm>
#include <limits>
#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace ode_predictive_space::worlds;

/// Notes the heap at the first pair that is reported, and the pairs for a scene that needs them.
struct AtWork
{
    static void near(void *data, dGeomID first, dGeomID second)
    {
        auto &self = *static_cast<AtWork *>(data);
        if (self.notes_pairs)
        {
            PairList::collect(&self.pairs, first, second);
        }
        if (self.wanted)
        {
            self.heap = heap_in_use();
            self.wanted = false;
        }
    }

    bool notes_pairs = false;
    PairList pairs;
    bool wanted = false;
    std::int64_t heap = 0;
};

bool is_time(int tick, int ticks, int samples)
{
    return static_cast<std::int64_t>(tick) * samples / ticks != static_cast<std::int64_t>(tick - 1) * samples / ticks;
}

std::int64_t counted_bytes(dSpaceID space)
{
    return static_cast<std::int64_t>(told_bytes(space).value_or(0));
}

std::int64_t postponed_pairs(dSpaceID space)
{
    dPredictiveSpaceCounters counters{};
    if (dSpaceIsPredictive(space) != 0)
    {
        dPredictiveSpaceGetCounters(space, &counters, sizeof counters);
    }
    return static_cast<std::int64_t>(counters.postponed);
}

std::int64_t near_pairs(dSpaceID space)
{
    dPredictiveSpaceStats stats{};
    if (dSpaceIsPredictive(space) != 0)
    {
        dPredictiveSpaceGetStats(space, &stats);
    }
    return static_cast<std::int64_t>(stats.near);
}

/// The program's memory with a scene in a space, over what it was before. `collides` is false for the scene alone.
std::vector<MemorySample> watch(OwnedSpace space, const WorldFactory &factory, int ticks, int samples, bool collides,
                                const std::function<void(int)> &progress)
{
    std::vector<MemorySample> result;
    result.reserve(static_cast<std::size_t>(samples));
    AtWork at_work;
    const std::int64_t before = heap_in_use();
    const std::unique_ptr<World> scene = factory.make(space.get());
    at_work.notes_pairs = collides && !scene->moves_by_itself();
    for (int tick = 1; tick <= ticks; ++tick)
    {
        const bool looks = is_time(tick, ticks, samples);
        scene->advance();
        at_work.wanted = looks;
        if (collides)
        {
            dSpaceCollide(space.get(), &at_work, &AtWork::near);
        }
        if (at_work.notes_pairs)
        {
            scene->respond(at_work.pairs.sorted());
            at_work.pairs.clear();
        }
        if (!looks)
        {
            continue;
        }
        const std::int64_t heap = heap_in_use();
        result.push_back({tick, counted_bytes(space.get()), heap - before,
                          (collides && !at_work.wanted ? std::max(at_work.heap, heap) : heap) - before,
                          postponed_pairs(space.get()), near_pairs(space.get())});
        if (progress)
        {
            progress(tick);
        }
    }
    return result;
}
} // namespace

MemoryResult measure_memory(SpaceKind kind, const WorldSpec &spec, int ticks, int samples,
                            const std::function<void(int)> &progress)
{
    const WorldFactory factory(spec);
    // A space that was never collided keeps the geoms in ODE's list and nothing else.
    const std::vector<MemorySample> alone =
        watch(OwnedSpace(make_space(SpaceKind::simple, factory)), factory, ticks, samples, false, {});
    MemoryResult result{kind, spec, {}};
    result.samples = watch(OwnedSpace(make_space(kind, factory)), factory, ticks, samples, true, progress);
    for (std::size_t i = 0; i < result.samples.size(); ++i)
    {
        result.samples[i].allocated -= alone[i].allocated;
        result.samples[i].at_work -= alone[i].allocated;
    }
    return result;
}

double memory_growth(const MemoryResult &result, std::int64_t MemorySample::*member)
{
    const std::size_t count = result.samples.size();
    const auto largest = [&](std::size_t begin, std::size_t end) {
        std::int64_t most = 0;
        for (std::size_t i = begin; i < end; ++i)
        {
            most = std::max(most, result.samples[i].*member);
        }
        return static_cast<double>(most);
    };
    const double first = largest(count / 10, count / 2);
    return first > 0 ? largest(count / 2, count) / first : 1;
}

double bytes_per_near_pair(const ShapeMemory &few_pairs, const ShapeMemory &many_pairs)
{
    const std::int64_t pairs = many_pairs.near() - few_pairs.near();
    return pairs > 0 ? static_cast<double>(many_pairs.extra() - few_pairs.extra()) / static_cast<double>(pairs)
                     : std::numeric_limits<double>::quiet_NaN();
}

nlohmann::json memory_record(const MemoryResult &result)
{
    const auto per_geom = [&](std::int64_t bytes) { return static_cast<double>(bytes) / result.spec.objects; };
    const MemorySample &last = result.samples.back();
    nlohmann::json samples = nlohmann::json::array();
    for (const MemorySample &sample : result.samples)
    {
        samples.push_back({{"tick", sample.tick},
                           {"counted_bytes", sample.counted},
                           {"allocated_bytes", sample.allocated},
                           {"at_work_bytes", sample.at_work},
                           {"postponed", sample.postponed},
                           {"near", sample.near}});
    }
    nlohmann::json record = {{"scene", result.spec.name},
                             {"n", result.spec.objects},
                             {"space", space_name(result.space)},
                             {"seed", result.spec.seed},
                             {"ticks", last.tick},
                             {"bytes_per_geom", nullptr},
                             {"allocated_bytes_per_geom", per_geom(last.allocated)},
                             {"at_work_bytes_per_geom", per_geom(last.at_work)},
                             {"postponed", last.postponed},
                             {"samples", samples}};
    if (last.counted > 0)
    {
        record["bytes_per_geom"] = per_geom(last.counted);
    }
    return record;
}
} // namespace ode_predictive_space::benchmarks
