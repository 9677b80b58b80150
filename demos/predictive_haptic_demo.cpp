// A probe among still and moving objects at 1 kHz, with or without a window; or a comparison of spaces.

#include "demos/haptic/comparison.h"
#include "demos/haptic/haptic_run.h"
#include "demos/haptic/probe_scenes.h"
#include "demos/haptic/run_page.h"
#include "demos/haptic/run_summary.h"
#include "demos/runs/check_writable.h"
#include "demos/runs/result_records.h"
#include "ode_predictive_space/haptics/drivers.h"
#include "ode_predictive_space/haptics/safety.h"
#ifdef HAPTIC_DEMO_HAS_WINDOW
#include "demos/haptic/windowed_run.h"
#include "demos/window/window.h"
#endif

#include <exception>
#include <iostream>
#include <optional>
#include <stdexcept>

namespace
{
using namespace ode_predictive_space;
using demo::Options;

enum ExitStatus
{
    exit_well = 0,
    exit_different_pairs = 1,
    exit_failed = 2
};

constexpr double usual_seconds_without_window = 5;

/// The reason for which a window cannot be opened; empty when it can.
std::string what_a_window_lacks()
{
#ifdef HAPTIC_DEMO_HAS_WINDOW
    return window::has_display() ? "" : "there is no display with OpenGL";
#else
    return "this build has none, as something was missing that CMake named";
#endif
}

demo::RunResult run(const Options &options, demo::DemoDevice &device, bool in_window)
{
    worlds::WorldSpec spec;
    spec.name = options.scene;
    spec.objects = options.objects;
    spec.seed = options.seed;
    const worlds::WorldFactory factory = demo::factory_for_probe(spec);
    const auto notice = [](const haptics::Notice &sent) { std::cerr << "-- " << sent.sentence() << std::endl; };
#ifdef HAPTIC_DEMO_HAS_WINDOW
    if (in_window)
        return demo::run_in_window(options, factory, device, notice);
#else
    static_cast<void>(in_window);
#endif
    demo::RunControl control;
    return demo::HapticRun(options, factory, device, control, notice).run();
}

void run_probe(Options options, bool in_window)
{
    if (options.device == "mouse" && !in_window)
        throw std::runtime_error("--device mouse needs a window, whose pointer moves the probe");
    if (options.spaces.empty())
        options.spaces = {"predictive"};
    if (!in_window && options.seconds == 0)
        options.seconds = usual_seconds_without_window;
    const haptics::StopRequest stop_request; // signals end the loop with zero force, and the summary is printed
    demo::DemoDevice device(haptics::make_device(options.device, options.seed));
    demo::print_beginning(std::cout, options, in_window);
    const demo::RunResult result = run(options, device, in_window);
    demo::print_summary(std::cout, options, result);
    if (!options.json_file.empty())
        worlds::write_json(options.json_file, demo::json_summary(options, result));
    if (!options.report_folder.empty())
        std::cerr << "report: " << recording::write_page(options.report_folder, demo::page_of_run(options, result))
                  << std::endl;
}

void check_outputs(const Options &options)
{
    for (const std::string &file : {options.json_file, options.screenshot_file})
    {
        if (!file.empty())
            worlds::check_writable(file);
    }
    if (!options.report_folder.empty())
        recording::prepare_folder(options.report_folder);
}

ExitStatus run_demo(const Options &options)
{
    check_outputs(options);
    const worlds::OdeSession ode;
    const std::string lack = options.headless ? "" : what_a_window_lacks();
    const bool in_window = !options.headless && !options.compare && lack.empty();
    if (!options.screenshot_file.empty() && !in_window)
        throw std::runtime_error("--screenshot needs a window: " + lack);
    if (options.compare || (!in_window && !options.wants_one_run))
    {
        if (!lack.empty() && !options.compare)
            std::cout << "No window: " << lack << ". The spaces are compared instead. With --device virtual the probe "
                      << "runs without a window.\n\n";
        return demo::compare_spaces(options) ? exit_well : exit_different_pairs;
    }
    run_probe(options, in_window);
    return exit_well;
}

int run_as_asked(int argc, char **argv)
{
    Options options;
    const std::optional<int> parsed = demo::parse_command_line(argc, argv, options);
    const int status = parsed ? *parsed : run_demo(options);
    if (!std::cout.flush())
        throw std::runtime_error("standard output cannot be written");
    return status;
}
} // namespace

int main(int argc, char **argv)
{
    try
    {
        return run_as_asked(argc, argv);
    }
    catch (const std::exception &failure)
    {
        std::cerr << "predictive_haptic_demo: " << failure.what() << '\n';
        return exit_failed;
    }
}
