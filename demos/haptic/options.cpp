#include "demos/haptic/options.h"

#include "demos/worlds/spaces.h"
#include "ode_predictive_space/haptics/drivers.h"

#include <CLI/CLI.hpp>

namespace ode_predictive_space::demo
{
namespace
{
void declare_scene(CLI::App &app, Options &options)
{
    app.add_option("--scene", options.scene, "The scene around the probe")
        ->check(CLI::IsMember(scenes_for_probes()))
        ->capture_default_str();
    app.add_option("--objects", options.objects, "How many objects there are besides the probe and the walls")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    app.add_option("--seed", options.seed, "Seed of positions, motions and the hand")->capture_default_str();
    app.add_option("--space", options.space, "The space that finds the pairs")
        ->check(CLI::IsMember(worlds::all_spaces()))
        ->capture_default_str();
}

void declare_touch(CLI::App &app, Options &options)
{
    app.add_option("--law", options.law,
                   "How a touch becomes a force: proxy (god object; default) or penalty (F = k d n for each object); "
                   "a replay uses that of the recording")
        ->check(CLI::IsMember({"penalty", "proxy"}));
    app.add_option("--stiffness", options.stiffness, "Stiffness of touched objects, at the hand, in N/m")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    app.add_option("--damping", options.damping, "Damping of touched objects, at the hand, in N s/m")
        ->check(CLI::Range(0.0, 1e4))
        ->capture_default_str();
    app.add_option("--friction", options.friction, "Coulomb's coefficient between the probe and what it touches")
        ->check(CLI::Range(0.0, 10.0))
        ->capture_default_str();
}

void declare_device(CLI::App &app, Options &options)
{
    CLI::Option *device = app.add_option("--device", options.device,
                                         "What moves the probe and renders the force: " +
                                             CLI::detail::join(haptics::device_names(), ", "))
                              ->capture_default_str();
    app.add_option("--record", options.record_file, "Write the motion and the forces of the device to this file")
        ->type_name("FILE");
    app.add_option_function<std::string>(
           "--replay", [&](const std::string &file) { options.device = "replay:" + file; },
           "As --device replay:FILE: also compares the forces with the recorded ones")
        ->type_name("FILE")
        ->excludes(device);
}

void declare_time(CLI::App &app, Options &options)
{
    app.add_option("--seconds", options.seconds,
                   "Simulated seconds (default: until the window is closed; 5 without one)")
        ->check(CLI::Range(0.01, 3600.0));
    app.add_flag("--decoupled", options.decoupled,
                 "Run the servo in its own thread; always so in scenes with steps longer than 1 ms");
    app.add_option("--rate", options.rate, "Rate of the servo, in Hz; implies --decoupled (default: 1000)")
        ->check(CLI::Range(100.0, 10000.0));
    app.add_flag("--fast", options.fast, "Simulate the time; the same options give the same forces to the last bit");
}

void declare_output(CLI::App &app, Options &options)
{
    app.add_option("--json", options.json_file, "Also write the results to this file")->type_name("FILE");
    app.add_option("--report", options.report_folder, "Write a page with plots, index.html, to this folder")
        ->type_name("DIR");
    app.add_flag("--headless", options.headless, "Open no window");
    CLI::Option *screenshot =
        app.add_option("--screenshot", options.screenshot_file,
                       "Write a picture of the window, as PNG, and end the run unless --seconds is given")
            ->type_name("FILE");
    app.add_option("--at", options.screenshot_time, "When to take the picture, in simulated seconds")
        ->check(CLI::Range(0.0, 3600.0))
        ->needs(screenshot)
        ->capture_default_str();
}

/// @throws CLI::ValidationError when options contradict each other.
void check(const Options &options)
{
    if (options.screenshot_file.empty())
        return;
    if (options.headless)
        throw CLI::ValidationError("--screenshot needs a window, which --headless excludes");
    if (options.seconds > 0 && options.seconds < options.screenshot_time)
        throw CLI::ValidationError("the run ends before the screenshot: --seconds must not be less than --at");
}
} // namespace

const std::vector<std::string> &scenes_for_probes()
{
    // Not the scenes with a probe or queries of their own, of kilometres, or with objects too fast to touch.
    static const std::vector<std::string> names = {"mix", "pile", "stack", "room",  "hills",
                                                   "gas", "game", "still", "churn", "explosion"};
    return names;
}

std::optional<int> parse_command_line(int argc, char **argv, Options &options)
{
    CLI::App app(
        "Runs a haptic probe among still and moving objects, in a window if there is a display; the probe pushes what "
        "it touches.\nExit status: 0; 2 after a failure.");
    for (const auto declare : {&declare_scene, &declare_touch, &declare_device, &declare_time, &declare_output})
        declare(app, options);
    try
    {
        app.parse(argc, argv);
        check(options);
    }
    catch (const CLI::ParseError &end)
    {
        return app.exit(end) == 0 ? 0 : 2;
    }
    return std::nullopt;
}
} // namespace ode_predictive_space::demo
