#include "tests/benchmarks/clock/agreement.h"
#include "tests/benchmarks/clock/clocks.h"
#include "tests/benchmarks/contenders/contenders.h"
#include "tests/benchmarks/contenders/pair_hash.h"
#include "tests/benchmarks/contenders/world_run.h"

#include <algorithm>
#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

struct Query
{
    std::string name;
    std::string world;
    int objects;
    int ticks;
    std::size_t first; ///< index of the first of the world's queries
    bool collides =
        true; ///< dSpaceCollide() comes first and is not timed; without it the first query pays for the motion
};

constexpr int warm_up_ticks = 100;

void answer_nothing(void *, dGeomID, dGeomID) {}

/// A dSpaceCollide() of ODE's own spaces only cleans the geoms, and in some of them it would take most of the benchmark.
void collide(dSpaceID space)
{
    if (dSpaceIsPredictive(space) != 0)
        dSpaceCollide(space, nullptr, &answer_nothing);
    else
        dSpaceClean(space);
}

class QueryRun
{
public:
    QueryRun(const std::string &space, const Query &query)
        : query_(query), factory_({query.world, query.objects}), contender_(make_contender(space, factory_)),
          world_(factory_.make(contender_->space()))
    {}

    /// @return microseconds in the queries.
    double tick()
    {
        world_->advance();
        if (query_.collides)
            collide(contender_->space());
        list_.clear();
        const auto space = reinterpret_cast<dGeomID>(contender_->space());
        const Clock::time_point start = Clock::now();
        for (std::size_t i = 0; i < asking_spheres; ++i)
            dSpaceCollide2(world_->queries()[query_.first + i], space, &list_, &PairList::collect);
        const double seconds = seconds_between(start, Clock::now()) - clock_overhead_;
        contender_->finish(list_);
        hashes_.push_back(hash_pairs(list_.sorted()));
        return 1e6 * std::max(0.0, seconds);
    }

    std::uint64_t pair_hash() const { return hash_ticks(hashes_); }
    bool exact() const { return contender_->exact(); }

private:
    const Query &query_;
    WorldFactory factory_;
    std::unique_ptr<Contender> contender_; // outlives the world, whose geoms are in its space
    std::unique_ptr<World> world_;
    double clock_overhead_ = clock_overhead();
    PairList list_;
    std::vector<std::uint64_t> hashes_; ///< of the pairs of each tick
};

void clock_query(benchmark::State &state, const Query &query, const std::string &space)
{
    QueryRun run(space, query);
    for (int tick = 0; tick < std::min(warm_up_ticks, query.ticks); ++tick)
        run.tick();
    std::vector<double> times;
    for (auto _ : state)
    {
        times.push_back(run.tick());
        state.SetIterationTime(1e-6 * times.back());
    }
    count_percentiles(state, times);
    if (run.exact())
        Agreement::all().check(state, query.name + "/" + std::to_string(query.objects), run.pair_hash());
}

void register_query(const Query &query)
{
    for (const std::string space : {"simple", "predictive-box", "predictive-sphere", "hash", "quadtree", "sap"})
    {
        const std::string name = benchmark_name("query", query.name, query.objects, space);
        benchmark::RegisterBenchmark(name.c_str(),
                                     [query, space](benchmark::State &state) { clock_query(state, query, space); })
            ->Iterations(query.ticks)
            ->UseManualTime()
            ->Unit(benchmark::kMicrosecond);
    }
}
} // namespace

void register_queries(Extent extent)
{
    for (Query query : {Query{"spheres", "query", 1000, 1000, 0}, Query{"rays", "query", 1000, 1000, asking_spheres},
                        Query{"spheres", "query", 10000, 1000, 0}, Query{"rays", "query", 10000, 1000, asking_spheres},
                        Query{"ask", "ask", 10000, 1000, 0, false}})
    {
        if (extent == Extent::brief)
        {
            query.objects = brief_objects + query.objects / 1000; // keeps the names of different sizes distinct
            query.ticks = brief_ticks;
        }
        register_query(query);
    }
}
} // namespace ode_predictive_space::benchmarks
