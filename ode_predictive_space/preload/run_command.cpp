#include "ode_predictive_space/preload/run_command.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <system_error>

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "ode_predictive_space/preload/say.h"
#include "ode_predictive_space/preload/settings.h"
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

// The library lies beside the tool in a build, and in the folder of libraries of an installation.
std::string path_of_preload()
{
    std::error_code none; // the path is empty then, and the library missing
    const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
    const std::filesystem::path installed = here / PRELOAD_DIR / PRELOAD_FILE;
    const std::filesystem::path path =
        std::filesystem::weakly_canonical(exists(here / PRELOAD_FILE, none) ? here / PRELOAD_FILE : installed, none);
    if (!exists(path, none))
        throw Refusal(path.string() +
                      " is missing, without which no space can be replaced: install the launcher again");
    if (path.string().find_first_of(": ") != std::string::npos)
        throw Refusal("LD_PRELOAD cannot name a file with a space or a colon in its path, as " + path.string() +
                      ": install the launcher elsewhere");
    return path;
}

// Libraries that are preloaded already stay in front, because some must be the first.
void preload()
{
    const std::string others = in_environment("LD_PRELOAD");
    set("LD_PRELOAD", (others.empty() ? "" : others + ":") + path_of_preload());
}

// Returns the absolute path, because processes may have different working directories, and refuses a file that cannot be written.
// The file is left to the program to make. A pipe is not opened, because its reader would notice.
std::string writable(const std::string &file, const std::string &option)
{
    const std::string path = std::filesystem::absolute(file);
    std::error_code none;
    const bool existed = std::filesystem::exists(path, none);
    if (existed && !std::filesystem::is_regular_file(path, none))
        return path;
    errno = 0;
    if (!std::ofstream(path, std::ios::app))
        throw Refusal(option + ": " + path + " cannot be written: " + std::strerror(errno ? errno : EIO));
    if (!existed)
        std::filesystem::remove(path, none);
    return path;
}

// Removes the file of an earlier run: a program takes an existing file for that of another process.
std::string recording_file(const std::string &file)
{
    const std::string path = writable(file, "--record");
    std::error_code none;
    if (!std::filesystem::exists(path, none))
        return path;
    if (!std::filesystem::is_regular_file(path, none))
        throw Refusal("--record: " + path + " is not a regular file: name another one");
    if (recording::HistoryFile(path, false).error() == EBUSY)
        throw Refusal("--record: another program is recording to " + path + ": name another file");
    std::filesystem::remove(path, none);
    return path;
}

// For a page, 64 MB are enough: they are replayed many times.
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
    if (!options.trace_file.empty())
        set("ODE_PREDICTIVE_TRACE", writable(options.trace_file, "--trace"));
    if (!options.record_file.empty())
        set("ODE_PREDICTIVE_RECORD", options.record_file = recording_file(options.record_file));
    if (!options.record_limit.empty() && bytes_named(options.record_limit) == 0)
        throw Refusal("--record-limit: '" + options.record_limit + "' is not a number of bytes, such as 100M");
    set("ODE_PREDICTIVE_RECORD_LIMIT", options.record_limit);
}

[[noreturn]] void become(char **command)
{
    execvp(command[0], command);
    const int reason = errno;
    std::fprintf(stderr, "ode-predictive: %s cannot be started: %s\n", printable(command[0]).c_str(),
                 std::strerror(reason));
    _exit(reason == ENOENT ? 127 : 126);
}

pid_t program;

// Signals of the terminal reach the program without our help.
void pass_on(int signal, siginfo_t *from, void * /*context*/)
{
    const bool is_sent_by_a_process = from->si_code <= 0;
    if (is_sent_by_a_process)
        kill(program, signal);
}

// Runs the program and passes signals on to it. Standard input and output are the program's alone.
// @return its status, as from waitpid().
int run_and_wait(char **command)
{
    sigset_t all, before;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, &before);
    const auto on_child_end = std::signal(SIGCHLD, SIG_DFL); // it may be ignored, which is inherited
    program = fork();
    if (program < 0)
        throw Refusal(std::string("a process for the program cannot be created: ") + std::strerror(errno));
    if (program == 0)
    {
        std::signal(SIGCHLD, on_child_end);
        sigprocmask(SIG_SETMASK, &before, nullptr);
        become(command);
    }
    struct sigaction action = {};
    action.sa_sigaction = pass_on;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    std::map<int, struct sigaction> former; // some may be ignored, as by nohup
    for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGUSR1, SIGUSR2})
        sigaction(signal, &action, &former[signal]);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    close(STDIN_FILENO);
    close(STDOUT_FILENO);
    int status = 0;
    while (waitpid(program, &status, 0) < 0 && errno == EINTR)
    {}
    for (const auto &[signal, disposition] : former)
        sigaction(signal, &disposition, nullptr);
    return status;
}

// Ends this process as the program ended: with its exit status, or by its signal, but without a second core file.
[[noreturn]] void end_like(int status, bool has_report)
{
    if (WIFSIGNALED(status))
    {
        prctl(PR_SET_DUMPABLE, 0);
        std::signal(WTERMSIG(status), SIG_DFL);
        raise(WTERMSIG(status));
    }
    std::exit(WEXITSTATUS(status) == 0 && !has_report ? 2 : WEXITSTATUS(status));
}

bool write_report(const RunOptions &options)
try
{
    std::string title = "ode-predictive run";
    for (const std::string &word : options.command)
        title += " " + word;
    if (!std::filesystem::exists(options.record_file))
        say("nothing was recorded: no call of dSpaceCollide() was seen; ode-predictive run --help says which programs "
            "are reached");
    say("report: %s", recording::write_report(options.report_folder, options.record_file, title).c_str());
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
    preload();
    if (options.report_folder.empty())
        become(command.data());
    const int status = run_and_wait(command.data());
    end_like(status, write_report(options));
}
} // namespace ode_predictive_space::preload
