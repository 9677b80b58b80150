#include "demos/haptic/comparison.h"

#include "demos/haptic/comparison_report.h"
#include "demos/haptic/run_page.h"
#include "demos/runs/progress.h"
#include "demos/runs/result_records.h"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace ode_predictive_space::demo
{
namespace
{
using namespace worlds;

constexpr int most_warm_up_ticks = 100;
constexpr double usual_seconds = 2;

std::vector<SpaceKind> kinds_of(const std::vector<std::string> &names)
{
    std::vector<SpaceKind> kinds;
    for (const std::string &name : names)
    {
        const SpaceKind kind = space_named(name);
        if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
            kinds.push_back(kind);
    }
    return kinds;
}

std::vector<SpaceKind> usual_kinds()
{
    std::vector<SpaceKind> kinds = all_spaces();
    kinds.insert(kinds.begin() + 1, SpaceKind::predictive_by_shapes);
    return kinds;
}

/// Spaces that leave pairs out must not leave out contacts.
void compare_contacts(const WorldRuns &runs)
{
    const bool all_exact =
        std::all_of(runs.begin(), runs.end(), [](const auto &run) { return run->contender().exact(); });
    for (const auto &run : runs)
    {
        if (!all_exact)
            run->measure_contacts();
    }
}
} // namespace

bool compare_spaces(const Options &options)
{
    WorldSpec spec;
    spec.name = "mix";
    spec.objects = options.objects;
    spec.seed = options.seed;
    const WorldFactory factory(spec);
    const WorldRuns runs = make_runs(options.spaces.empty() ? usual_kinds() : kinds_of(options.spaces), factory);
    compare_contacts(runs);
    const double seconds = options.seconds > 0 ? options.seconds : usual_seconds;
    const int ticks = static_cast<int>(std::lround(seconds / factory.tick_seconds()));
    print_introduction(std::cout, spec, ticks, runs.size());
    {
        // The first ticks build the data of the spaces: their pairs count, their times do not.
        const int warm_up = std::min(most_warm_up_ticks, ticks / 10);
        Progress progress("Running", ticks);
        run_by_turns(runs, warm_up);
        for (const auto &run : runs)
            run->start_measuring();
        run_by_turns(runs, ticks - warm_up, [&](int done) { progress.show(warm_up + done); });
    }
    print_report(std::cout, runs);
    if (!options.json_file.empty())
        write_json(options.json_file, json_report(runs, spec));
    if (!options.report_folder.empty())
        std::cerr << "report: "
                  << recording::write_page(options.report_folder, page_of_comparison(runs, factory.tick_seconds()))
                  << std::endl;
    return first_difference(runs) < 0 && first_difference_of_contacts(runs) < 0;
}
} // namespace ode_predictive_space::demo
