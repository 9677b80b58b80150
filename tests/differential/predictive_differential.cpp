// Any number of random histories in a simple and in a predictive space, and the replay of one that failed.

#include <iostream>

#include <CLI/CLI.hpp>
#include <ode/ode.h>

#include "tests/differential/comparison.h"

using namespace ode_predictive_space;

namespace
{
struct Options
{
    std::uint64_t seed = 1;
    int histories = 100;
    int ticks = 1000;
    int geoms = 60;
    std::string flavour = "all";
    bool flat = false;
    bool spheres = false;
    bool shapes = false;
    bool pairs_only = false;
};

Profile profile_of(const Options &options, std::uint64_t seed)
{
    Profile profile;
    profile.geoms = options.geoms;
    profile.ticks = options.ticks;
    profile.nested_spaces = !options.flat;
    profile.flavour = static_cast<Flavour>(seed % flavour_count);
    for (int i = 0; i < flavour_count; ++i)
    {
        if (options.flavour == flavour_name(static_cast<Flavour>(i)))
            profile.flavour = static_cast<Flavour>(i);
    }
    return profile;
}

int run(const Options &options)
{
    Tally tally;
    for (int i = 0; i < options.histories; ++i)
    {
        const std::uint64_t seed = options.seed + static_cast<std::uint64_t>(i);
        const Profile profile = profile_of(options, seed);
        // Printed first, so that a history that ends the process is known, too.
        std::cout << "seed " << seed << " (" << flavour_name(profile.flavour) << ")" << std::flush;
        const Measure measure = options.shapes ? Measure::shapes : options.spheres ? Measure::spheres : Measure::boxes;
        const Terms terms{measure, !options.pairs_only};
        const std::string report = report_of(profile, seed, terms, &tally);
        std::cout << (report.empty() ? ": same pairs\n" : ": DIFFERENT\n" + report) << std::flush;
        if (!report.empty())
            return 1;
    }
    std::cout << options.histories << " histories, " << tally.ticks << " ticks, " << tally.pairs << " pairs";
    if (options.spheres || options.shapes)
        std::cout << ", " << tally.left_out << " left out";
    std::cout << "\n";
    return 0;
}
} // namespace

int main(int argc, char **argv)
{
    Options options;
    CLI::App app("Compares the pairs that a predictive and a simple space report in random histories");
    app.add_option("--seed", options.seed, "seed of the first history; each further one has the next");
    app.add_option("--histories", options.histories, "how many")->check(CLI::PositiveNumber);
    app.add_option("--ticks", options.ticks, "length of a history")->check(CLI::PositiveNumber);
    app.add_option("--geoms", options.geoms, "geoms in a scene")->check(CLI::PositiveNumber);
    app.add_option("--flavour", options.flavour, "what the histories are about (default: each in turn)")
        ->check(CLI::IsMember({"all", "calm", "mixed", "wild", "teleport", "pile", "extreme", "explosion", "nests"}));
    app.add_flag("--flat", options.flat, "no nested spaces");
    app.add_flag("--spheres", options.spheres, "by the measure of spheres: no pair left out has a contact");
    app.add_flag("--shapes", options.shapes, "the same by the shape test");
    app.add_flag("--pairs-only", options.pairs_only, "do not check the invariant beside the pairs");
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::ParseError &end)
    {
        return app.exit(end) == 0 ? 0 : 2;
    }
    if (options.spheres || options.shapes)
        options.flat = true;

    dInitODE2(0);
    dAllocateODEDataForThread(dAllocateMaskAll);
    const int status = run(options);
    dCloseODE();
    return status;
}
