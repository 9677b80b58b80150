// The paper's Table 1, measured here: gains of the predictive space over four others in the paper's experiment, the world mix.

#include "tests/benchmarks/contenders/contenders.h"
#include "tests/benchmarks/contenders/statistics.h"
#include "tests/benchmarks/contenders/world_run.h"
#include "tests/benchmarks/results.h"

#include <array>

namespace
{
using namespace ode_predictive_space;
using namespace ode_predictive_space::benchmarks;
using namespace ode_predictive_space::worlds;

struct Other
{
    const char *name;
    const char *in_the_paper;
};

constexpr std::array<Other, 4> others = {
    {{"brute", "brute force"}, {"sap", "sweep & prune"}, {"quadtree", "quadtree"}, {"hash", "uniform grid"}}};

/// A row of the paper's table, in percent.
struct PaperRow
{
    int objects;
    std::array<double, others.size()> gains;
};

constexpr std::array<PaperRow, 5> paper = {{{20, {97.9, 83.3, 80.4, 82.1}},
                                            {40, {96.3, 51.8, 51.4, 49.9}},
                                            {60, {97.8, 60.7, 62.6, 64.6}},
                                            {80, {97.9, 46.1, 54.8, 59.7}},
                                            {100, {97.4, 32.7, 38.7, 39.9}}}};

constexpr int warm_up_ticks = 100;
constexpr int ticks_per_turn = 100;

using WorldRuns = std::vector<std::unique_ptr<WorldRun>>;

/// Mean microseconds per tick.
struct Means
{
    double broad;  ///< dSpaceCollide() with a callback that only notes the pair
    double narrow; ///< with dCollide() for each pair
    double whole;  ///< with contact joints and the step of the world
};

Means means_of(const WorldRun &run)
{
    const double broad = mean(run.measured().collide_times);
    return {broad, broad + mean(run.measured().contact_times), mean(run.measured().tick_times)};
}

/// The runs alternate, and each round begins with another one: load, clock frequency and temperature affect all alike.
void run_by_turns(const WorldRuns &runs, int ticks)
{
    std::size_t first = 0;
    for (int done = 0; done < ticks; done += ticks_per_turn, ++first)
    {
        for (std::size_t i = 0; i < runs.size(); ++i)
            runs[(first + i) % runs.size()]->turn(std::min(ticks_per_turn, ticks - done));
    }
}

std::vector<Means> measure(int objects, const std::string &ours, int ticks)
{
    const WorldFactory factory({"mix", objects});
    WorldRuns runs;
    runs.push_back(std::make_unique<WorldRun>(make_contender(ours, factory), factory));
    for (const Other &other : others)
        runs.push_back(std::make_unique<WorldRun>(make_contender(other.name, factory), factory));
    for (const auto &run : runs)
        run->measure_contacts();
    run_by_turns(runs, warm_up_ticks);
    for (const auto &run : runs)
        run->start_measuring();
    run_by_turns(runs, ticks);
    std::vector<Means> means;
    const WorldRun &exact = *runs.back();
    for (const auto &run : runs)
    {
        if (run->contender().exact() && run->reported().tick_hashes != exact.reported().tick_hashes)
            throw std::runtime_error("the spaces did not report the same pairs");
        means.push_back(means_of(*run));
    }
    return means;
}

void add_block(const char *name, double Means::*time, const PaperRow &row, const std::vector<Means> &means,
               nlohmann::json &records)
{
    for (std::size_t i = 0; i < others.size(); ++i)
    {
        const double our_time = means[0].*time, other_time = means[i + 1].*time;
        records.push_back({{"table", "table1"},
                           {"block", name},
                           {"n", row.objects},
                           {"other", others[i].name},
                           {"ours_us", our_time},
                           {"other_us", other_time},
                           {"gain_percent", 100 * (other_time - our_time) / other_time},
                           {"paper_gain_percent", row.gains[i]}});
    }
}

nlohmann::json measure_all(const std::string &ours, int ticks)
{
    nlohmann::json records = nlohmann::json::array();
    for (const PaperRow &row : paper)
    {
        const std::vector<Means> means = measure(row.objects, ours, ticks);
        add_block("broad phase", &Means::broad, row, means, records);
        add_block("broad and narrow phase", &Means::narrow, row, means, records);
        add_block("whole tick", &Means::whole, row, means, records);
    }
    std::cout
        << "The paper's Table 1: the gain (other - ours) / other of mean times per tick, here and in the paper\n\n";
    print_records(records);
    return records;
}
} // namespace

int main(int argc, char **argv)
{
    std::string ours = "predictive-box";
    int ticks = 16000;
    const auto add_options = [&](CLI::App &app) {
        app.add_option("--ticks", ticks, "Ticks to measure")->check(CLI::Range(1, 100000000))->capture_default_str();
        app.add_option("--space", ours, "The space whose gains are measured")
            ->check(CLI::IsMember({"predictive-box", "predictive-sphere", "predictive-shape"}))
            ->capture_default_str();
    };
    return run_program(argc, argv, "Measures the paper's Table 1", add_options,
                       [&] { return measure_all(ours, ticks); });
}
