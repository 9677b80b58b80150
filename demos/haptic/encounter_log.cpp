#include "demos/haptic/encounter_log.h"

namespace ode_predictive_space::demo
{
void EncounterLog::add(double time, const std::vector<haptics::Encounter> &encounters,
                       const std::vector<haptics::Touch> &touches)
{
    std::map<Object, Listed> now;
    for (const haptics::Encounter &encounter : encounters)
    {
        const auto [place, is_new] = now.emplace(haptics::object_of(encounter.geom), Listed{time, time, false});
        if (!is_new)
            continue; // of several geoms of a body, the soonest comes first, and counts
        Listed &listed = place->second;
        if (const auto before = listed_.find(place->first); before != listed_.end())
            listed = before->second;
        listed.near = encounter.seconds <= 0;
        // A near object keeps the forecast that it had before it came near.
        if (!listed.near || listed.since == time)
            listed.forecast = time + encounter.seconds;
    }
    std::set<Object> touched;
    for (const haptics::Touch &touch : touches)
    {
        // Below zero: near, in a decoupled loop's margin.
        if (touch.depth < 0 || !touched.insert(touch.object).second || touched_.count(touch.object) > 0)
            continue;
        const auto before = listed_.find(touch.object), listed = now.find(touch.object);
        contacts_.push_back(before == listed_.end()
                                ? LoggedContact{time}
                                : LoggedContact{time, true, time - before->second.since, before->second.forecast});
        missed_ += listed == now.end() || !listed->second.near ? 1 : 0;
    }
    touched_ = std::move(touched);
    listed_ = std::move(now);
}

EncounterSummary EncounterLog::summary() const
{
    constexpr double rounding = 1e-9; // s
    EncounterSummary summary;
    summary.contacts = contacts_.size();
    summary.missed = missed_;
    double warnings = 0, early = 0; // s; sums
    for (const LoggedContact &contact : contacts_)
    {
        if (!contact.predicted)
            continue;
        ++summary.predicted;
        warnings += contact.warning;
        if (contact.time < contact.forecast - rounding)
            ++summary.late;
        else
            early += contact.time - contact.forecast;
    }
    if (summary.predicted > 0)
        summary.mean_warning = warnings / static_cast<double>(summary.predicted);
    if (summary.predicted > summary.late)
        summary.mean_early = early / static_cast<double>(summary.predicted - summary.late);
    return summary;
}
} // namespace ode_predictive_space::demo
