// A probe among still and moving objects at 1 kHz, with or without a window; or a comparison of spaces.

#include "demos/haptic/report.h"
#include "demos/runs/result_records.h"
#include "demos/runs/spaces.h"
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

demo::RunResult run(const Options &options, bool in_window)
{
    const worlds::WorldFactory factory({options.scene, options.objects, options.seed, -1, false});
    demo::DemoDevice device(haptics::make_device(options.device, options.seed));
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

demo::Report run_probe(Options options, bool in_window)
{
    if (options.device == "mouse" && !in_window)
        throw std::runtime_error("--device mouse needs a window, whose pointer moves the probe");
    if (options.spaces.empty())
        options.spaces = {"predictive"};
    if (!in_window && options.seconds == 0)
        options.seconds = usual_seconds_without_window;
    const haptics::StopRequest stop_request; // signals end the loop with zero force, and the summary is printed
    if (in_window)
        std::cout << "The keys are listed in the window.\n" << std::flush;
    else
        std::cout << "Running for " << options.seconds << " simulated seconds, without a window.\n" << std::flush;
    return demo::report_of(options, run(options, in_window));
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

void write_report(const Options &options, const demo::Report &report)
{
    std::cout << report.page.text;
    if (!options.json_file.empty())
        worlds::write_json(options.json_file, report.json);
    if (!options.report_folder.empty())
        std::cerr << "report: " << recording::write_page(options.report_folder, report.page) << std::endl;
}

demo::Report make_report(const Options &options)
{
    const std::string lack = options.headless ? "" : what_a_window_lacks();
    const bool in_window = !options.headless && !options.compare && lack.empty();
    if (!options.screenshot_file.empty() && !in_window)
        throw std::runtime_error("--screenshot needs a window: " + lack);
    if (in_window || options.wants_one_run)
        return run_probe(options, in_window);
    if (!lack.empty() && !options.compare)
        std::cout << "No window: " << lack << ". The spaces are compared instead. With --device virtual the probe "
                  << "runs without a window.\n\n";
    return demo::compare_spaces(options);
}

int run_as_asked(int argc, char **argv)
{
    Options options;
    std::optional<int> status = demo::parse_command_line(argc, argv, options);
    if (!status)
    {
        check_outputs(options);
        const worlds::OdeSession ode;
        const demo::Report report = make_report(options);
        write_report(options, report);
        status = report.is_good ? exit_well : exit_different_pairs;
    }
    if (!std::cout.flush())
        throw std::runtime_error("standard output cannot be written");
    return *status;
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
