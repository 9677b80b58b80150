#include "ode_predictive_space/recording/answer.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <ode/collision.h>

#include "ode_predictive_space/recording/advice.h"
#include "ode_predictive_space/recording/check.h"
#include "ode_predictive_space/recording/curves.h"
#include "ode_predictive_space/recording/formatted.h"
#include "ode_predictive_space/recording/own_space.h"
#include "ode_predictive_space/recording/replay.h"

namespace ode_predictive_space::recording
{

namespace
{
double per_event(double value, const Cost &cost)
{
    return cost.events > 0 ? value / static_cast<double>(cost.events) : 0;
}

// One kind of spaces: what each replay took, and of each event the least time.
struct Replays
{
    SpaceKind kind; ///< that stands on the page; the program's own spaces are replayed as SpaceKind::own
    SpaceKind replayed_as;
    Cost least;
    std::vector<double> costs = {}; // of each replay: processor time, in microseconds per event
};

struct Costs
{
    std::vector<Replays> spaces; // the program's own first
    Callbacks callbacks;
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

// The quicker of two replays: a virtual machine may stand still meanwhile, which counts as processor time.
Cost quicker_of_two(const Recording &recording, SpaceKind kind, std::size_t events, double most_seconds)
{
    Cost one = measure(recording, kind, events, most_seconds);
    if (!one.failure.empty())
        return one;
    Cost other = measure(recording, kind, events, most_seconds);
    return other.failure.empty() && other.processor_time < one.processor_time ? other : one;
}

// One replay of each kind after another, so that a change of the machine's speed is in all of them.
void replay_in_turns(const Recording &recording, std::size_t events, double most_seconds, std::vector<Replays> &spaces)
{
    constexpr int times = 5;
    Cost none = measure(recording, SpaceKind::none, events, most_seconds);
    for (int i = 0; i < times; ++i)
    {
        const Cost none_now = quicker_of_two(recording, SpaceKind::none, events, most_seconds);
        take_least(none_now, none);
        for (Replays &replays : spaces)
        {
            if (i > 0 && !replays.least.failure.empty())
                continue;
            const Cost cost = quicker_of_two(recording, replays.replayed_as, events, most_seconds);
            if (i == 0)
                replays.least = cost;
            else
                take_least(cost, replays.least);
            if (cost.failure.empty())
                replays.costs.push_back(1e6 * per_event(without(none_now, cost).processor_time, cost));
        }
    }
    for (Replays &replays : spaces)
        replays.least = without(none, replays.least);
}

// The machine may have been slow in all of a replay: the costliest of each kind is made once more.
void replay_costliest_again(const Recording &recording, std::size_t events, double most_seconds,
                            std::vector<Replays> &spaces)
{
    const Cost none = quicker_of_two(recording, SpaceKind::none, events, most_seconds);
    for (Replays &replays : spaces)
    {
        if (replays.costs.empty())
            continue;
        const Cost again = quicker_of_two(recording, replays.replayed_as, events, most_seconds);
        double &costliest = *std::max_element(replays.costs.begin(), replays.costs.end());
        if (again.failure.empty())
            costliest = std::min(costliest, 1e6 * per_event(without(none, again).processor_time, again));
    }
}

// The tick of the program, as the mean of the events that were replayed.
std::optional<RecordedTick> recorded_tick(const Recording &recording, const Costs &costs)
{
    RecordedTick tick;
    tick.kind = kind_of_recorded_space(recording);
    const Replays *replays = of_kind(costs, tick.kind);
    if (!replays)
        return std::nullopt;
    std::size_t known = 0;
    for (std::size_t i = 0; i < std::min(replays->least.events, recording.events().size()); ++i)
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
    findings.events = costs.spaces.front().least.events;
    findings.own = costs.spaces.front().kind;
    const double spared = 1e6 * per_event(costs.callbacks.seconds_spared, costs.spaces.front().least);
    for (const Replays &replays : costs.spaces)
        findings.spaces.push_back({replays.kind, replays.costs, replays.kind == SpaceKind::shape ? spared : 0});
    findings.tick = recorded_tick(recording, costs);
    return findings;
}

std::string name_on_page(const Replays &replays)
{
    const bool is_predictive =
        replays.kind == SpaceKind::box || replays.kind == SpaceKind::sphere || replays.kind == SpaceKind::shape;
    const std::string name =
        is_predictive ? std::string("predictive, by ") + name_of(replays.kind) : name_of(replays.kind);
    return replays.replayed_as == SpaceKind::own ? "the program's own: " + name : name;
}

std::vector<std::string> row_of(const Findings &findings, const Replays &replays)
{
    const Cost &cost = replays.least;
    if (!cost.failure.empty())
        return {name_on_page(replays), "ends: " + cost.failure};
    const auto gain = gain_of(findings, replays.kind);
    return {name_on_page(replays), readable(1e6 * per_event(cost.collides, cost)),
            readable(1e6 * per_event(cost.notices, cost)),
            readable(per_event(static_cast<double>(cost.callbacks), cost)),
            replays.replayed_as == SpaceKind::own ? "\xe2\x80\x93"
            : gain                                ? formatted("%+.1f %%", -100 * gain->share)
                                                  : std::string("not known")};
}

Curve times_of(const std::string &name, const Cost &cost)
{
    BoundedSeries series{};
    for (const float seconds : cost.seconds)
        series.add(static_cast<double>(seconds));
    return means(name, series, 1, 1e6);
}

// Where the program had times, of the events that were replayed.
Curve times_in_program(const Recording &recording, std::size_t events)
{
    BoundedSeries series{};
    for (std::size_t i = 0; i < std::min(events, recording.events().size()); ++i)
        if (recording.events()[i].has_times)
            series.add(static_cast<double>(recording.events()[i].times.space));
    return means("in the program, as it was recorded", series, 1, 1e6);
}

Curve callbacks_of(const std::string &name, const Cost &cost)
{
    BoundedSeries series{};
    for (const std::uint32_t callbacks : cost.callbacks_of)
        series.add(callbacks);
    return means(name, series, 1, 1);
}

std::vector<std::string> notes_of(const Recording &recording, const Costs &costs)
{
    const Callbacks &callbacks = costs.callbacks;
    std::vector<std::string> notes;
    notes.push_back(completeness_of(recording));
    notes.push_back(formatted(
        "Replayed: %zu of %zu recorded collides and questions, %u geoms, %u bodies. The callbacks of "
        "the program, its contacts and its step are not part of these times.",
        costs.spaces.front().least.events, recording.events().size(), recording.geom_count(), recording.body_count()));
    if (!callbacks.failure.empty())
        notes.push_back("What the callbacks find is not known: " + callbacks.failure);
    else if (callbacks.all > 0)
        notes.push_back(formatted("Of the callbacks by boxes, %.3g %% find nothing: dCollide gives no contact.%s",
                                  100 * static_cast<double>(callbacks.nothing) / static_cast<double>(callbacks.all),
                                  callbacks.unknown > 0 ? " Pairs with spaces, or with geoms of which only the box is "
                                                          "recorded, are not among them."
                                                        : ""));
    if (const std::string unknown = unknown_notices(recording); !unknown.empty())
        notes.push_back(unknown);
    return notes;
}
} // namespace

Answer answer_for(const Recording &recording)
{
    constexpr double seconds = 2; // of each replay
    Costs costs;
    costs.spaces = spaces_to_replay(kind_of_own_space(recording));
    const Cost first = measure(recording, SpaceKind::own, recording.events().size(), seconds);
    const bool own_ends = !first.failure.empty();
    // One that ends itself is no measure for the others.
    const std::size_t most = own_ends ? recording.events().size() : first.events;
    replay_in_turns(recording, most, own_ends ? seconds : 1e9, costs.spaces);
    replay_costliest_again(recording, most, own_ends ? seconds : 1e9, costs.spaces);
    costs.callbacks = judge_callbacks(recording, most, own_ends ? seconds : 1e9);
    const Findings findings = findings_of(recording, costs);
    Answer answer;
    if (recording.events().empty())
        answer.sentence = "Not known: no collide was recorded.";
    else if (own_ends)
        answer.sentence =
            "Use it: the program's own spaces (" + name_of_own_space(recording) + ") end the program: " + first.failure;
    else
        answer.sentence = sentence_for(findings);
    answer.table = {{"spaces", "\xc2\xb5s per collide", "\xc2\xb5s for notices before it", "callbacks per collide",
                     "a tick, beside the program's own"}};
    answer.plots = {{"Time per collide", "number of the collide or question", "microseconds", {}, true},
                    {"Callbacks per collide", "number of the collide or question", "callbacks", {}, false}};
    for (const Replays &replays : costs.spaces)
    {
        answer.table.push_back(row_of(findings, replays));
        if (&replays != &costs.spaces.front() && replays.kind != SpaceKind::box && replays.kind != SpaceKind::shape)
            continue;
        answer.plots[0].curves.push_back(times_of(name_on_page(replays) + ", replayed", replays.least));
        answer.plots[1].curves.push_back(callbacks_of(name_on_page(replays) + ", replayed", replays.least));
    }
    answer.plots[0].curves.push_back(times_in_program(recording, costs.spaces.front().least.events));
    answer.notes = notes_of(recording, costs);
    if (findings.tick)
        answer.notes.push_back(
            formatted("In the program a collide took %s \xc2\xb5s, replayed %s: a replay does nothing else, so that "
                      "its data stay in "
                      "the processor's caches. All spaces are taken to be slower in the program by the same time.",
                      readable(findings.tick->collide).c_str(),
                      readable(1e6 * per_event(of_kind(costs, findings.tick->kind)->least.collides,
                                               of_kind(costs, findings.tick->kind)->least))
                          .c_str()));
    return answer;
}
} // namespace ode_predictive_space::recording
