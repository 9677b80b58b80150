// A probe among still and moving objects, in the predictive space and in ODE's own, side by side.

#include "demos/haptic_report.h"
#include "demos/scenes/progress.h"
#include "demos/scenes/result_records.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>

namespace
{
using namespace ode_predictive_space::scenes;

enum ExitStatus
{
    exit_same = 0,
    exit_different_pairs = 1,
    exit_failed = 2
};

constexpr int most_warm_up_ticks = 100;

struct Options
{
    int objects = 1000;
    double seconds = 2;
    std::vector<std::string> spaces;
    std::uint64_t seed = 1;
    bool headless = false;
    std::string json_file;
};

std::vector<std::string> names_of_all_spaces()
{
    std::vector<std::string> names;
    for (const SpaceKind kind : all_spaces())
    {
        names.push_back(kind == SpaceKind::predictive ? "predictive" : space_name(kind));
    }
    return names;
}

std::vector<std::string> accepted_names()
{
    std::vector<std::string> names = names_of_all_spaces();
    names.push_back(space_name(SpaceKind::predictive));
    return names;
}

void declare_options(CLI::App &app, Options &options)
{
    options.spaces = names_of_all_spaces();
    app.add_option("--objects", options.objects, "How many objects there are besides the probe and the walls")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    app.add_option("--seconds", options.seconds, "How long to run, in simulated seconds of 1000 ticks")
        ->check(CLI::Range(0.01, 3600.0))
        ->capture_default_str();
    app.add_option("--space", options.spaces, "Which spaces to run: one, or several separated by commas")
        ->delimiter(',')
        ->check(CLI::IsMember(accepted_names()))
        ->capture_default_str();
    app.add_option("--seed", options.seed, "Of the places, the motions and the hand; the same seed gives the same run")
        ->capture_default_str();
    app.add_flag("--headless", options.headless, "Open no window. This build has none: it is always headless");
    app.add_option("--json", options.json_file, "Write the results to this file, too")->type_name("FILE");
}

std::vector<SpaceKind> kinds_of(const std::vector<std::string> &names)
{
    std::vector<SpaceKind> kinds;
    for (const std::string &name : names)
    {
        const SpaceKind kind = space_named(name);
        if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
        {
            kinds.push_back(kind);
        }
    }
    return kinds;
}

ExitStatus run_demo(const Options &options)
{
    const OdeSession ode;
    SceneSpec spec;
    spec.name = "mix";
    spec.objects = options.objects;
    spec.seed = options.seed;
    const SceneFactory factory(spec);
    const SceneRuns runs = make_runs(kinds_of(options.spaces), factory);
    const int ticks = static_cast<int>(std::lround(options.seconds / factory.tick_seconds()));
    print_introduction(std::cout, spec, ticks, runs.size());
    {
        // The first ticks build what the spaces keep: their pairs count, their times do not.
        const int warm_up = std::min(most_warm_up_ticks, ticks / 10);
        Progress progress("Running", ticks);
        run_by_turns(runs, warm_up);
        for (const auto &run : runs)
        {
            run->start_measuring();
        }
        run_by_turns(runs, ticks - warm_up, [&](int done) { progress.show(warm_up + done); });
    }
    print_report(std::cout, runs);
    if (!options.json_file.empty())
    {
        write_json(options.json_file, json_report(runs, spec));
    }
    return first_difference(runs) < 0 ? exit_same : exit_different_pairs;
}
} // namespace

int main(int argc, char **argv)
{
    Options options;
    CLI::App app("A hand-driven probe among still and moving objects: the predictive space beside ODE's own spaces.\n"
                 "Exit status: 0, or 1 when the spaces did not report the same pairs, or 2 when something failed.");
    declare_options(app, options);
    CLI11_PARSE(app, argc, argv);
    try
    {
        return run_demo(options);
    }
    catch (const std::exception &failure)
    {
        std::cerr << "predictive_haptic_demo: " << failure.what() << '\n';
        return exit_failed;
    }
}
