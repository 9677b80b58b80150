#include "tests/benchmarks/query_measurement.h"

#include "demos/runs/table.h"
#include "demos/runs/world_run.h"
#include "demos/worlds/world.h"

#include <algorithm>
#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace ode_predictive_space::worlds;

constexpr int query_warm_up_ticks = 100;
constexpr int ticks_per_turn = 100;
constexpr double to_microseconds = 1e6;

void answer_nothing(void *, dGeomID, dGeomID) {}

/// One space with its copy of the scene.
class QueryRun
{
public:
    QueryRun(SpaceKind kind, const WorldFactory &factory, const QuerySettings &settings)
        : contender_(make_contender(kind, factory)), scene_(factory.make(contender_->space())),
          collide_first_(settings.collide_first), checking_(settings.check && dSpaceIsPredictive(contender_->space())),
          clock_overhead_(clock_overhead())
    {
        result_.space = kind;
        result_.exact = contender_->exact();
    }

    void tick()
    {
        scene_->advance();
        if (collide_first_)
        {
            collide();
        }
        ask(0, asking_spheres, result_.spheres, sphere_hash_);
        ask(asking_spheres, scene_->queries().size(), result_.rays, ray_hash_);
        if (checking_ && dPredictiveSpaceValidate(contender_->space()) == 0)
        {
            result_.valid = false;
        }
    }

    void start_measuring()
    {
        result_.spheres.times.clear();
        result_.rays.times.clear();
    }

    QueryResult result() const
    {
        QueryResult result = result_;
        result.spheres.pair_hash = sphere_hash_.value();
        result.rays.pair_hash = ray_hash_.value();
        return result;
    }

private:
    /// ODE's own spaces keep nothing of a dSpaceCollide() but that their geoms are clean. Some of them would spend most of the
    /// benchmark in it.
    void collide()
    {
        if (dSpaceIsPredictive(contender_->space()) != 0)
        {
            dSpaceCollide(contender_->space(), nullptr, &answer_nothing);
        }
        else
        {
            dSpaceClean(contender_->space());
        }
    }

    void ask(std::size_t begin, std::size_t end, QuerySeries &series, PairHash &hash)
    {
        const auto space = reinterpret_cast<dGeomID>(contender_->space());
        list_.clear();
        const Clock::time_point start = Clock::now();
        for (std::size_t i = begin; i < end; ++i)
        {
            dSpaceCollide2(scene_->queries()[i], space, &list_, &PairList::collect);
        }
        const double seconds = seconds_between(start, Clock::now()) - clock_overhead_;
        series.times.push_back(to_microseconds * std::max(0.0, seconds));
        contender_->finish(list_);
        series.pairs += list_.size();
        hash.add_tick(hash_pairs(list_.sorted()));
    }

    std::unique_ptr<Contender> contender_; // before the scene, whose geoms are in its space
    std::unique_ptr<World> scene_;
    bool collide_first_;
    bool checking_;
    double clock_overhead_;
    PairList list_;
    QueryResult result_;
    PairHash sphere_hash_;
    PairHash ray_hash_;
};

using QueryRuns = std::vector<std::unique_ptr<QueryRun>>;

void run_by_turns(const QueryRuns &runs, int ticks, const std::function<void(int)> &progress)
{
    std::size_t first = 0;
    for (int done = 0; done < ticks;)
    {
        const int turn = std::min(ticks_per_turn, ticks - done);
        for (std::size_t i = 0; i < runs.size(); ++i)
        {
            for (int tick = 0; tick < turn; ++tick)
            {
                runs[(first + i) % runs.size()]->tick();
            }
        }
        ++first;
        done += turn;
        if (progress)
        {
            progress(done);
        }
    }
}

/// 0 when the space was not measured.
double mean_time(const std::vector<QueryResult> &results, SpaceKind kind, QuerySeries QueryResult::*series)
{
    const auto found =
        std::find_if(results.begin(), results.end(), [&](const QueryResult &result) { return result.space == kind; });
    return found == results.end() ? 0 : summarise(((*found).*series).times).mean;
}

nlohmann::json record_of(const QueryResult &result, const QuerySettings &settings, const char *what,
                         const QuerySeries &series)
{
    const Statistics times = summarise(series.times);
    return {{"scene", "query"},
            {"what", what},
            {"queries_per_tick", asking_spheres},
            {"collide_first", settings.collide_first},
            {"still", settings.still},
            {"n", settings.objects},
            {"space", space_name(result.space)},
            {"seed", settings.seed},
            {"ticks", series.times.size()},
            {"mean_us", times.mean},
            {"median_us", times.median},
            {"p99_us", times.p99},
            {"p999_us", times.p999},
            {"max_us", times.max},
            {"pairs", series.pairs},
            {"pair_hash", hexadecimal(series.pair_hash)}};
}
} // namespace

std::vector<QueryResult> measure_queries(const QuerySettings &settings, const std::function<void(int)> &progress)
{
    constexpr double usual = -1, none = 0; // share of the objects that move
    const WorldFactory factory({"query", settings.objects, settings.seed, settings.still ? none : usual});
    QueryRuns runs;
    for (const SpaceKind kind : settings.spaces)
    {
        runs.push_back(std::make_unique<QueryRun>(kind, factory, settings));
    }
    run_by_turns(runs, query_warm_up_ticks, {});
    for (const auto &run : runs)
    {
        run->start_measuring();
    }
    run_by_turns(runs, settings.ticks, progress);
    std::vector<QueryResult> results;
    for (const auto &run : runs)
    {
        results.push_back(run->result());
    }
    return results;
}

bool same_pairs(const std::vector<QueryResult> &results)
{
    const QueryResult *first = nullptr;
    for (const QueryResult &result : results)
    {
        if (!result.exact)
        {
            continue;
        }
        first = first == nullptr ? &result : first;
        if (result.spheres.pair_hash != first->spheres.pair_hash || result.rays.pair_hash != first->rays.pair_hash)
        {
            return false;
        }
    }
    return true;
}

bool all_valid(const std::vector<QueryResult> &results)
{
    return std::all_of(results.begin(), results.end(), [](const QueryResult &result) { return result.valid; });
}

double query_ratio(const std::vector<QueryResult> &results, const std::vector<SpaceKind> &others,
                   QuerySeries QueryResult::*series)
{
    const double ours = mean_time(results, SpaceKind::predictive, series);
    double best = 0;
    for (const SpaceKind other : others)
    {
        const double mean = mean_time(results, other, series);
        best = best == 0 || (mean > 0 && mean < best) ? mean : best;
    }
    return ours > 0 ? best / ours : 0;
}

nlohmann::json query_records(const std::vector<QueryResult> &results, const QuerySettings &settings)
{
    nlohmann::json records = nlohmann::json::array();
    for (const QueryResult &result : results)
    {
        records.push_back(record_of(result, settings, "spheres", result.spheres));
        records.push_back(record_of(result, settings, "rays", result.rays));
    }
    return records;
}
} // namespace ode_predictive_space::benchmarks
