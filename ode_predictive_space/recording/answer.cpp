#include "ode_predictive_space/recording/answer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <ode/collision.h>

#include "ode_predictive_space/recording/advice.h"
#include "ode_predictive_space/recording/check.h"
#include "ode_predictive_space/recording/curves.h"
#include "ode_predictive_space/recording/formatted.h"
#include "ode_predictive_space/recording/replay.h"

namespace ode_predictive_space::recording
{
namespace
{
struct Means
{
    double collide = 0, notices = 0, callbacks = 0;
};

Means means_of(const Cost &cost)
{
    Means means;
    for (const MeasuredEvent &event : cost.events)
    {
        means.collide += static_cast<double>(event.collide);
        means.notices += static_cast<double>(event.notices);
        means.callbacks += event.callbacks;
    }
    for (double *sum : {&means.collide, &means.notices, &means.callbacks})
        *sum /= static_cast<double>(std::max<std::size_t>(cost.events.size(), 1));
    return means;
}

struct Replays
{
    SpaceKind kind; // on the page; the program's own spaces are replayed as SpaceKind::own
    SpaceKind replayed_as;
    Cost least;
    std::vector<double> costs = {}; // processor time of each replay, in microseconds per event
};

struct Costs
{
    std::vector<Replays> spaces;        // the program's own first
    double notices_without_a_space = 0; // seconds per event that the changes take without a space
    Callbacks callbacks;
    std::string failure_of_callbacks;
};

const Replays *of_kind(const Costs &costs, SpaceKind kind)
{
    for (const Replays &replays : costs.spaces)
        if (replays.kind == kind)
            return &replays;
    return nullptr;
}

std::vector<Replays> spaces_to_replay(SpaceKind own)
{
    std::vector<Replays> spaces = {{own, SpaceKind::own, {}}};
    for (const SpaceKind kind :
         {SpaceKind::box, SpaceKind::shape, SpaceKind::simple, SpaceKind::hash, SpaceKind::quadtree, SpaceKind::sap})
        if (kind != own)
            spaces.push_back({kind, kind, {}});
    return spaces;
}

// The quicker of two replays: a virtual machine that is stopped meanwhile counts that as processor time.
Cost quicker_of_two(const Recording &recording, SpaceKind kind, std::size_t events, double most_seconds)
{
    Cost one = measure(recording, kind, events, most_seconds);
    if (!one.failure.empty())
        return one;
    Cost other = measure(recording, kind, events, most_seconds);
    return other.failure.empty() && other.processor_time < one.processor_time ? other : one;
}

// Microseconds per event: the difference of a replay in spaces and one without.
double cost_in_spaces(const Cost &without, const Cost &cost)
{
    const double events = static_cast<double>(std::max<std::size_t>(cost.events.size(), 1));
    return 1e6 * (cost.processor_time - without.processor_time) / events;
}

// Replays the kinds in turns, so that a change of the machine's speed affects all of them.
void replay_in_turns(const Recording &recording, std::size_t events, double most_seconds, Costs &costs)
{
    constexpr int times = 5;
    Cost least_without = measure(recording, SpaceKind::none, events, most_seconds);
    for (int i = 0; i < times; ++i)
    {
        const Cost without = quicker_of_two(recording, SpaceKind::none, events, most_seconds);
        take_least(without, least_without);
        for (Replays &replays : costs.spaces)
        {
            if (i > 0 && !replays.least.failure.empty())
                continue;
            const Cost cost = quicker_of_two(recording, replays.replayed_as, events, most_seconds);
            if (i == 0)
                replays.least = cost;
            else
                take_least(cost, replays.least);
            if (cost.failure.empty())
                replays.costs.push_back(cost_in_spaces(without, cost));
        }
    }
    costs.notices_without_a_space = means_of(least_without).notices;
}

// Repeats the costliest replay of each kind: the machine may have been slow during all of it.
void replay_costliest_again(const Recording &recording, std::size_t events, double most_seconds,
                            std::vector<Replays> &spaces)
{
    const Cost without = quicker_of_two(recording, SpaceKind::none, events, most_seconds);
    for (Replays &replays : spaces)
    {
        if (replays.costs.empty())
            continue;
        const Cost again = quicker_of_two(recording, replays.replayed_as, events, most_seconds);
        double &costliest = *std::max_element(replays.costs.begin(), replays.costs.end());
        if (again.failure.empty())
            costliest = std::min(costliest, cost_in_spaces(without, again));
    }
}

std::optional<RecordedTick> recorded_tick(const Recording &recording, const Costs &costs)
{
    RecordedTick tick;
    tick.kind = recorded_kind(recording.state_of_first_space());
    const Replays *replays = of_kind(costs, tick.kind);
    if (!replays)
        return std::nullopt;
    std::size_t known = 0;
    for (std::size_t i = 0; i < std::min(replays->least.events.size(), recording.events().size()); ++i)
    {
        const EventSummary &event = recording.events()[i];
        if (!event.has_times || !(event.times.tick > 0))
            continue;
        ++known;
        tick.whole += 1e6 * static_cast<double>(event.times.tick);
        tick.collide += 1e6 * static_cast<double>(event.times.space);
        tick.callbacks += 1e6 * static_cast<double>(event.times.callbacks);
    }
    if (known == 0)
        return std::nullopt;
    for (double *sum : {&tick.whole, &tick.collide, &tick.callbacks})
        *sum /= static_cast<double>(known);
    return tick;
}

Findings findings_of(const Recording &recording, const Costs &costs)
{
    Findings findings;
    findings.events = costs.spaces.front().least.events.size();
    findings.own = costs.spaces.front().kind;
    const double spared =
        1e6 * costs.callbacks.seconds_spared / static_cast<double>(std::max<std::size_t>(findings.events, 1));
    for (const Replays &replays : costs.spaces)
        findings.spaces.push_back({replays.kind, replays.costs, replays.kind == SpaceKind::shape ? spared : 0});
    findings.tick = recorded_tick(recording, costs);
    return findings;
}

std::string name_on_page(const Replays &replays)
{
    return (replays.replayed_as == SpaceKind::own ? "the program's own: " : "") + full_name_of(replays.kind);
}

std::vector<std::string> row_of(const Findings &findings, const Costs &costs, const Replays &replays)
{
    if (!replays.least.failure.empty())
        return {name_on_page(replays), "ended: " + replays.least.failure};
    const Means means = means_of(replays.least);
    const auto gain = gain_of(findings, replays.kind);
    return {name_on_page(replays), readable(1e6 * means.collide),
            readable(1e6 * std::max(0.0, means.notices - costs.notices_without_a_space)), readable(means.callbacks),
            replays.replayed_as == SpaceKind::own ? "\xe2\x80\x93"
            : gain ? formatted("%+.1f %%", std::round(-1000 * gain->share) / 10 + 0.0) // not -0
                   : std::string("not known")};
}

Curve times_of(const std::string &name, const Cost &cost)
{
    BoundedSeries series{};
    for (const MeasuredEvent &event : cost.events)
        series.add(static_cast<double>(event.collide));
    return means(name, series, 1, 1e6);
}

Curve times_in_program(const Recording &recording, std::size_t events)
{
    BoundedSeries series{};
    for (std::size_t i = 0; i < std::min(events, recording.events().size()); ++i)
        if (recording.events()[i].has_times)
            series.add(static_cast<double>(recording.events()[i].times.space));
    return means("in the program, as it was recorded", series, 1, 1e6);
}

Plot plot_of(const Recording &recording, const Costs &costs)
{
    Plot plot = {"Time per collide", "number of the collide", "microseconds", {}, true};
    for (const Replays &replays : costs.spaces)
        if (replays.replayed_as == SpaceKind::own || replays.kind == SpaceKind::box || replays.kind == SpaceKind::shape)
            plot.curves.push_back(times_of(name_on_page(replays) + ", replayed", replays.least));
    plot.curves.push_back(times_in_program(recording, costs.spaces.front().least.events.size()));
    return plot;
}

std::string sentence_of(const Recording &recording, const Findings &findings, const std::string &own_failure)
{
    if (recording.events().empty())
        return "Not known: no collide was recorded.";
    if (!own_failure.empty())
        return "Use predictive spaces: the program's own ones (" + full_name_of(findings.own) +
               ") end the program: " + own_failure;
    return sentence_for(findings);
}

std::vector<std::string> notes_of(const Recording &recording, const Findings &findings, const Costs &costs)
{
    const Callbacks &callbacks = costs.callbacks;
    std::vector<std::string> notes;
    notes.push_back(completeness_of(recording));
    notes.push_back(
        formatted("Replayed: %zu of %zu recorded collides, %u geoms, %u bodies. The program's callbacks, its contacts "
                  "and its step are not part of these times.",
                  findings.events, recording.events().size(), recording.geom_count(), recording.body_count()));
    if (!costs.failure_of_callbacks.empty())
        notes.push_back("It is not known how many callbacks find contacts: " + costs.failure_of_callbacks);
    else if (callbacks.all > 0)
        notes.push_back(formatted("Of the callbacks for pairs by box, %.3g %% find no contact by dCollide().%s",
                                  100 * static_cast<double>(callbacks.nothing) / static_cast<double>(callbacks.all),
                                  callbacks.unknown > 0 ? " Pairs with spaces, or with geoms of which only the box is "
                                                          "recorded, are not counted."
                                                        : ""));
    if (const std::string unknown = unknown_notices(recording); !unknown.empty())
        notes.push_back(unknown);
    if (findings.tick)
        notes.push_back(formatted(
            "In the program a collide took %s \xc2\xb5s, in the replay %s \xc2\xb5s: a replay does nothing else, "
            "so its data stay in the processor's caches. Spaces of every kind are assumed to be slower in the "
            "program by this difference.",
            readable(findings.tick->collide).c_str(),
            readable(1e6 * means_of(of_kind(costs, findings.tick->kind)->least).collide).c_str()));
    return notes;
}
} // namespace

Answer answer_for(const Recording &recording)
{
    const Cost first = measure(recording, SpaceKind::own, recording.events().size(), 2);
    const bool own_ends = !first.failure.empty();
    // Spaces that end the program by an assertion give no number of events.
    const std::size_t events = own_ends ? recording.events().size() : first.events.size();
    const double seconds = own_ends ? 2 : 1e9; // of each replay
    Costs costs;
    costs.spaces = spaces_to_replay(own_kind(recording.state_of_first_space()));
    replay_in_turns(recording, events, seconds, costs);
    replay_costliest_again(recording, events, seconds, costs.spaces);
    costs.failure_of_callbacks = judge_callbacks(recording, events, seconds, costs.callbacks);

    const Findings findings = findings_of(recording, costs);
    Answer answer;
    answer.sentence = sentence_of(recording, findings, first.failure);
    answer.table = {{"spaces", "\xc2\xb5s per collide", "\xc2\xb5s for notices before it", "callbacks per collide",
                     "a tick, compared with the program's own"}};
    for (const Replays &replays : costs.spaces)
        answer.table.push_back(row_of(findings, costs, replays));
    answer.plots = {plot_of(recording, costs)};
    answer.notes = notes_of(recording, findings, costs);
    return answer;
}
} // namespace ode_predictive_space::recording
