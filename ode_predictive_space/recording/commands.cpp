#include "ode_predictive_space/recording/commands.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include <ode/ode.h>

#include "ode_predictive_space/recording/answer.h"
#include "ode_predictive_space/recording/check.h"
#include "ode_predictive_space/recording/formatted.h"
#include "ode_predictive_space/recording/instructions.h"
#include "ode_predictive_space/recording/page.h"
#include "ode_predictive_space/recording/printable.h"
#include "ode_predictive_space/recording/replay.h"

namespace ode_predictive_space::recording
{
namespace
{
Recording read(const std::string &file)
try
{
    return Recording::read(file);
}
catch (const std::exception &failure)
{
    throw std::runtime_error(file + ": " + failure.what());
}

std::vector<SpaceKind> kinds_of(const ReplayOptions &options)
{
    if (options.spaces.empty())
        return {all_kinds.begin(), all_kinds.end()};
    std::vector<SpaceKind> kinds;
    for (const std::string &name : options.spaces)
        kinds.push_back(kind_named(name).value());
    return kinds;
}

void describe(const std::string &file, const Recording &recording)
{
    std::printf("%s: %zu events, %u geoms (%u of them only as their boxes), %u bodies, %.3g MB; %s\n",
                printable(file).c_str(), recording.events().size(), recording.geom_count(), recording.stand_ins(),
                recording.body_count(), 1e-6 * static_cast<double>(recording.bytes()),
                printable(recording.note()).c_str());
    std::printf("%s\n", completeness_of(recording).c_str());
    if (const std::string unknown = unknown_notices(recording); !unknown.empty())
        std::printf("%s\n", unknown.c_str());
}

class Counter
{
public:
    Counter(const ReplayOptions &options, std::size_t events)
        : options_(options), events_(options.pairs_alone || !has_valgrind() ? 0 : options.events.count_of(events)),
          without_space_(count(SpaceKind::none))
    {}

    std::size_t events() const { return events_; }

    /// None when the spaces end the program, or nothing is counted.
    std::optional<double> per_event(SpaceKind kind) const
    {
        const auto all = count(kind);
        if (!all || !without_space_)
            return std::nullopt;
        return (static_cast<double>(*all) - static_cast<double>(*without_space_)) / static_cast<double>(events_);
    }

private:
    std::optional<std::uint64_t> count(SpaceKind kind) const
    {
        if (events_ == 0)
            return std::nullopt;
        std::error_code none;
        const std::string own_path = std::filesystem::read_symlink("/proc/self/exe", none).string();
        return count_instructions(own_path, options_.file, kind, options_.events);
    }

    const ReplayOptions &options_;
    std::size_t events_;
    std::optional<std::uint64_t> without_space_;
};

class Figures
{
public:
    explicit Figures(const CountedEvents &events) : events_(events) {}

    void add(const char *space, const std::optional<double> &cost, const Pairs &pairs, bool agrees)
    {
        std::uint64_t count = 0;
        for (std::size_t event = 0; event < pairs.events.size(); ++event)
            count += events_.has(event) ? pairs.events[event].count : 0;
        spaces_ +=
            formatted("%s\n  {\"space\": \"%s\", \"instructions_per_event\": %s, \"pairs\": %llu, \"agrees\": %s}",
                      spaces_.empty() ? "" : ",", space, cost ? formatted("%.17g", *cost).c_str() : "null",
                      static_cast<unsigned long long>(count), agrees ? "true" : "false");
    }

    void write(const std::string &path, std::size_t counted, std::size_t events) const
    {
        std::FILE *const file = std::fopen(path.c_str(), "w");
        const std::string text =
            formatted("{\"counted_events\": %zu, \"events\": %zu, \"spaces\": [", counted, events) + spaces_ + "]}\n";
        const bool written = file && std::fputs(text.c_str(), file) >= 0;
        if (!file || std::fclose(file) != 0 || !written)
            throw std::runtime_error("--json: " + path + " cannot be written: " + std::strerror(errno));
    }

private:
    const CountedEvents &events_;
    std::string spaces_;
};

bool replay_all(const ReplayOptions &options, const Recording &recording)
{
    const SpaceKind reference_kind = kind_named(options.reference).value();
    describe(options.file, recording);
    if (!options.pairs_alone && !has_valgrind())
        std::printf("No instructions are counted, as valgrind is not installed.\n");
    const Pairs reference = find_pairs(recording, reference_kind);
    const Counter counter(options, recording.events().size());
    std::printf("\n%-26s %12s  pairs\n", "spaces", counter.events() > 0 ? "1000 instr." : "");
    bool all_agree = true;
    Figures figures(options.events);
    for (const SpaceKind kind : kinds_of(options))
    {
        const Pairs pairs = kind == reference_kind ? reference : find_pairs(recording, kind);
        const Verdict verdict = compare(recording, kind, pairs, reference, reference_kind);
        const std::string name = kind != SpaceKind::own
                                     ? name_of(kind)
                                     : "own (" + full_name_of(own_kind(recording.state_of_first_space())) + ")";
        const std::optional<double> cost = counter.per_event(kind);
        std::printf("%-26s %12s  %s\n", name.c_str(),
                    cost                   ? formatted("%.4g", 1e-3 * *cost).c_str()
                    : counter.events() > 0 ? "-"
                                           : "",
                    verdict.text.c_str());
        figures.add(name_of(kind), cost, pairs, verdict.agrees);
        all_agree &= verdict.agrees;
    }
    if (!options.json_file.empty())
        figures.write(options.json_file, counter.events(), recording.events().size());
    std::printf("\n%sPairs are compared with those of %s spaces.\n%s\n",
                counter.events() > 0 ? "Instructions are means per event, with the notices before it. " : "",
                name_of(reference_kind), compared_with_program(recording, reference, reference_kind).c_str());
    return all_agree;
}
} // namespace

int replay(const ReplayOptions &options)
{
    const Recording recording = read(options.file);
    if (recording.records().empty())
        throw std::runtime_error(options.file + ": " + completeness_of(recording));
    dInitODE2(0);
    int status = 0;
    if (!options.counted.empty())
        replay_to_be_counted(recording, kind_named(options.counted).value_or(SpaceKind::none), options.events);
    else
        status = replay_all(options, recording) ? 0 : 1;
    dCloseODE();
    return status;
}

std::string write_report(const std::string &folder, const std::string &file, const std::string &title)
{
    Page page = {title, "", {}};
    std::error_code none;
    if (std::filesystem::exists(file, none))
    {
        const Recording recording = read(file);
        dInitODE2(0);
        page.answer = answer_for(recording);
        dCloseODE();
        page.text = printable(recording.note());
        // The path is relative to the page, so that the folder can be moved.
        const std::string place = std::filesystem::path(file).lexically_proximate(folder);
        page.answer.notes.push_back(
            "Measured from the recording " + printable(place) +
            ". To check its pairs and count instructions, give this file to ode-predictive replay.");
    }
    else
        page.answer.sentence =
            "What the program would gain is not known: nothing was recorded, as no call of dSpaceCollide() was seen.";
    return write_page(folder, page);
}
} // namespace ode_predictive_space::recording
