// predictive_bench scene NAME: one scene in several spaces.

#include "demos/scenes/progress.h"
#include "demos/scenes/result_records.h"
#include "demos/scenes/table.h"
#include "tests/benchmarks/command.h"
#include "tests/benchmarks/contenders/contenders.h"

#include <algorithm>
#include <iostream>
#include <limits>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace ode_predictive_space::scenes;

constexpr int warm_up_ticks = 100;
constexpr int ticks_per_batch = 64;

/// Below so many objects a tick is so short that reading the clock would be a part of what is measured.
constexpr int objects_for_single_ticks = 300;

class SceneCommand : public Command
{
public:
    void declare(CLI::App &program) override
    {
        for (const SpaceKind kind : all_spaces())
        {
            spaces_.push_back(space_name(kind));
        }
        std::vector<std::string> names = contender_names();
        names.emplace_back("predictive");
        command_ = program.add_subcommand("scene", "Run one scene in several spaces");
        command_->add_option("name", spec_.name, describe_all())->required()->check(CLI::IsMember(scene_names()));
        command_->add_option("--n", spec_.objects, "Objects")->check(CLI::Range(1, 1000000));
        command_->add_option("--ticks", ticks_, "Ticks to measure")->check(CLI::Range(1, 100000000));
        command_->add_option("--seed", spec_.seed, "Of places, motions and the hand");
        command_->add_option("--moving", spec_.moving, "Share of the objects that move, in gas and churn (default 0.5)")
            ->check(CLI::Range(0.0, 1.0));
        command_->add_option("--spaces", spaces_, "Spaces, separated by commas")
            ->delimiter(',')
            ->check(CLI::IsMember(names));
        command_->add_option("--json", json_file_, "Write the results to this file, too")->type_name("FILE");
        command_->add_flag("--check", check_, "Check the predictive space by brute force after every tick");
    }

    bool chosen() const override { return command_->parsed(); }
    ExitStatus run() override;

private:
    static std::string describe_all()
    {
        std::string text = "One of:";
        for (const std::string &name : scene_names())
        {
            text += "\n  " + name + ": " + describe_scene(name);
        }
        return text;
    }

    SceneRuns make_scene_runs(const SceneFactory &factory) const;
    bool measures_batches(const SceneRuns &runs) const;
    void measure_ticks(const SceneRuns &runs) const;
    void measure_batches(const SceneRuns &runs, const SceneFactory &factory) const;
    void print_results(const SceneRuns &runs) const;
    void write_results(const SceneRuns &runs) const;
    ExitStatus judge(const SceneRuns &runs) const;

    CLI::App *command_ = nullptr;
    SceneSpec spec_{"", 1000};
    int ticks_ = 1000;
    std::vector<std::string> spaces_;
    std::string json_file_;
    bool check_ = false;
};

double mean_of(const SceneRun &run)
{
    return summarise(run.collide_times()).mean;
}

/// Mean time of the fastest of ODE's own spaces, in microseconds; 0 when none was run.
double best_of_ode(const SceneRuns &runs)
{
    double best = std::numeric_limits<double>::infinity();
    for (const auto &run : runs)
    {
        if (run->contender().family() == Family::ode)
        {
            best = std::min(best, mean_of(*run));
        }
    }
    return best == std::numeric_limits<double>::infinity() ? 0 : best;
}

SceneRuns SceneCommand::make_scene_runs(const SceneFactory &factory) const
{
    SceneRuns runs;
    for (const std::string &name : spaces_)
    {
        runs.push_back(std::make_unique<SceneRun>(benchmarks::make_contender(name, factory), factory));
    }
    for (const auto &run : runs)
    {
        if (check_)
        {
            run->check_every_tick();
        }
    }
    return runs;
}

bool SceneCommand::measures_batches(const SceneRuns &runs) const
{
    return spec_.objects < objects_for_single_ticks && runs.front()->scene().moves_by_itself();
}

void SceneCommand::measure_ticks(const SceneRuns &runs) const
{
    Progress progress(spec_.name, ticks_);
    run_by_turns(runs, ticks_, [&](int done) { progress.show(done); });
}

// The pairs have been compared before; now nothing but the motion stands between two collide calls. The motion is timed by
// itself in each round, so that both halves of the difference see the machine in the same state.
void SceneCommand::measure_batches(const SceneRuns &runs, const SceneFactory &factory) const
{
    MotionRun motion(factory);
    for (int done = 0; done < ticks_; done += ticks_per_batch)
    {
        const double motion_seconds = motion.batch(ticks_per_batch);
        for (const auto &run : runs)
        {
            run->batch(ticks_per_batch, motion_seconds);
        }
    }
}

void SceneCommand::print_results(const SceneRuns &runs) const
{
    std::cout << spec_.name << ", n = " << grouped(static_cast<std::uint64_t>(spec_.objects)) << ", seed " << spec_.seed
              << ", " << grouped(runs.front()->measured_ticks()) << " ticks"
              << (measures_batches(runs) ? ", in batches of " + std::to_string(ticks_per_batch) : "")
              << "; microseconds in dSpaceCollide() per tick\n\n";
    const double best = best_of_ode(runs);
    Table table({"space", "mean", "median", "p99", "p99.9", "max", "pairs", "pair hash", "best ODE / this"});
    for (const auto &run : runs)
    {
        const Statistics times = summarise(run->collide_times());
        table.add({run->name(), fixed(times.mean, 2), fixed(times.median, 2), fixed(times.p99, 2), fixed(times.p999, 2),
                   fixed(times.max, 2), grouped(run->pairs()), hexadecimal(run->pair_hash()),
                   best > 0 ? fixed(best / times.mean, 2) : "-"});
    }
    table.print(std::cout);
}

void SceneCommand::write_results(const SceneRuns &runs) const
{
    nlohmann::json records = nlohmann::json::array();
    for (const auto &run : runs)
    {
        records.push_back(record_of(*run, spec_));
    }
    write_json(json_file_, records);
}

ExitStatus SceneCommand::judge(const SceneRuns &runs) const
{
    ExitStatus status = exit_ok;
    const int tick = first_difference(runs);
    if (tick >= 0)
    {
        std::cerr << "The spaces disagree: from tick " << tick << " on they did not all report the same pairs.\n";
        status = exit_wrong_pairs;
    }
    for (const auto &run : runs)
    {
        if (!run->invariant_held())
        {
            std::cerr << "The " << run->name() << " space did not pass its check.\n";
            status = exit_wrong_pairs;
        }
    }
    return status;
}

ExitStatus SceneCommand::run()
{
    const OdeSession ode;
    const SceneFactory factory(spec_);
    const SceneRuns runs = make_scene_runs(factory);
    run_by_turns(runs, warm_up_ticks);
    for (const auto &run : runs)
    {
        run->start_measuring();
    }
    measure_ticks(runs);
    if (measures_batches(runs))
    {
        for (const auto &run : runs)
        {
            run->start_measuring();
        }
        measure_batches(runs, factory);
    }
    print_results(runs);
    if (!json_file_.empty())
    {
        write_results(runs);
    }
    return judge(runs);
}
} // namespace

std::unique_ptr<Command> make_scene_command()
{
    return std::make_unique<SceneCommand>();
}
} // namespace ode_predictive_space::benchmarks
