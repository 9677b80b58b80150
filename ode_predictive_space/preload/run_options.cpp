#include "ode_predictive_space/preload/run_options.h"

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <getopt.h>

#include "ode_predictive_space/history/history_file.h"
#include "ode_predictive_space/preload/settings.h"
#include "ode_predictive_space/preload/survivors.h"
#include "ode_predictive_space/process/printable.h"
#include "ode_predictive_space/report/page.h"

namespace ode_predictive_space::preload
{
namespace
{
constexpr char help[] = R"(Usage: ode-predictive-run [options] PROGRAM [ARGUMENT...]

Runs a program that uses the Open Dynamics Engine (ODE) with predictive
collision spaces in place of the spaces that it makes. The program is not
changed and does not notice: its spaces have the class that it asked for, and
its near callback gets the pairs that dSimpleSpace would report, in another
order.

  --space LIST       which spaces are replaced: hash, quadtree, sap, simple,
                     separated by commas; all; none (default:
                     hash,quadtree,sap; simple ones are what programs use for
                     tiny groups)
  --proximity KIND   box: report the pairs whose bounding boxes overlap, as ODE
                     does (default)
                     sphere: leave out those whose bounding spheres do not
                     overlap; no contact is lost
                     shape: leave out those whose shapes cannot touch; no
                     contact is lost that ODE's own colliders find
  --stats[=FILE]     at the end, write to standard error, or append to FILE,
                     what each space did and the time it took
  --watch            show live counters on standard error, twice a second
  --report DIR       at the end, write a page that says what the program would
                     gain, with plots, DIR/index.html; the folder is made
                     unless it exists. For it the program is recorded, up to
                     64 MB in DIR/recording.odehist, and the recording replayed
  --record FILE      record what the program tells its spaces and asks them, for
                     ode-predictive-replay FILE; each further process that
                     collides gets a file of its own, FILE.<its number>
  --record-limit N   bytes of a recording, as 100M; there it ends, at the end of
                     a collide (default: 256M)
  --compare          check each collide against all pairs, and report
                     differences on standard error; slow
  --trace=FILE       add a line to FILE for each collide: how many pairs, and a
                     hash of them. To make runs comparable, the callback then
                     gets the pairs after the collide, in an order that does
                     not depend on the space; with --space none the program's
                     own spaces are traced
  --help, --version

Each option but --watch and --report sets an environment variable, which the
programs that PROGRAM starts inherit, and which can be set without this
launcher: ODE_PREDICTIVE_SPACE=LIST, ODE_PREDICTIVE_PROXIMITY=KIND,
ODE_PREDICTIVE_STATS=1 or FILE, ODE_PREDICTIVE_COMPARE=1,
ODE_PREDICTIVE_TRACE=FILE, ODE_PREDICTIVE_RECORD=FILE,
ODE_PREDICTIVE_RECORD_LIMIT=N; and LD_PRELOAD, the path of
libode_predictive_space_preload.so.

With --stats, --compare, --watch, --report, --record or --trace the launcher
stays until PROGRAM has ended, passes signals on to it, and also reports on a
program that ended by a signal, a crash or _exit(). Programs that outlive
PROGRAM are named, not waited for; their statistics are written when they exit.
Without these options, PROGRAM takes the launcher's place.

The program must use the shared library of ODE that this was built for. Others
keep their own spaces, and a line on standard error says why: an ODE of another
precision or layout, a second copy in the process, an ODE built into the
program. An ODE inside a program without symbols is not seen and not replaced.
LD_PRELOAD has no effect on set-user-ID programs and on statically linked ones.

Exit status: the program's, also when a signal ended it; 2 for a wrong option,
and instead of 0 when some output of these options could not be written, which a
line on standard error says; 126 or 127 when the program cannot be started.
Statistics that FILE does not take go to standard error.
)";

bool is_one_of(const std::string &word, std::initializer_list<const char *> known)
{
    return std::any_of(known.begin(), known.end(), [&](const char *each) { return word == each; });
}

void check_spaces(const std::string &list)
{
    if (list.empty())
        fail("--space needs a list");
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');)
        if (!is_one_of(word, {"hash", "quadtree", "sap", "simple", "all", "none"}))
            fail("--space: '%s' is not hash, quadtree, sap, simple, all or none", word.c_str());
}

void check_proximity(const std::string &kind)
{
    if (!is_one_of(kind, {"box", "sphere", "shape"}))
        fail("--proximity: '%s' is not box, sphere or shape", kind.c_str());
}

void set(const char *variable, const std::string &value)
{
    setenv(variable, value.c_str(), 1);
}

// Another process may have another working directory.
std::string absolute(const char *file, const char *option)
{
    if (!*file)
        fail("%s needs a file", option);
    return std::filesystem::absolute(file);
}

// Noticed before the program runs, which alone makes the file. Opening a pipe could be noticed by its reader.
std::string writable(const char *file, const char *option)
{
    const std::string path = absolute(file, option);
    std::error_code none;
    const bool existed = std::filesystem::exists(path, none);
    if (existed && !std::filesystem::is_regular_file(path, none))
        return path;
    if (!std::ofstream(path, std::ios::app))
        fail("%s: cannot write %s", option, path.c_str());
    if (!existed)
        std::filesystem::remove(path, none);
    return path;
}

// The file of an earlier run goes: a program takes an existing one for that of another process. That of a run which has not ended
// stays, also when the process that wrote it has.
std::string recording(const char *file)
{
    const std::string path = writable(file, "--record");
    std::error_code none;
    if (!std::filesystem::exists(path, none))
        return path;
    if (!std::filesystem::is_regular_file(path, none))
        fail("--record: %s is no regular file", path.c_str());
    const std::vector<std::string> others = processes_with("ODE_PREDICTIVE_RECORD=" + path);
    if (!others.empty())
        fail("--record: %s is the recording of another run: %s", path.c_str(), list_of(others).c_str());
    if (history::HistoryFile(path, false).error() == EBUSY)
        fail("--record: another program is recording to %s", path.c_str());
    std::filesystem::remove(path, none);
    return path;
}

const char *checked_limit(const char *text)
{
    if (bytes_named(text) == 0)
        fail("--record-limit: '%s' is no number of bytes, as 100M", text);
    return text;
}

std::string report_folder(const char *folder)
{
    const std::string path = absolute(folder, "--report");
    try
    {
        report::prepare_folder(path);
    }
    catch (const std::runtime_error &failure)
    {
        fail("--report: %s", failure.what());
    }
    return path;
}

[[noreturn]] void show(const char *text)
{
    if (std::fputs(text, stdout) < 0 || std::fclose(stdout) != 0)
        fail("standard output cannot be written: %s", std::strerror(errno));
    std::exit(0);
}

void take_option(int option, const char *option_text, RunOptions &options)
{
    switch (option)
    {
    case 's':
        check_spaces(optarg);
        return set("ODE_PREDICTIVE_SPACE", optarg);
    case 'p':
        check_proximity(optarg);
        return set("ODE_PREDICTIVE_PROXIMITY", optarg);
    case 'S':
        return set("ODE_PREDICTIVE_STATS", optarg ? writable(optarg, "--stats") : "1");
    case 'c':
        return set("ODE_PREDICTIVE_COMPARE", "1");
    case 't':
        return set("ODE_PREDICTIVE_TRACE", writable(optarg, "--trace"));
    case 'R':
        options.record_file = recording(optarg);
        return set("ODE_PREDICTIVE_RECORD", options.record_file);
    case 'L':
        return set("ODE_PREDICTIVE_RECORD_LIMIT", checked_limit(optarg));
    case 'w':
        options.watch = true;
        return;
    case 'r':
        options.report_folder = report_folder(optarg);
        return;
    case 'h':
        show(help);
    case 'v':
        show("ode-predictive-run " VERSION "\n");
    case ':':
        fail("%s needs a value", option_text);
    default:
        fail("there is no option '%s'; --help lists them", option_text);
    }
}
// A page is not worth more: its replay takes as long as the recorded part did, several times.
void record_for_report(RunOptions &options)
{
    options.record_file = recording((options.report_folder + "/recording.odehist").c_str());
    set("ODE_PREDICTIVE_RECORD", options.record_file);
    setenv("ODE_PREDICTIVE_RECORD_LIMIT", "64M", 0);
}
} // namespace

void fail(const char *format, ...)
{
    char text[5000]; // a path and a sentence
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    std::fprintf(stderr, "ode-predictive-run: %s\n", printable(text).c_str());
    std::exit(2);
}

RunOptions take_options(int argc, char **argv)
{
    RunOptions chosen;
    const option options[] = {
        {"space", required_argument, nullptr, 's'},  {"proximity", required_argument, nullptr, 'p'},
        {"stats", optional_argument, nullptr, 'S'},  {"compare", no_argument, nullptr, 'c'},
        {"trace", required_argument, nullptr, 't'},  {"report", required_argument, nullptr, 'r'},
        {"record", required_argument, nullptr, 'R'}, {"record-limit", required_argument, nullptr, 'L'},
        {"watch", no_argument, nullptr, 'w'},        {"help", no_argument, nullptr, 'h'},
        {"version", no_argument, nullptr, 'v'},      {}};
    opterr = 0;
    for (;;)
    {
        const char *option_text = argv[optind]; // "+": the first word that is no option is the program
        const int option = getopt_long(argc, argv, "+:h", options, nullptr);
        if (option < 0)
            break;
        take_option(option, option_text, chosen);
    }
    if (!argv[optind])
        fail("no program is named; --help explains");
    chosen.command = argv + optind;
    if (!chosen.report_folder.empty() && chosen.record_file.empty())
        record_for_report(chosen);
    return chosen;
}
} // namespace ode_predictive_space::preload
