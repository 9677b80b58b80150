#include "demos/haptic/report.h"
#include "demos/runs/result_records.h"
#include "demos/runs/table.h"
#include "demos/runs/world_run.h"
#include "ode_predictive_space/recording/curves.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ode_predictive_space::demo
{
namespace
{
using namespace worlds;

constexpr int most_warm_up_ticks = 100;
constexpr double usual_seconds = 2;
const std::vector<std::string> usual_spaces = {"predictive-box", "predictive-shape", "simple",
                                               "hash",           "quadtree",         "sap"};

std::vector<SpaceKind> kinds_of(const std::vector<std::string> &names)
{
    std::vector<SpaceKind> kinds;
    for (const std::string &name : names)
        kinds.push_back(space_named(name));
    return kinds;
}

/// Spaces that leave pairs out must not leave out contacts, so these are compared, too.
bool any_leaves_pairs_out(const WorldRuns &runs)
{
    return std::any_of(runs.begin(), runs.end(), [](const auto &run) { return !run->contender().exact(); });
}

/// The first ticks build the data of the spaces: their pairs count, their times do not.
void make_ticks(const WorldRuns &runs, int ticks)
{
    const int warm_up = std::min(most_warm_up_ticks, ticks / 10);
    run_by_turns(runs, warm_up);
    for (const auto &run : runs)
        run->start_measuring();
    run_by_turns(runs, ticks - warm_up);
}

nlohmann::json record_of(const WorldRun &run, const WorldSpec &spec)
{
    const Statistics times = summarise(run.measured().collide_times);
    return {{"scene", spec.name},
            {"n", spec.objects},
            {"seed", spec.seed},
            {"space", run.name()},
            {"ticks", run.reported().ticks()},
            {"measured_ticks", run.measured().collide_times.size()},
            {"mean_us", times.mean},
            {"median_us", times.median},
            {"p99_us", times.p99},
            {"max_us", times.max},
            {"tick_us", summarise(run.measured().tick_times).median},
            {"pairs", run.reported().pairs},
            {"pair_hash", hexadecimal(hash_ticks(run.reported().tick_hashes))},
            {"false_pairs", run.reported().false_pairs},
            {"contacts", run.reported().contacts}};
}

/// The gain in the sense of Vogiannou et al.: (T_other - T_ours) / T_other, in percent.
double gain_percent(double ours, double other)
{
    return 100 * (other - ours) / other;
}

/// The gains are those of the first predictive space.
nlohmann::json records_of(const WorldRuns &runs, const WorldSpec &spec)
{
    nlohmann::json records = nlohmann::json::array();
    for (const auto &run : runs)
        records.push_back(record_of(*run, spec));
    const auto ours =
        std::find_if(runs.begin(), runs.end(), [](const auto &run) { return run->contender().is_predictive(); });
    for (std::size_t i = 0; ours != runs.end() && i < runs.size(); ++i)
    {
        const nlohmann::json &first = records[static_cast<std::size_t>(ours - runs.begin())];
        if (runs[i] == *ours)
            continue;
        records[i]["gain_percent"] = gain_percent(first["median_us"], records[i]["median_us"]);
        records[i]["tick_gain_percent"] = gain_percent(first["tick_us"], records[i]["tick_us"]);
    }
    return records;
}

/// @param tick the first one in which pairs differ; < 0: none.
std::string agreement_text(int tick, const std::string &pairs)
{
    if (tick >= 0)
        return "THE SPACES DISAGREE: in tick " + std::to_string(tick) + " the pairs " + pairs + " were not the same.\n";
    return "In each tick, the pairs " + pairs + " were the same.\n";
}

/// @param agreement sentences of agreement_text().
std::string text_of(const Report &report, const std::string &agreement, const WorldSpec &spec)
{
    const nlohmann::json &records = report.json.at("spaces");
    std::ostringstream text;
    text << "Scene " << spec.name << " with " << grouped(static_cast<std::uint64_t>(spec.objects)) << " objects, seed "
         << spec.seed << "; the same motion in each of " << records.size() << " spaces, alternating.\n"
         << "Microseconds in dSpaceCollide(); tick_us: median of the whole tick. Gains are the shares of medians that\n"
            "the first predictive space saves; below zero the other space is faster.\n\n";
    print_records(text, records,
                  {"space", "median_us", "p99_us", "gain_percent", "tick_us", "tick_gain_percent", "pairs"});
    text << '\n' << agreement;
    return text.str();
}

recording::Plot times_plot(const char *title, const WorldRuns &runs, double tick_seconds,
                           std::vector<double> Measured::*times)
{
    recording::Plot plot{title, "simulated time (s)", "microseconds", {}, true};
    for (const auto &run : runs)
    {
        recording::BoundedSeries series{};
        for (const double time : run->measured().*times)
            series.add(time);
        plot.curves.push_back(recording::means(run->name(), series, tick_seconds, 1));
    }
    return plot;
}
} // namespace

Report compare_spaces(const Options &options)
{
    const WorldFactory factory({"mix", options.objects, options.seed});
    const WorldRuns runs = make_runs(kinds_of(options.spaces.empty() ? usual_spaces : options.spaces), factory);
    const bool by_contacts = any_leaves_pairs_out(runs);
    for (std::size_t i = 0; by_contacts && i < runs.size(); ++i)
        runs[i]->measure_contacts();
    const double seconds = options.seconds > 0 ? options.seconds : usual_seconds;
    make_ticks(runs, static_cast<int>(std::lround(seconds / factory.tick_seconds())));

    const int pairs_differ = first_difference(runs);
    const int contacts_differ = by_contacts ? first_difference_of_contacts(runs) : -1;
    const std::string agreement = agreement_text(pairs_differ, "of spaces that compare boxes") +
                                  (by_contacts ? agreement_text(contacts_differ, "with contacts") : "");
    Report report;
    report.is_good = pairs_differ < 0 && contacts_differ < 0;
    report.json = {{"program", "predictive_haptic_demo"},
                   {"same_pairs", pairs_differ < 0},
                   {"same_contacts", contacts_differ < 0},
                   {"spaces", records_of(runs, factory.spec())}};
    report.page = {
        "Spaces compared",
        text_of(report, agreement, factory.spec()),
        {times_plot("Time per tick in dSpaceCollide()", runs, factory.tick_seconds(), &Measured::collide_times),
         times_plot("Time per whole tick", runs, factory.tick_seconds(), &Measured::tick_times)}};
    return report;
}
} // namespace ode_predictive_space::demo
