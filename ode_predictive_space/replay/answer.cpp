#include "ode_predictive_space/replay/answer.h"

#include <algorithm>

#include <ode/collision.h>

#include "ode_predictive_space/replay/advice.h"
#include "ode_predictive_space/replay/check.h"
#include "ode_predictive_space/replay/formatted.h"
#include "ode_predictive_space/replay/own_space.h"
#include "ode_predictive_space/replay/replay.h"
#include "ode_predictive_space/report/curves.h"

namespace ode_predictive_space::replay
{
using history::Recording;

namespace
{
double per_event(double value, const Cost &cost)
{
    return cost.events > 0 ? value / static_cast<double>(cost.events) : 0;
}

double microseconds(const Cost &cost)
{
    return 1e6 * per_event(cost.collides + cost.notices, cost);
}

struct Costs
{
    Cost own, box, shape;
    Callbacks callbacks;
};

Findings findings_of(const Recording &recording, const Costs &costs)
{
    Findings findings;
    findings.events = costs.own.events;
    findings.own_name = name_of_own_space(recording);
    findings.own_is_simple = name_of_own_space(recording) == "simple";
    findings.own = microseconds(costs.own);
    findings.box = microseconds(costs.box);
    findings.shape = microseconds(costs.shape);
    findings.callbacks = per_event(static_cast<double>(costs.box.callbacks), costs.box);
    findings.spared = findings.callbacks - per_event(static_cast<double>(costs.shape.callbacks), costs.shape);
    findings.spared_time = 1e6 * per_event(costs.callbacks.seconds_spared, costs.box);
    return findings;
}

std::vector<std::string> row_of(const std::string &name, const Cost &cost)
{
    if (!cost.failure.empty())
        return {name, "ends: " + cost.failure};
    return {name, readable(1e6 * per_event(cost.collides, cost)), readable(1e6 * per_event(cost.notices, cost)),
            readable(per_event(static_cast<double>(cost.callbacks), cost))};
}

report::Curve times_of(const std::string &name, const Cost &cost)
{
    report::BoundedSeries series{};
    for (const float seconds : cost.seconds)
        series.add(static_cast<double>(seconds));
    return report::means(name, series, 1, 1e6);
}

report::Curve callbacks_of(const std::string &name, const Cost &cost)
{
    report::BoundedSeries series{};
    for (const std::uint32_t callbacks : cost.callbacks_of)
        series.add(callbacks);
    return report::means(name, series, 1, 1);
}

std::vector<std::string> notes_of(const Recording &recording, const Costs &costs)
{
    const Callbacks &callbacks = costs.callbacks;
    std::vector<std::string> notes;
    notes.push_back(completeness_of(recording));
    notes.push_back(
        formatted("Replayed: %zu of %zu recorded collides and questions, %u geoms, %u bodies. The callbacks of "
                  "the program, its contacts and its step are not part of these times.",
                  costs.own.events, recording.events().size(), recording.geom_count(), recording.body_count()));
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

report::Answer answer_for(const Recording &recording, double seconds)
{
    Costs costs;
    costs.own = measure_repeatedly(recording, SpaceKind::own, recording.events().size(), seconds);
    const bool own_ends = !costs.own.failure.empty();
    // One that ends itself is no measure for the others.
    const std::size_t most = own_ends ? recording.events().size() : costs.own.events;
    const double no_limit = own_ends ? seconds : 1e9;
    const Cost none = measure_repeatedly(recording, SpaceKind::none, most, no_limit);
    costs.own = without(none, costs.own);
    costs.box = without(none, measure_repeatedly(recording, SpaceKind::box, most, no_limit));
    costs.shape = without(none, measure_repeatedly(recording, SpaceKind::shape, most, no_limit));
    costs.callbacks = judge_callbacks(recording, most, no_limit);
    report::Answer answer;
    if (recording.events().empty())
        answer.sentence = "Not known: no collide was recorded.";
    else if (own_ends)
        answer.sentence = "Use it: the program's own spaces (" + name_of_own_space(recording) +
                          ") end the program: " + costs.own.failure;
    else
        answer.sentence = sentence_for(findings_of(recording, costs));
    const std::string own = "the program's own: " + name_of_own_space(recording);
    answer.table = {{"spaces", "\xc2\xb5s per collide", "\xc2\xb5s for moves before it", "callbacks per collide"},
                    row_of(own, costs.own),
                    row_of("predictive, by box", costs.box),
                    row_of("predictive, by shape", costs.shape)};
    answer.notes = notes_of(recording, costs);
    answer.plots = {{"Time per collide, replayed",
                     "number of the collide or question",
                     "microseconds",
                     {times_of(own, costs.own), times_of("predictive, by box", costs.box),
                      times_of("predictive, by shape", costs.shape)},
                     true},
                    {"Callbacks per collide, replayed",
                     "number of the collide or question",
                     "callbacks",
                     {callbacks_of(own, costs.own), callbacks_of("predictive, by box", costs.box),
                      callbacks_of("predictive, by shape", costs.shape)},
                     false}};
    return answer;
}
} // namespace ode_predictive_space::replay
