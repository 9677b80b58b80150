// The launcher: runs a program with the preload, and tells what the program counted when the program itself cannot.

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include <unistd.h>

#include "ode_predictive_space/preload/counts_file.h"
#include "ode_predictive_space/preload/gain.h"
#include "ode_predictive_space/preload/live.h"
#include "ode_predictive_space/preload/program_file.h"
#include "ode_predictive_space/preload/report.h"
#include "ode_predictive_space/preload/run_options.h"
#include "ode_predictive_space/preload/say.h"
#include "ode_predictive_space/preload/supervise.h"
#include "ode_predictive_space/preload/survivors.h"

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

std::string variable(const char *name)
{
    const char *value = std::getenv(name);
    return value ? value : "";
}

// As execvp() finds it; empty: nowhere.
std::string path_of_program(const std::string &program)
{
    if (program.find('/') != std::string::npos)
        return program;
    std::istringstream folders(variable("PATH"));
    for (std::string folder; std::getline(folders, folder, ':');)
        if (const std::string path = folder + "/" + program; access(path.c_str(), X_OK) == 0)
            return path;
    return "";
}

// GCC's shared runtime, and Clang's, ends a program in which it is not the first library, before any of ours runs.
void refuse_sanitizer_behind_us(const char *program, const std::string &others)
{
    const std::string first = std::filesystem::path(others.substr(0, others.find_first_of(": "))).filename();
    const std::string options = variable("ASAN_OPTIONS");
    for (const std::string runtime : {"libasan.so", "libclang_rt.asan"})
    {
        char library[256];
        find_needed_library(path_of_program(program).c_str(), runtime.c_str(), library, sizeof library);
        if (*library && first.rfind(runtime, 0) != 0 && options.find("verify_asan_link_order=0") == std::string::npos)
            fail("%s is built with AddressSanitizer, whose library has to be loaded before any other: put "
                 "LD_PRELOAD=%s before the command",
                 program, library);
    }
}

// Libraries that are preloaded already stay in front: some have to be the first.
void preload(const char *program)
{
    const std::string others = variable("LD_PRELOAD");
    refuse_sanitizer_behind_us(program, others);
    const std::string all = (others.empty() ? "" : others + ":") + path_of_preload();
    setenv("LD_PRELOAD", all.c_str(), 1);
}

Settings wanted()
{
    std::vector<std::string> complaints; // the program makes them
    return read_settings([](const char *name) { return std::getenv(name); }, complaints);
}

std::string text_of(char *const *command)
{
    std::string text = *command;
    while (*++command)
        text += std::string(" ") + *command;
    return text;
}

// Not `counted`: that is the question of a launcher around this one.
bool asks_for_counts(const RunOptions &options, const Settings &settings)
{
    return settings.stats || settings.compare || !settings.trace_file.empty() || options.watch ||
           !options.report_folder.empty() || !options.record_file.empty();
}

// Of each process that is gone what it has not said itself. One that lives on will say it when it ends.
bool report_the_rest(CountsFile &file, const Settings &settings)
{
    std::map<std::uint32_t, std::vector<SpaceCounts *>> processes;
    for (SpaceCounts *counts : file.pages())
        if (counts->state == PageState::counting)
            processes[counts->process].push_back(counts);
    bool all_written = true;
    for (const auto &[number, spaces] : processes)
    {
        const SpaceCounts &first = *spaces.front();
        const std::string program(first.program, strnlen(first.program, sizeof first.program));
        if (!is_alive(first.process_id) &&
            !write_report(settings, report_text(settings, program.c_str(), first.process_id, spaces), spaces))
            all_written = false;
    }
    return all_written;
}

// Otherwise a question about a program without ODE, or about one that a script has left behind, would get no answer.
void tell_what_was_not_counted(CountsFile &counts, const std::vector<std::string> &left)
{
    if (counts.pages().empty())
        say("no process with a space of ODE was seen");
    if (!left.empty())
        say("not waited for, still running: %s", list_of(left).c_str());
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

bool write_plots(const RunOptions &options, CountsFile &counts, const Settings &settings,
                 const std::vector<std::string> &left)
{
    if (options.report_folder.empty())
        return true;
    try
    {
        ode_predictive_space::report::Page page =
            page_of(text_of(options.command), counts.pages(), settings, list_of(left));
        page.answer = gain_of(options.record_file);
        say("report: %s", ode_predictive_space::report::write_page(options.report_folder, page).c_str());
        return true;
    }
    catch (const std::exception &failure)
    {
        say("%s", failure.what());
        return false;
    }
}

// Without counts, programs that end in a regular way say themselves what they did.
[[noreturn]] void run_without_counts(const RunOptions &options)
{
    const char *const reason = std::strerror(errno);
    if (!options.report_folder.empty())
        fail("--report: no memory for counts that outlive the program: %s", reason);
    say("no memory for counts that outlive the program: %s", reason);
    become(options.command);
}
} // namespace

int main(int argc, char **argv)
{
    const RunOptions options = take_options(argc, argv);
    preload(*options.command);
    const Settings settings = wanted();
    if (!asks_for_counts(options, settings))
        become(options.command);
    const std::unique_ptr<CountsFile> counts = CountsFile::create();
    if (!counts)
        run_without_counts(options);
    setenv(counts_variable, counts->name().c_str(), 1);
    const int status = run(options, *counts);
    const std::vector<std::string> left = survivors(*counts);
    bool all_written = report_the_rest(*counts, settings);
    tell_what_was_not_counted(*counts, left);
    all_written = write_plots(options, *counts, settings, left) && all_written;
    end_like(status, all_written && !counts->has_lost_output() && !std::ferror(stderr));
}
