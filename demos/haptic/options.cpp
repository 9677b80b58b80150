#include "demos/haptic/options.h"

#include "demos/runs/spaces.h"
#include "ode_predictive_space/haptics/drivers.h"

#include <CLI/CLI.hpp>

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

/// Options of every run.
void declare_common_options(CLI::App &app, Options &options)
{
    app.add_option("--space", options.spaces,
                   "The space that finds the pairs (default: predictive); several, separated by commas, are compared")
        ->delimiter(',')
        ->check(CLI::IsMember(names_of_spaces()));
    app.add_option("--objects", options.objects, "How many objects there are besides the probe and the walls")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    app.add_option("--seconds", options.seconds,
                   "Simulated seconds (default: until the window is closed; 5 without one; 2 in a comparison)")
        ->check(CLI::Range(0.01, 3600.0));
    app.add_option("--seed", options.seed, "Seed of positions, motions and the hand")->capture_default_str();
    app.add_option("--json", options.json_file, "Also write the results to this file")->type_name("FILE");
    app.add_option("--report", options.report_folder, "Write a page with plots, index.html, to this folder")
        ->type_name("DIR");
    app.add_flag("--headless", options.headless, "Open no window");
}

void declare_scene_options(CLI::Option_group &probe, Options &options)
{
    probe.add_option("--scene", options.scene, "The scene around the probe")
        ->check(CLI::IsMember(scenes_for_probes()))
        ->capture_default_str();
    probe
        .add_option("--law", options.law,
                    "How a touch becomes a force: proxy (god object; default) or penalty (F = k d n for each object); "
                    "a replay uses that of the recording")
        ->check(CLI::IsMember({"penalty", "proxy"}));
    probe.add_option("--stiffness", options.stiffness, "Stiffness of touched objects, at the hand, in N/m")
        ->check(CLI::Range(0.0, 1e6))
        ->capture_default_str();
    probe.add_option("--damping", options.damping, "Damping of touched objects, at the hand, in N s/m")
        ->check(CLI::Range(0.0, 1e4))
        ->capture_default_str();
    probe.add_option("--friction", options.friction, "Coulomb's coefficient between the probe and what it touches")
        ->check(CLI::Range(0.0, 10.0))
        ->capture_default_str();
}

void declare_device_options(CLI::Option_group &probe, Options &options)
{
    CLI::Option *device = probe
                              .add_option("--device", options.device,
                                          "What moves the probe and renders the force: " +
                                              CLI::detail::join(haptics::device_names(), ", "))
                              ->capture_default_str();
    probe.add_option("--record", options.record_file, "Write the motion and the forces of the device to this file")
        ->type_name("FILE");
    probe
        .add_option_function<std::string>(
            "--replay", [&](const std::string &file) { options.device = "replay:" + file; },
            "As --device replay:FILE: also compares the forces with the recorded ones")
        ->type_name("FILE")
        ->excludes(device);
    probe.add_flag("--decoupled", options.decoupled,
                   "Run the servo in its own thread; always so in scenes with steps longer than 1 ms");
    probe.add_option("--rate", options.rate, "Rate of the servo, in Hz; implies --decoupled (default: 1000)")
        ->check(CLI::Range(100.0, 10000.0));
    probe.add_flag("--fast", options.fast, "Simulate the time; the same options give the same forces to the last bit");
    CLI::Option *screenshot =
        probe
            .add_option("--screenshot", options.screenshot_file,
                        "Write a picture of the window, as PNG, and end the run unless --seconds is given")
            ->type_name("FILE");
    probe.add_option("--at", options.screenshot_time, "When to take the picture, in simulated seconds")
        ->check(CLI::Range(0.0, 3600.0))
        ->needs(screenshot)
        ->capture_default_str();
}

/// @throws CLI::ValidationError when options contradict each other.
void complete(Options &options, const CLI::App &probe)
{
    options.compare = options.compare || options.spaces.size() > 1;
    options.wants_one_run = probe.count_all() > 0 || (!options.compare && options.spaces.size() == 1);
    if (options.compare && options.wants_one_run)
        throw CLI::ValidationError("options of the probe cannot be used when spaces are compared");
    if (!options.screenshot_file.empty() && options.headless)
        throw CLI::ValidationError("--screenshot needs a window, which --headless excludes");
    if (!options.screenshot_file.empty() && options.seconds > 0 && options.seconds < options.screenshot_time)
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
        "it touches.\nWith --compare, with several spaces, or without a window and any option for the probe, it "
        "compares the predictive space with ODE's own spaces.\n"
        "Exit status: 0; 1 when compared spaces did not report the same pairs; 2 after another failure.");
    declare_common_options(app, options);
    app.add_flag("--compare", options.compare, "Run the scene mix in several spaces and compare their times");
    CLI::Option_group &probe = *app.add_option_group("Probe", "Options of a run of the probe");
    declare_scene_options(probe, options);
    declare_device_options(probe, options);
    try
    {
        app.parse(argc, argv);
        complete(options, probe);
    }
    catch (const CLI::ParseError &end)
    {
        return app.exit(end) == 0 ? 0 : 2;
    }
    return std::nullopt;
}
} // namespace ode_predictive_space::demo
