// The launcher: runs a program with the preload, and tells what the program counted when the program itself cannot.

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "ode_predictive_space/preload/counts_file.h"
#include "ode_predictive_space/preload/live.h"
#include "ode_predictive_space/preload/report.h"
#include "ode_predictive_space/preload/run_options.h"
#include "ode_predictive_space/preload/say.h"
#include "ode_predictive_space/preload/supervise.h"

using namespace ode_predictive_space::preload;

namespace
{
// Beside the launcher in a build; where an installation has its libraries.
std::string path_of_preload()
{
    std::error_code none; // the path is empty then, and the library missing
    const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
    const std::filesystem::path installed = here / PRELOAD_DIR / PRELOAD_FILE;
    const std::filesystem::path path =
        std::filesystem::weakly_canonical(exists(here / PRELOAD_FILE, none) ? here / PRELOAD_FILE : installed, none);
    if (!exists(path, none))
        fail("%s is missing", path.c_str());
    if (path.string().find_first_of(": ") != std::string::npos)
        fail("LD_PRELOAD cannot name a file with a space or a colon in its path: %s", path.c_str());
    return path;
}

void preload()
{
    const char *others = std::getenv("LD_PRELOAD");
    const std::string all = path_of_preload() + (others && *others ? std::string(":") + others : "");
    setenv("LD_PRELOAD", all.c_str(), 1);
}

Settings wanted()
{
    std::vector<std::string> complaints; // the program makes them
    return read_settings([](const char *name) { return std::getenv(name); }, complaints);
}

bool is_alive(int process)
{
    std::ifstream file("/proc/" + std::to_string(process) + "/stat");
    std::string text;
    std::getline(file, text);
    const std::size_t name_end = text.rfind(") ");
    return name_end != std::string::npos && std::strchr("ZX", text[name_end + 2]) == nullptr;
}

// Of each process that is gone what it has not said itself. One that lives on will say it when it ends.
void report_the_rest(CountsFile &file, const Settings &settings)
{
    std::map<std::uint32_t, std::vector<SpaceCounts *>> processes;
    for (SpaceCounts *counts : file.pages())
        if (counts->state == PageState::counting)
            processes[counts->process].push_back(counts);
    for (const auto &[number, spaces] : processes)
    {
        const SpaceCounts &first = *spaces.front();
        const std::string program(first.program, strnlen(first.program, sizeof first.program));
        if (!is_alive(first.process_id))
            write_report(settings, report_text(settings, program.c_str(), first.process_id, spaces), spaces);
    }
}

// Otherwise a question about a program without ODE would get no answer.
void tell_when_nothing_was_counted(CountsFile &counts)
{
    if (counts.pages().empty())
        say("no process with a space of ODE was seen");
}

int run(const RunOptions &options, CountsFile &counts)
{
    if (!options.watch)
        return run_and_wait(options.command, counts.file(), {});
    LiveCounters live(counts);
    const int status = run_and_wait(options.command, counts.file(), [&] { live.show(); });
    live.end();
    return status;
}

void write_plots(const RunOptions &options, CountsFile &counts, const Settings &settings)
{
    try
    {
        const std::string page = ode_predictive_space::report::write_page(
            options.report_folder, page_of(options.command[0], counts.pages(), settings));
        say("report: %s", page.c_str());
    }
    catch (const std::exception &failure)
    {
        say("%s", failure.what());
    }
}
} // namespace

int main(int argc, char **argv)
{
    const RunOptions options = take_options(argc, argv);
    preload();
    const Settings settings = wanted();
    if (!settings.stats && !settings.compare && !options.watch && options.report_folder.empty())
        become(options.command);
    const std::unique_ptr<CountsFile> counts = CountsFile::create();
    if (!counts)
    {
        say("no memory for counts that outlive the program: %s", std::strerror(errno));
        become(options.command);
    }
    setenv(counts_variable, counts->name().c_str(), 1);
    const int status = run(options, *counts);
    report_the_rest(*counts, settings);
    tell_when_nothing_was_counted(*counts);
    if (!options.report_folder.empty())
        write_plots(options, *counts, settings);
    end_like(status);
}
