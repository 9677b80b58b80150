// The tool ode-predictive: runs programs with predictive spaces, replays what was recorded of them, and says what they would gain.

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "ode_predictive_space/preload/run_command.h"
#include "ode_predictive_space/preload/settings.h"
#include "ode_predictive_space/recording/commands.h"
#include "ode_predictive_space/recording/page.h"
#include "ode_predictive_space/recording/printable.h"

using namespace ode_predictive_space;

namespace
{
constexpr char about_run[] =
    R"(
The program uses the Open Dynamics Engine (ODE) and is not changed: its spaces have the class that it asked for, and its near
callback gets the pairs that dSimpleSpace would report, in another order.

Each option but --report sets an environment variable. The programs that PROGRAM starts inherit it, and it can be set without
this tool: ODE_PREDICTIVE_SPACE=LIST, ODE_PREDICTIVE_PROXIMITY=KIND, ODE_PREDICTIVE_STATS=1 or FILE,
ODE_PREDICTIVE_TRACE=FILE, ODE_PREDICTIVE_RECORD=FILE, ODE_PREDICTIVE_RECORD_LIMIT=N; and LD_PRELOAD, the path of
libode_predictive_space_preload.so.

PROGRAM replaces the tool in its process. With --report the tool stays until PROGRAM has ended, and passes signals on to it.
Each process writes its statistics when it exits; one that has no shared library of ODE, or that a signal or _exit() ends,
writes none. A recording is kept in any case.

The program must use the shared library of ODE that this tool was built for. Others keep their own spaces, and a line on
standard error gives the reason: an ODE of another precision or layout, a second copy in the process, an ODE built into the
program. An ODE inside a program without symbols is neither found nor reported. LD_PRELOAD has no effect on set-user-ID programs
and on statically linked ones.

Exit status: the program's, also when a signal ended it; 2 for a wrong option, and instead of 0 when the page of --report could
not be written; 126 or 127 when the program cannot be started. Output that cannot be written is reported by a line on standard
error; statistics that cannot be written to FILE are written there.)";

constexpr char about_replay[] =
    R"(
An event is a dSpaceCollide() or a dSpaceCollide2(). Instructions are counted by valgrind where it is installed. By sphere and by
shape, pairs are left out; dCollide() must find no contact in any of them. ODE's own spaces may end by an assertion, which is
reported. A recording that is cut, for example because the program was killed, is replayed up to its last whole record, and a
line says where that is.

Exit status: 0 when all pairs agree; 1 when some do not, or spaces ended; 2 for a wrong option, for a file without a whole
record, and for one that is not a recording or contradicts itself: a line on standard error gives the reason and the offset of
the byte.)";

std::string wrong_name_in(const std::string &list)
{
    std::istringstream names(list);
    for (std::string name; std::getline(names, name, ',');)
        if (!preload::is_name_of_spaces(name))
            return "'" + name + "' is not hash, quadtree, sap, simple, all or none";
    return list.empty() ? "the list is empty" : "";
}

void add_run(CLI::App &tool, preload::RunOptions &options)
{
    CLI::App *run =
        tool.add_subcommand("run", "Run an unchanged program with predictive spaces in place of those of ODE: "
                                   "ode-predictive run [OPTIONS] PROGRAM [ARGUMENT...]");
    run->add_option("--space", options.spaces,
                    "Which spaces are replaced: hash, quadtree, sap, simple, separated by commas; all; none (default: "
                    "hash,quadtree,sap; programs use simple ones for tiny groups)")
        ->type_name("LIST")
        ->check(wrong_name_in);
    run->add_option(
           "--proximity", options.proximity,
           "box: report the pairs whose bounding boxes overlap, as ODE does (default); sphere: leave out those "
           "whose bounding spheres do not overlap; shape: leave out those whose shapes cannot touch. No contact is "
           "lost that ODE's own colliders find")
        ->check(CLI::IsMember({"box", "sphere", "shape"}));
    run->add_flag(
        "--stats", options.stats,
        "At the end, write to standard error, or with --stats=FILE append to FILE, what each space did and the time "
        "it took");
    run->add_option(
           "--report", options.report_folder,
           "At the end, write a page that says what the program would gain, DIR/index.html. For this, the program is "
           "recorded, up to 64 MB in DIR/recording.odehist, and the recording is replayed")
        ->type_name("DIR");
    run->add_option("--record", options.record_file,
                    "Record the changes in the program's spaces and the collides, for `ode-predictive replay FILE`; "
                    "each further process that collides gets its own file, FILE.<its number>")
        ->type_name("FILE");
    run->add_option(
           "--record-limit", options.record_limit,
           "Largest size of a recording in bytes, such as 100M; it ends there, after a whole collide (default: 256M)")
        ->type_name("N");
    run->add_option(
           "--trace", options.trace_file,
           "Add a line to FILE for each collide: how many pairs, and a hash of them. To make runs comparable, the "
           "callback then gets the pairs after the collide, in an order that does not depend on the space; with "
           "--space none the program's own spaces are traced")
        ->type_name("FILE");
    run->footer(about_run);
    run->prefix_command();
}

void add_replay(CLI::App &tool, recording::ReplayOptions &options)
{
    CLI::App *replay = tool.add_subcommand(
        "replay", "Replay a recording in spaces of every kind, compare their pairs, and count their instructions");
    std::vector<std::string> kinds;
    for (const recording::SpaceKind kind : recording::all_kinds)
        kinds.emplace_back(name_of(kind));
    replay
        ->add_option(
            "--space", options.spaces,
            "One kind of space; may be given several times. own: the class that each space had in the program; "
            "simple, hash, quadtree, sap: ODE's; box, sphere, shape: predictive (default: all)")
        ->allow_extra_args(false)
        ->check(CLI::IsMember(kinds));
    replay->add_flag("--pairs", options.pairs_alone, "Compare pairs alone, and count no instructions");
    replay
        ->add_option(
            "--reference", options.reference,
            "Compare pairs with those of this kind of space (default: simple, which takes long with many thousands "
            "of geoms)")
        ->check(CLI::IsMember(kinds));
    replay
        ->add_option("--from", options.events.from,
                     "Number of the first event whose instructions are counted, with those of the changes before it "
                     "(default: 0)")
        ->check(CLI::NonNegativeNumber);
    replay->add_option("--to", options.events.to, "Number of the first event that is not counted any more")
        ->check(CLI::PositiveNumber);
    replay->add_option("--every", options.events.every, "Count each Nth event of these")->check(CLI::PositiveNumber);
    replay->add_flag("--contacts", options.events.contacts, "Count also one dCollide() per callback");
    replay->add_flag("--whole-life", options.events.whole_life,
                     "Count also the changes before the first event, the creation of all geoms, and their destruction");
    replay
        ->add_option("--json", options.json_file,
                     "Also write the figures to FILE: for each kind of space the instructions per event, the pairs of "
                     "these events, and whether all pairs agree")
        ->type_name("FILE");
    replay->add_option("--counted", options.counted)->group(""); // for the process under callgrind
    replay->add_option("FILE", options.file, "The recording")->required()->type_name("");
    replay->footer(about_replay);
}

void add_report(CLI::App &tool, std::string &file, std::string &folder)
{
    CLI::App *report =
        tool.add_subcommand("report", "Write a page, DIR/index.html, that says what a recorded program would gain");
    report->add_option("FILE", file, "The recording")->required()->check(CLI::ExistingFile)->type_name("");
    report->add_option("DIR", folder, "The folder for the page; it is made if it does not exist")
        ->required()
        ->type_name("");
}

void check_command(const std::vector<std::string> &words)
{
    if (words.empty() || words.front().rfind('-', 0) == 0)
        return;
    for (const char *command : {"run", "replay", "report"})
        if (words.front() == command)
            return;
    throw std::runtime_error("there is no command " + words.front() + "; the commands are run, replay and report");
}

// Removes "--" and the words after it from those of `run`, and returns them: CLI11 would end the subcommand at "--".
std::vector<std::string> cut_at_mark(std::vector<std::string> &words)
{
    const bool is_run = !words.empty() && words.front() == "run";
    const auto mark = is_run ? std::find(words.begin(), words.end(), "--") : words.end();
    const std::vector<std::string> cut(mark, words.end());
    words.erase(mark, words.end());
    return cut;
}

// The first word that is no option of ours is the program, or what follows "--".
void take_program(const CLI::App &tool, const std::vector<std::string> &cut, preload::RunOptions &options)
{
    options.command = tool.get_subcommand("run")->remaining();
    const bool mark_is_ours = options.command.empty() && !cut.empty();
    options.command.insert(options.command.end(), cut.begin() + (mark_is_ours ? 1 : 0), cut.end());
    if (options.command.empty())
        throw std::runtime_error("no program is named; ode-predictive run --help explains how");
    if (!mark_is_ours && options.command.front()[0] == '-')
        throw std::runtime_error("there is no option '" + options.command.front() + "'; --help lists them");
}

// As this tool is called; links that have the name of a command, ode-predictive-run, are calls of it.
std::vector<std::string> words_of(int argc, char **argv)
{
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    const std::string name = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "";
    for (const std::string command : {"run", "replay", "report"})
        if (name == "ode-predictive-" + command)
            words.insert(words.begin(), command);
    return words;
}

int do_command(int argc, char **argv)
{
    CLI::App tool("Predictive collision spaces for programs that use the Open Dynamics Engine (ODE).",
                  "ode-predictive");
    preload::RunOptions run;
    recording::ReplayOptions replay;
    std::string file, folder;
    add_run(tool, run);
    add_replay(tool, replay);
    add_report(tool, file, folder);
    tool.require_subcommand(1);
    for (CLI::App *each : tool.get_subcommands(nullptr))
        each->set_version_flag("--version", "ode-predictive " VERSION);
    tool.set_version_flag("--version", "ode-predictive " VERSION);
    std::vector<std::string> words = words_of(argc, argv);
    check_command(words);
    const std::vector<std::string> cut = cut_at_mark(words);
    std::reverse(words.begin(), words.end()); // as the parser takes them
    try
    {
        tool.parse(words);
    }
    catch (const CLI::Success &asked) // --help, --version
    {
        return tool.exit(asked);
    }
    if (tool.got_subcommand("run"))
    {
        take_program(tool, cut, run);
        preload::run(run);
    }
    if (tool.got_subcommand("replay"))
        return recording::replay(replay);
    recording::prepare_folder(folder);
    std::printf("%s\n", printable(recording::write_report(folder, file, "ode-predictive report " + file)).c_str());
    return 0;
}
} // namespace

int main(int argc, char **argv)
{
    int status = 2;
    try
    {
        status = do_command(argc, argv);
    }
    catch (const std::exception &failure)
    {
        std::fprintf(stderr, "ode-predictive: %s\n", printable(failure.what()).c_str());
    }
    if (std::fclose(stdout) == 0)
        return status;
    std::fprintf(stderr, "ode-predictive: standard output cannot be written: %s\n", std::strerror(errno));
    return 2;
}
