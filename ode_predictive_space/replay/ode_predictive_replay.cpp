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
  --reference KIND
                  compare pairs with those of these spaces (default: simple,
                  which takes long among many thousands of geoms)
  --from N, --to N, --every N
                  count the instructions of the events N, N + 1, ... and before
                  N, and of each Nth of these (default: of all)
  --contacts      count also a dCollide() for each callback
  --whole-life    count also what is before the first event, the making of all
                  geoms, and their end
  --json FILE     write the figures to FILE, too: for each kind of spaces the
                  cost per event, the pairs of these events, and whether all
                  pairs agree
  --report DIR    write a page, DIR/index.html, that says what the recorded
                  program would gain; DIR is made unless it exists
  --help, --version

An event is a dSpaceCollide() or a dSpaceCollide2(). By sphere and by shape,
pairs are left out; then dCollide() must find no contact in any of them. ODE's
own spaces may end by an assertion, which is said.

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
    std::string report_folder; // empty: there is no page to write
    std::string json_file;     // empty: none
    SpaceKind reference = SpaceKind::simple;
    CountedEvents events;          // whose instructions count
    const char *counted = nullptr; // for the process under callgrind
    std::string file;
};

SpaceKind kind_of(const char *name)
{
    const auto kind = kind_named(name);
    if (!kind)
        fail("'%s' is not own, simple, hash, quadtree, sap, box, sphere or shape", name);
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

std::size_t number_of(const char *text, std::size_t least)
{
    char *end = nullptr;
    errno = 0;
    const unsigned long long number = std::strtoull(text, &end, 10);
    if (*text < '0' || *text > '9' || *end != '\0' || errno != 0 || number < least)
        fail("'%s' is not a whole number of at least %zu", text, least);
    return number;
}

void take_option(int option, const char *option_text, Options &options)
{
    switch (option)
    {
    case 'p':
        options.reference = kind_of(optarg);
        return;
    case 'f':
        options.events.from = number_of(optarg, 0);
        return;
    case 'u':
        options.events.to = number_of(optarg, 1);
        return;
    case 'e':
        options.events.every = number_of(optarg, 1);
        return;
    case 'd':
        options.events.contacts = true;
        return;
    case 'w':
        options.events.whole_life = true;
        return;
    case 'j':
        options.json_file = optarg;
        return;
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
    const option known[] = {
        {"space", required_argument, nullptr, 's'},   {"times", no_argument, nullptr, 't'},
        {"report", required_argument, nullptr, 'r'},  {"reference", required_argument, nullptr, 'p'},
        {"from", required_argument, nullptr, 'f'},    {"to", required_argument, nullptr, 'u'},
        {"every", required_argument, nullptr, 'e'},   {"contacts", no_argument, nullptr, 'd'},
        {"whole-life", no_argument, nullptr, 'w'},    {"json", required_argument, nullptr, 'j'},
        {"counted", required_argument, nullptr, 'c'}, {"help", no_argument, nullptr, 'h'},
        {"version", no_argument, nullptr, 'v'},       {}};
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

// Of the spaces alone, per event: instructions or microseconds.
class CostsOfSpaces
{
public:
    CostsOfSpaces(const Options &options, const history::Recording &recording, bool instructions)
        : options_(options), recording_(recording), instructions_(instructions),
          events_(instructions ? options.events.count_of(recording.events().size()) : recording.events().size())
    {
        if (events_ == 0)
            return;
        if (instructions)
            counted_without_ = counted(SpaceKind::none);
        else
            measured_without_ = measured(SpaceKind::none);
    }

    std::size_t events() const { return events_; }

    // None when the spaces end the program.
    std::optional<double> of(SpaceKind kind) const
    {
        const double events = static_cast<double>(events_);
        if (instructions_)
        {
            const auto count = counted(kind);
            if (!count || !counted_without_)
                return std::nullopt;
            return (static_cast<double>(*count) - static_cast<double>(*counted_without_)) / events;
        }
        const Cost cost = without(measured_without_, measured(kind));
        if (!cost.failure.empty())
            return std::nullopt;
        return 1e6 * (cost.collides + cost.notices) / events;
    }

    std::string text(const std::optional<double> &cost) const
    {
        if (events_ == 0)
            return "";
        return cost ? formatted("%.4g", instructions_ ? 1e-3 * *cost : *cost) : "-";
    }

private:
    std::optional<std::uint64_t> counted(SpaceKind kind) const
    {
        return count_instructions(own_path(), options_.file, kind, options_.events);
    }

    Cost measured(SpaceKind kind) const
    {
        return measure_repeatedly(recording_, kind, recording_.events().size(), 1e9);
    }

    const Options &options_;
    const history::Recording &recording_;
    bool instructions_;
    std::size_t events_; // that are counted or measured
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

// The figures of --json.
class Figures
{
public:
    explicit Figures(const CountedEvents &events) : events_(events) {}

    void add(const char *space, const std::optional<double> &cost, const Pairs &pairs, bool agrees)
    {
        std::uint64_t count = 0;
        for (std::size_t event = 0; event < pairs.events.size(); ++event)
            count += events_.has(event) ? pairs.events[event].count : 0;
        spaces_ += formatted("%s\n  {\"space\": \"%s\", \"cost_per_event\": %s, \"pairs\": %llu, \"agrees\": %s}",
                             spaces_.empty() ? "" : ",", space, cost ? formatted("%.17g", *cost).c_str() : "null",
                             static_cast<unsigned long long>(count), agrees ? "true" : "false");
    }

    void write(const std::string &path, const char *unit, std::size_t counted, std::size_t events) const
    {
        std::FILE *const file = std::fopen(path.c_str(), "w");
        const std::string text = formatted("{\"unit\": \"%s\", \"counted_events\": %zu, \"events\": %zu, \"spaces\": [",
                                           unit, counted, events) +
                                 spaces_ + "]}\n";
        const bool written = file && std::fputs(text.c_str(), file) >= 0;
        if (!file || std::fclose(file) != 0 || !written)
            fail("--json: %s cannot be written: %s", path.c_str(), std::strerror(errno));
    }

private:
    const CountedEvents &events_;
    std::string spaces_;
};

bool replay_all(const Options &options, const history::Recording &recording)
{
    const bool instructions = !options.times && has_valgrind();
    if (!instructions && options.events.count_of(recording.events().size()) < recording.events().size())
        fail("--from, --to and --every choose events whose instructions are counted; times are measured of all");
    describe(options, recording);
    const Pairs reference = find_pairs(recording, options.reference);
    const CostsOfSpaces costs(options, recording, instructions);
    std::printf("\n%-26s %12s  %s\n", "spaces", instructions ? "1000 instr." : "microseconds", "pairs");
    bool all_agree = true;
    Figures figures(options.events);
    for (const SpaceKind kind : options.kinds)
    {
        const Pairs pairs = kind == options.reference ? reference : find_pairs(recording, kind);
        const Verdict verdict = compare(recording, kind, pairs, reference, options.reference);
        const std::string name = kind == SpaceKind::own ? "own (" + name_of_own_space(recording) + ")" : name_of(kind);
        const std::optional<double> cost = costs.events() > 0 ? costs.of(kind) : std::nullopt;
        std::printf("%-26s %12s  %s\n", name.c_str(), costs.text(cost).c_str(), verdict.text.c_str());
        figures.add(name_of(kind), cost, pairs, verdict.agrees);
        all_agree &= verdict.agrees;
    }
    if (!options.json_file.empty())
        figures.write(options.json_file, instructions ? "instructions" : "microseconds", costs.events(),
                      recording.events().size());
    std::printf(
        "\n%s are means per event, with the notices before it. Pairs are compared with those of %s spaces.\n%s\n",
        instructions ? "Instructions" : "Times", name_of(options.reference),
        compared_with_program(recording, reference, options.reference).c_str());
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
        replay_to_be_counted(recording, counted_kind(options.counted), options.events);
    else if (!options.report_folder.empty())
        write_report(options, recording);
    else
        status = replay_all(options, recording) ? 0 : 1;
    dCloseODE();
    if (std::fclose(stdout) != 0)
        fail("standard output cannot be written: %s", std::strerror(errno));
    return status;
}
