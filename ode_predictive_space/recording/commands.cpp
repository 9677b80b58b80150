#include "ode_predictive_space/recording/commands.h"

#include <cstdio>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include <ode/ode.h>

#include "ode_predictive_space/recording/answer.h"
#include "ode_predictive_space/recording/check.h"
#include "ode_predictive_space/recording/formatted.h"
#include "ode_predictive_space/recording/instructions.h"
#include "ode_predictive_space/recording/own_space.h"
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

std::string own_path()
{
    std::error_code none;
    return std::filesystem::read_symlink("/proc/self/exe", none).string();
}

// The instructions or the time that spaces of one kind take per event.
class CostsOfSpaces
{
public:
    CostsOfSpaces(const std::string &file, const Recording &recording, bool instructions)
        : file_(file), recording_(recording), instructions_(instructions)
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
    const Recording &recording_;
    bool instructions_;
    std::optional<std::uint64_t> counted_without_;
    Cost measured_without_;
};

bool replay_all(const ReplayOptions &options, const Recording &recording)
{
    const bool instructions = !options.times && has_valgrind();
    describe(options.file, recording);
    const Pairs simple = find_pairs(recording, SpaceKind::simple);
    const CostsOfSpaces costs(options.file, recording, instructions);
    std::printf("\n%-26s %12s  %s\n", "spaces", instructions ? "1000 instr." : "microseconds", "pairs");
    bool all_agree = true;
    for (const SpaceKind kind : kinds_of(options))
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

int replay(const ReplayOptions &options)
{
    const Recording recording = read(options.file);
    if (recording.records().empty())
        throw std::runtime_error(options.file + ": " + completeness_of(recording));
    dInitODE2(0);
    int status = 0;
    if (!options.counted.empty())
        replay_to_be_counted(recording, kind_named(options.counted).value_or(SpaceKind::none));
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
        page.answer.notes.push_back("Measured from the recording " + printable(file) +
                                    "; ode-predictive replay, given this file, checks and counts more.");
    }
    else
        page.answer.sentence = "What the program would gain is not known: it collided no space that could be recorded.";
    return recording::write_page(folder, page);
}
} // namespace ode_predictive_space::recording
