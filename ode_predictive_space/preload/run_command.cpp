#include "ode_predictive_space/preload/run_command.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include <unistd.h>

#include "ode_predictive_space/preload/notes_to_launcher.h"
#include "ode_predictive_space/preload/program_file.h"
#include "ode_predictive_space/preload/say.h"
#include "ode_predictive_space/preload/settings.h"
#include "ode_predictive_space/preload/supervise.h"
#include "ode_predictive_space/recording/commands.h"
#include "ode_predictive_space/recording/history_file.h"
#include "ode_predictive_space/recording/page.h"

namespace ode_predictive_space::preload
{
namespace
{
using Refusal = std::runtime_error;

std::string in_environment(const char *name)
{
    const char *value = std::getenv(name);
    return value ? value : "";
}

void set(const char *name, const std::string &value)
{
    if (!value.empty())
        setenv(name, value.c_str(), 1);
}

// --- The libraries to load ---

// Beside the tool in a build; where an installation has its libraries.
std::string path_of_preload()
{
    std::error_code none; // the path is empty then, and the library missing
    const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
    const std::filesystem::path installed = here / PRELOAD_DIR / PRELOAD_FILE;
    const std::filesystem::path path =
        std::filesystem::weakly_canonical(exists(here / PRELOAD_FILE, none) ? here / PRELOAD_FILE : installed, none);
    if (!exists(path, none))
        throw Refusal(path.string() + " is missing");
    if (path.string().find_first_of(": ") != std::string::npos)
        throw Refusal("LD_PRELOAD cannot name a file with a space or a colon in its path: " + path.string());
    return path;
}

// As execvp() finds it; empty: nowhere.
std::string path_of_program(const std::string &program)
{
    if (program.find('/') != std::string::npos)
        return program;
    std::istringstream folders(in_environment("PATH"));
    for (std::string folder; std::getline(folders, folder, ':');)
        if (const std::string path = folder + "/" + program; access(path.c_str(), X_OK) == 0)
            return path;
    return "";
}

// GCC's shared runtime, and Clang's, ends a program in which it is not the first library, before any of ours runs.
void refuse_sanitizer_behind_us(const std::string &program, const std::string &others)
{
    const std::string first = std::filesystem::path(others.substr(0, others.find_first_of(": "))).filename();
    const std::string options = in_environment("ASAN_OPTIONS");
    for (const std::string runtime : {"libasan.so", "libclang_rt.asan"})
    {
        char library[256];
        find_needed_library(path_of_program(program).c_str(), runtime.c_str(), library, sizeof library);
        if (*library && first.rfind(runtime, 0) != 0 && options.find("verify_asan_link_order=0") == std::string::npos)
            throw Refusal(program +
                          " is built with AddressSanitizer, whose library has to be loaded before any other: put "
                          "LD_PRELOAD=" +
                          library + " before the command");
    }
}

// Libraries that are preloaded already stay in front: some have to be the first.
void preload(const std::string &program)
{
    const std::string others = in_environment("LD_PRELOAD");
    refuse_sanitizer_behind_us(program, others);
    set("LD_PRELOAD", (others.empty() ? "" : others + ":") + path_of_preload());
}

// --- The files to write ---

// Absolute, because another process may have another working directory. That the file cannot be written is noticed before the
// program runs, which alone makes it. Opening a pipe could be noticed by its reader.
std::string writable(const std::string &file, const std::string &option)
{
    const std::string path = std::filesystem::absolute(file);
    std::error_code none;
    const bool existed = std::filesystem::exists(path, none);
    if (existed && !std::filesystem::is_regular_file(path, none))
        return path;
    if (!std::ofstream(path, std::ios::app))
        throw Refusal(option + ": cannot write " + path);
    if (!existed)
        std::filesystem::remove(path, none);
    return path;
}

// The file of an earlier run goes: a program takes an existing one for that of another process.
std::string recording_file(const std::string &file)
{
    const std::string path = writable(file, "--record");
    std::error_code none;
    if (!std::filesystem::exists(path, none))
        return path;
    if (!std::filesystem::is_regular_file(path, none))
        throw Refusal("--record: " + path + " is no regular file");
    if (recording::HistoryFile(path, false).error() == EBUSY)
        throw Refusal("--record: another program is recording to " + path);
    std::filesystem::remove(path, none);
    return path;
}

// A page is not worth more than 64 MB: its replay takes as long as the recorded part did, several times.
void prepare_report(RunOptions &options)
{
    if (options.report_folder.empty())
        return;
    options.report_folder = std::filesystem::absolute(options.report_folder);
    recording::prepare_folder(options.report_folder);
    if (!options.record_file.empty())
        return;
    options.record_file = options.report_folder + "/recording.odehist";
    if (options.record_limit.empty() && in_environment("ODE_PREDICTIVE_RECORD_LIMIT").empty())
        options.record_limit = "64M";
}

void set_variables(RunOptions &options)
{
    prepare_report(options);
    set("ODE_PREDICTIVE_SPACE", options.spaces);
    set("ODE_PREDICTIVE_PROXIMITY", options.proximity);
    if (options.stats == RunOptions::to_standard_error)
        set("ODE_PREDICTIVE_STATS", "1");
    else if (!options.stats.empty())
        set("ODE_PREDICTIVE_STATS", writable(options.stats, "--stats"));
    set("ODE_PREDICTIVE_COMPARE", options.compare ? "1" : "");
    if (!options.trace_file.empty())
        set("ODE_PREDICTIVE_TRACE", writable(options.trace_file, "--trace"));
    if (!options.record_file.empty())
        set("ODE_PREDICTIVE_RECORD", options.record_file = recording_file(options.record_file));
    if (!options.record_limit.empty() && bytes_named(options.record_limit) == 0)
        throw Refusal("--record-limit: '" + options.record_limit + "' is no number of bytes, as 100M");
    set("ODE_PREDICTIVE_RECORD_LIMIT", options.record_limit);
}

Settings settings_of_program()
{
    std::vector<std::string> complaints; // the program makes them
    return read_settings([](const char *name) { return std::getenv(name); }, complaints);
}

// --- After the program's end ---

// Otherwise a question about a program without ODE, or about one that was killed, would get no answer.
void tell_what_is_missing(const NotesToLauncher &notes, const Settings &settings)
{
    const long processes = notes.count(Note::began);
    if (processes == 0)
        say("no process with a space of ODE was seen");
    const long silent = processes - notes.count(Note::finished);
    if (silent > 0 && (settings.stats || settings.compare))
        say("%ld of %ld processes with ODE wrote no statistics: a signal or _exit() ended them, or they still run; "
            "with --record FILE what they did is kept",
            silent, processes);
}

std::string title_of(const RunOptions &options)
{
    std::string title = "ode-predictive run";
    for (const std::string &word : options.command)
        title += " " + word;
    return title;
}

// Signals were blocked while the program ran; a user may interrupt replays.
bool write_report(const RunOptions &options)
try
{
    if (options.report_folder.empty())
        return true;
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);
    say("report: %s", recording::write_report(options.report_folder, options.record_file, title_of(options)).c_str());
    return true;
}
catch (const std::exception &failure)
{
    say("%s", failure.what());
    return false;
}
} // namespace

void run(RunOptions options)
{
    std::vector<char *> command;
    for (std::string &word : options.command)
        command.push_back(word.data());
    command.push_back(nullptr);
    set_variables(options);
    preload(options.command.front());
    const Settings settings = settings_of_program();
    if (!settings.watches())
        become(command.data());
    const std::unique_ptr<NotesToLauncher> notes = NotesToLauncher::create();
    if (!notes)
        throw Refusal(std::string("no memory: ") + std::strerror(errno));
    const int status = run_and_wait(command.data(), notes->file());
    tell_what_is_missing(*notes, settings);
    const bool all_written = write_report(options) && notes->count(Note::lost) == 0 && !std::ferror(stderr);
    end_like(status, all_written);
}
} // namespace ode_predictive_space::preload
