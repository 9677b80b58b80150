// A probe among still and moving objects at 1 kHz, with or without a window.

#include "demos/haptic/report.h"
#include "demos/worlds/spaces.h"
#include "ode_predictive_space/haptics/drivers.h"
#include "ode_predictive_space/haptics/safety.h"
#ifdef HAPTIC_DEMO_HAS_WINDOW
#include "demos/haptic/windowed_run.h"
#include "demos/window/window.h"
#endif

#include <cerrno>
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace
{
using namespace ode_predictive_space;
using demo::Options;

/// The reason for which a window cannot be opened; empty when it can.
std::string what_a_window_lacks()
{
#ifdef HAPTIC_DEMO_HAS_WINDOW
    return window::has_display() ? "" : "as there is no display with OpenGL";
#else
    return "as this build has none: something was missing that CMake named";
#endif
}

demo::RunResult run(const Options &options, [[maybe_unused]] bool in_window)
{
    const worlds::WorldFactory factory({options.scene, options.objects, options.seed, -1, false});
    demo::DemoDevice device(haptics::make_device(options.device, options.seed));
    const auto notice = [](const haptics::Notice &sent) { std::cerr << "-- " << sent.sentence() << std::endl; };
#ifdef HAPTIC_DEMO_HAS_WINDOW
    if (in_window)
        return demo::run_in_window(options, factory, device, notice);
#endif
    demo::RunControl control;
    return demo::HapticRun(options, factory, device, control, notice).run();
}

demo::RunResult run_as_asked(Options &options)
{
    const std::string lack = options.headless ? "as --headless says" : what_a_window_lacks();
    const bool in_window = lack.empty();
    if (!in_window && !options.screenshot_file.empty())
        throw std::runtime_error("--screenshot needs a window: " + lack);
    if (!in_window && options.device == "mouse")
        throw std::runtime_error("--device mouse needs a window, whose pointer moves the probe");
    if (!in_window && options.seconds == 0)
        options.seconds = 5; // as --help says
    if (in_window)
        std::cout << "The keys are listed in the window.\n" << std::flush;
    else
        std::cout << "Running for " << options.seconds << " simulated seconds without a window, " << lack << ".\n"
                  << std::flush;
    const haptics::StopRequest stop_request; // signals end the loop with zero force, and the summary is printed
    return run(options, in_window);
}

void check_writable(const std::string &file)
{
    errno = 0;
    if (!file.empty() && !std::ofstream(file, std::ios::app))
        throw std::runtime_error(file + " cannot be written: " + std::strerror(errno));
}

void check_outputs(const Options &options)
{
    check_writable(options.json_file);
    check_writable(options.screenshot_file);
    if (!options.report_folder.empty())
        recording::prepare_folder(options.report_folder);
}

void write_results(const Options &options, const demo::RunResult &result)
{
    const recording::Page page = demo::page_of(options, result);
    std::cout << page.text;
    if (!options.json_file.empty() &&
        !(std::ofstream(options.json_file) << demo::json_of(options, result).dump(2) << '\n').flush())
        throw std::runtime_error(options.json_file + " cannot be written");
    if (!options.report_folder.empty())
        std::cerr << "report: " << recording::write_page(options.report_folder, page) << std::endl;
}

int run_program(int argc, char **argv)
{
    Options options;
    const std::optional<int> status = demo::parse_command_line(argc, argv, options);
    if (!status)
    {
        check_outputs(options);
        const worlds::OdeSession ode;
        write_results(options, run_as_asked(options));
    }
    if (!std::cout.flush())
        throw std::runtime_error("standard output cannot be written");
    return status.value_or(0);
}
} // namespace

int main(int argc, char **argv)
{
    try
    {
        return run_program(argc, argv);
    }
    catch (const std::exception &failure)
    {
        std::cerr << "predictive_haptic_demo: " << failure.what() << '\n';
        return 2;
    }
}
