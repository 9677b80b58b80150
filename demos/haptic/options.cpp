#include "demos/haptic/options.h"

#include "demos/haptic/probe_scenes.h"
#include "demos/runs/command_line.h"
#include "demos/runs/spaces.h"
#include "ode_predictive_space/haptics/drivers.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <stdexcept>

namespace ode_predictive_space::demo
{
namespace
{
std::vector<std::string> names_of_spaces()
{
    std::vector<std::string> names{"predictive", "predictive-sphere", "predictive-shape"};
    for (const worlds::SpaceKind kind : worlds::all_spaces())
        names.push_back(worlds::space_name(kind));
    return names;
}

std::string joined(const std::vector<std::string> &words)
{
    std::string text;
    for (const std::string &word : words)
        text += (text.empty() ? "" : ", ") + word;
    return text;
}

void declare_scene_options(CLI::App &app, Options &options)
{
    app.add_option("--scene", options.scene, "The scene around the probe")
        ->check(CLI::IsMember(scenes_for_probes()))
        ->capture_default_str();
    app.add_option("--space", options.spaces,
                   "The space that finds the pairs (default: predictive); several, separated by commas, are compared")
        ->delimiter(',')
        ->check(CLI::IsMember(names_of_spaces()));
    app.add_option("--objects", options.objects, "How many objects there are besides the probe and the walls")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    app.add_option("--seconds", options.seconds,
                   "How long to run, in simulated seconds (default: until the window is closed; 5 without a window; 2 "
                   "in a comparison)")
        ->check(CLI::Range(0.01, 3600.0));
    app.add_option("--seed", options.seed, "Seed of positions, motions and the hand; the same seed gives the same run")
        ->capture_default_str();
}

void declare_probe_options(CLI::App &app, Options &options)
{
    app.add_option("--device", options.device,
                   "What moves the probe and renders the force: " + joined(haptics::device_names()))
        ->capture_default_str();
    app.add_option("--law", options.law,
                   "How a touch becomes a force: proxy (god object) or penalty (F = k d n for each object); a replay "
                   "uses that of the recording")
        ->check(CLI::IsMember({"penalty", "proxy"}))
        ->capture_default_str();
    app.add_option("--stiffness", options.stiffness, "Stiffness of touched objects, at the hand, in N/m")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    app.add_option("--damping", options.damping, "Damping of touched objects, at the hand, in N s/m")
        ->check(CLI::Range(0.0, 1e4))
        ->capture_default_str();
    app.add_option("--friction", options.friction, "Coulomb's coefficient between the probe and what it touches")
        ->check(CLI::Range(0.0, 10.0))
        ->capture_default_str();
    app.add_flag("--decoupled", options.decoupled,
                 "Run the servo in its own thread; always so in scenes with steps longer than 1 ms");
    app.add_flag(
        "--fast", options.fast,
        "Do not wait for the clock: time is simulated, and the same options give the same forces to the last bit");
    app.add_option("--rate", options.rate,
                   "Rate of a servo in its own thread, in Hz; this option implies --decoupled (default: 1000)")
        ->check(CLI::Range(100.0, 10000.0));
}

void declare_output_options(CLI::App &app, Options &options)
{
    app.add_option("--record", options.record_file, "Write the motion and the forces of the device to this file")
        ->type_name("FILE");
    app.add_option("--replay", options.replay_file,
                   "As --device replay:FILE; also compare the forces with the recorded ones")
        ->type_name("FILE");
    app.add_option("--json", options.json_file, "Also write the results to this file")->type_name("FILE");
    app.add_option("--report", options.report_folder, "Write a page with plots of the run, index.html, to this folder")
        ->type_name("DIR");
    app.add_flag("--headless", options.headless, "Open no window");
    app.add_flag("--compare", options.compare,
                 "Run the scene mix in several spaces, which alternate, and compare their times");
    app.add_option("--screenshot", options.screenshot_file,
                   "Write a picture of the window to this file, as PNG, and end the run unless --seconds is given")
        ->type_name("FILE");
    app.add_option("--at", options.screenshot_time, "When to take the picture, in simulated seconds")
        ->check(CLI::Range(0.0, 3600.0))
        ->capture_default_str();
}

void declare_options(CLI::App &app, Options &options)
{
    declare_scene_options(app, options);
    declare_probe_options(app, options);
    declare_output_options(app, options);
}

/// Checks that options do not contradict each other.
void complete(Options &options, const CLI::App &app)
{
    const auto given = [&app](const char *name) { return app.count(name) > 0; };
    for (const char *name : {"--scene", "--device", "--law", "--stiffness", "--damping", "--friction", "--decoupled",
                             "--fast", "--rate", "--record", "--replay", "--screenshot"})
    {
        if (given(name))
        {
            options.wants_one_run = true;
            if (options.compare || options.spaces.size() > 1)
                throw std::invalid_argument(
                    std::string(name) + " cannot be used when spaces are compared: give one --space and no --compare");
        }
    }
    options.law_given = given("--law");
    options.compare = options.compare || options.spaces.size() > 1;
    options.wants_one_run = options.wants_one_run || (!options.compare && options.spaces.size() == 1);
    if (options.headless && given("--screenshot"))
        throw std::invalid_argument("--screenshot needs a window, which --headless excludes: leave one of them out");
    if (given("--replay"))
    {
        if (given("--device"))
            throw std::invalid_argument("--replay and --device both say what moves the probe: leave one of them out");
        options.device = "replay:" + options.replay_file;
    }
    if (given("--screenshot") && options.seconds > 0 && options.seconds < options.screenshot_time)
        throw std::invalid_argument("the run ends before the screenshot: --seconds must not be less than --at");
}
} // namespace

std::optional<int> parse_command_line(int argc, char **argv, Options &options)
{
    CLI::App app(
        "Runs a haptic probe among still and moving objects, in a window if there is a display; the probe pushes what "
        "it touches.\nWith --compare, with several spaces, or without a window and without any option for the probe, "
        "the "
        "program compares the predictive space with ODE's own spaces.\n"
        "Exit status: 0; 1 when compared spaces did not report the same pairs; 2 after another failure.");
    declare_options(app, options);
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::ParseError &end)
    {
        return worlds::end_of_parsing(app, end);
    }
    complete(options, app);
    return std::nullopt;
}
} // namespace ode_predictive_space::demo
