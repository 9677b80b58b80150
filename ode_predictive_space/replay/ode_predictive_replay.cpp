// Replays a recorded history: are the pairs the same in every kind of space, and what do they take?

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <getopt.h>

#include <ode/ode.h>

#include "ode_predictive_space/process/printable.h"
#include "ode_predictive_space/replay/answer.h"
#include "ode_predictive_space/replay/check.h"
#include "ode_predictive_space/replay/formatted.h"
#include "ode_predictive_space/replay/instructions.h"
#include "ode_predictive_space/replay/own_space.h"
#include "ode_predictive_space/replay/replay.h"
#include "ode_predictive_space/report/page.h"

using namespace ode_predictive_space;
using namespace ode_predictive_space::replay;

namespace
{
constexpr char help[] = R"(Usage: ode-predictive-replay [options] FILE

Replays what a program told its collision spaces and asked them, as
ode-predictive-run --record FILE has written it, in spaces of every kind: checks
that they find the same pairs, and prints what they take.

  --space KIND    one kind of space; may be given several times. own: of the
                  class that each space had in the program; simple, hash,
                  quadtree, sap: ODE's; box, sphere, shape: predictive, by what
                  --proximity of ode-predictive-run names (default: all)
  --times         measure times also where valgrind is installed, which
                  otherwise counts instructions
  --report DIR    write a page, DIR/index.html, that says what the recorded
                  program would gain; DIR is made unless it exists
  --help, --version

An event is a dSpaceCollide() or a dSpaceCollide2(). Pairs are compared with
those of simple spaces. By sphere and by shape, pairs are left out; then
dCollide() must find no contact in any of them. ODE's own spaces may end by an
assertion, which is said.

A recording that is cut, as when the program was killed, is replayed up to its
last whole record, and a line says where that is.

Exit status: 0 when all pairs agree; 1 when some do not, or spaces ended; 2 for
a wrong option, for a file without a whole record, and for one that is no
recording or contradicts itself, which a line on standard error says, with the
offset of the byte.
)";

[[noreturn]] __attribute__((format(printf, 1, 2))) void fail(const char *format, ...)
{
    char text[5000]; // a path and a sentence
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    std::fprintf(stderr, "ode-predictive-replay: %s\n", printable(text).c_str());
    std::exit(2);
}

struct Options
{
    std::vector<SpaceKind> kinds;
    bool times = false;
    std::string report_folder;     // empty: there is no page to write
    const char *counted = nullptr; // for the process under callgrind
    std::string file;
};

SpaceKind kind_of(const char *name)
{
    const auto kind = kind_named(name);
    if (!kind)
        fail("--space: '%s' is not own, simple, hash, quadtree, sap, box, sphere or shape", name);
    return *kind;
}

SpaceKind counted_kind(const std::string &name)
{
    return name == name_of(SpaceKind::none) ? SpaceKind::none : kind_of(name.c_str());
}

[[noreturn]] void show(const char *text)
{
    if (std::fputs(text, stdout) < 0 || std::fclose(stdout) != 0)
        fail("standard output cannot be written: %s", std::strerror(errno));
    std::exit(0);
}

void take_option(int option, const char *option_text, Options &options)
{
    switch (option)
    {
    case 's':
        options.kinds.push_back(kind_of(optarg));
        return;
    case 't':
        options.times = true;
        return;
    case 'r':
        options.report_folder = optarg;
        return;
    case 'c':
        options.counted = optarg;
        return;
    case 'h':
        show(help);
    case 'v':
        show("ode-predictive-replay " VERSION "\n");
    case ':':
        fail("%s needs a value", option_text);
    default:
        fail("there is no option '%s'; --help lists them", option_text);
    }
}

Options options_of(int argc, char **argv)
{
    const option known[] = {{"space", required_argument, nullptr, 's'},
                            {"times", no_argument, nullptr, 't'},
                            {"report", required_argument, nullptr, 'r'},
                            {"counted", required_argument, nullptr, 'c'},
                            {"help", no_argument, nullptr, 'h'},
                            {"version", no_argument, nullptr, 'v'},
                            {}};
    Options options;
    opterr = 0;
    for (;;)
    {
        const char *option_text = argv[std::min(optind, argc - 1)];
        const int option = getopt_long(argc, argv, ":h", known, nullptr);
        if (option < 0)
            break;
        take_option(option, option_text, options);
    }
    if (argc - optind != 1)
        fail(argc == optind ? "no file is named; --help explains" : "one file is replayed at a time");
    options.file = argv[optind];
    if (options.kinds.empty())
        options.kinds.assign(all_kinds.begin(), all_kinds.end());
    return options;
}

history::Recording read(const std::string &file)
{
    try
    {
        return history::Recording::read(file);
    }
    catch (const std::exception &failure)
    {
        fail("%s: %s", file.c_str(), failure.what());
    }
}

void describe(const Options &options, const history::Recording &recording)
{
    std::printf("%s: %zu events, %u geoms (%u of them only as their boxes), %u bodies, %.3g MB; %s\n",
                printable(options.file).c_str(), recording.events().size(), recording.geom_count(),
                recording.stand_ins(), recording.body_count(), 1e-6 * static_cast<double>(recording.bytes()),
                printable(recording.note()).c_str());
    std::printf("%s\n", completeness_of(recording).c_str());
    if (const std::string unknown = unknown_notices(recording); !unknown.empty())
        std::printf("%s\n", unknown.c_str());
}

std::string own_path()
{
    std::error_code none;
    return std::filesystem::read_symlink("/proc/self/exe", none).string();
}

// Of the spaces alone, per event.
class CostsOfSpaces
{
public:
    CostsOfSpaces(const Options &options, const history::Recording &recording, bool instructions)
        : file_(options.file), recording_(recording), instructions_(instructions)
    {
        if (recording.events().empty())
            return;
        if (instructions)
            counted_without_ = count_instructions(own_path(), file_, SpaceKind::none);
        else
            measured_without_ = measured(SpaceKind::none);
    }

    std::string of(SpaceKind kind) const
    {
        if (recording_.events().empty())
            return "";
        const double events = static_cast<double>(recording_.events().size());
        if (instructions_)
        {
            const auto count = count_instructions(own_path(), file_, kind);
            if (!count || !counted_without_)
                return "-";
            return formatted("%.4g",
                             1e-3 * (static_cast<double>(*count) - static_cast<double>(*counted_without_)) / events);
        }
        const Cost cost = without(measured_without_, measured(kind));
        if (!cost.failure.empty())
            return "-";
        return formatted("%.4g", 1e6 * (cost.collides + cost.notices) / events);
    }

private:
    Cost measured(SpaceKind kind) const
    {
        return measure_repeatedly(recording_, kind, recording_.events().size(), 1e9);
    }

    const std::string &file_;
    const history::Recording &recording_;
    bool instructions_;
    std::optional<std::uint64_t> counted_without_;
    Cost measured_without_;
};

void write_report(const Options &options, const history::Recording &recording)
{
    try
    {
        report::prepare_folder(options.report_folder);
        const report::Page page = {printable(options.file), printable(recording.note()), {}, answer_for(recording)};
        std::printf("%s\n", printable(report::write_page(options.report_folder, page)).c_str());
    }
    catch (const std::runtime_error &failure)
    {
        fail("--report: %s", failure.what());
    }
}

bool replay_all(const Options &options, const history::Recording &recording)
{
    const bool instructions = !options.times && has_valgrind();
    describe(options, recording);
    const Pairs simple = find_pairs(recording, SpaceKind::simple);
    const CostsOfSpaces costs(options, recording, instructions);
    std::printf("\n%-26s %12s  %s\n", "spaces", instructions ? "1000 instr." : "microseconds", "pairs");
    bool all_agree = true;
    for (const SpaceKind kind : options.kinds)
    {
        const Pairs pairs = kind == SpaceKind::simple ? simple : find_pairs(recording, kind);
        const Verdict verdict = compare(recording, kind, pairs, simple);
        const std::string name = kind == SpaceKind::own ? "own (" + name_of_own_space(recording) + ")" : name_of(kind);
        std::printf("%-26s %12s  %s\n", name.c_str(), costs.of(kind).c_str(), verdict.text.c_str());
        all_agree &= verdict.agrees;
    }
    std::printf(
        "\n%s are means per event, with the notices before it. Pairs are compared with those of simple spaces.\n%s\n",
        instructions ? "Instructions" : "Times", compared_with_program(recording, simple).c_str());
    return all_agree;
}
} // namespace

int main(int argc, char **argv)
{
    const Options options = options_of(argc, argv);
    const history::Recording recording = read(options.file);
    if (recording.records().empty())
        fail("%s: %s", options.file.c_str(), completeness_of(recording).c_str());
    dInitODE2(0);
    int status = 0;
    if (options.counted)
        replay_to_be_counted(recording, counted_kind(options.counted));
    else if (!options.report_folder.empty())
        write_report(options, recording);
    else
        status = replay_all(options, recording) ? 0 : 1;
    dCloseODE();
    if (std::fclose(stdout) != 0)
        fail("standard output cannot be written: %s", std::strerror(errno));
    return status;
}
