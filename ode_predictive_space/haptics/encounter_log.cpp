#include "ode_predictive_space/haptics/encounter_log.h"

#include "ode_predictive_space/haptics/contact/short_list.h"

#include <sstream>

namespace ode_predictive_space::haptics
{
void EncounterLog::add(double time, HapticProbe &probe)
{
    add(time, probe.encounters(), probe.touches());
}

void EncounterLog::add(double time, const std::vector<Encounter> &encounters, const std::vector<Touch> &touches)
{
    std::vector<std::uintptr_t> touched;
    const std::size_t first = contacts_.size();
    for (const Touch &touch : touches)
    {
        if (touch.depth < 0)
            continue; // near, in a decoupled loop's margin
        touched.push_back(touch.object);
        if (std::find(touched_.begin(), touched_.end(), touch.object) == touched_.end())
            log_contact(time, touch);
    }
    touched_ = std::move(touched);
    list(time, encounters);
    for (std::size_t i = first; i < contacts_.size(); ++i)
    {
        const Listed *listed = find(contacts_[i].object);
        missed_ += listed == nullptr || !listed->near ? 1 : 0;
    }
}

const EncounterLog::Listed *EncounterLog::find(std::uintptr_t object) const
{
    return find_in(listed_, [&](const Listed &listed) { return listed.object == object; });
}

void EncounterLog::log_contact(double time, const Touch &touch)
{
    LoggedContact contact;
    contact.object = touch.object;
    contact.time = time;
    if (const Listed *listed = find(touch.object))
    {
        contact.foretold = true;
        contact.warning = time - listed->since;
        contact.forecast = listed->forecast;
    }
    contacts_.push_back(contact);
}

/// A body of several geoms can be listed several times: the soonest comes first, and counts.
void EncounterLog::list(double time, const std::vector<Encounter> &encounters)
{
    std::vector<Listed> now;
    for (const Encounter &encounter : encounters)
    {
        const std::uintptr_t object = object_of(encounter.geom);
        if (find_in(now, [&](const Listed &listed) { return listed.object == object; }) != nullptr)
            continue;
        const Listed *known = find(object);
        Listed listed = known != nullptr ? *known : Listed{object, time, time, false};
        listed.near = encounter.seconds <= 0;
        // What is near was foretold for this moment, unless it was for an earlier one.
        if (!listed.near || listed.since == time)
            listed.forecast = time + encounter.seconds;
        now.push_back(listed);
    }
    listed_ = std::move(now);
}

EncounterSummary EncounterLog::summary() const
{
    EncounterSummary summary;
    summary.contacts = contacts_.size();
    summary.missed = missed_;
    double warning = 0;
    double early = 0;
    for (const LoggedContact &contact : contacts_)
    {
        if (!contact.foretold)
            continue;
        ++summary.foretold;
        warning += contact.warning;
        const double earliness = contact.time - contact.forecast;
        if (earliness < -1e-9)
        {
            ++summary.late;
            continue;
        }
        early += earliness;
        summary.max_early = std::max(summary.max_early, earliness);
    }
    if (summary.foretold > 0)
        summary.mean_warning = warning / static_cast<double>(summary.foretold);
    if (summary.foretold > summary.late)
        summary.mean_early = early / static_cast<double>(summary.foretold - summary.late);
    return summary;
}

std::string EncounterSummary::text() const
{
    std::ostringstream out;
    out.precision(3);
    if (contacts == 0)
        return "No contact began.";
    out << "Of " << contacts << " first contacts, " << foretold << " were predicted";
    if (foretold > 0)
        out << ", " << 1000 * mean_warning << " ms ahead on average";
    if (foretold > late)
    {
        out << ". They came " << 1000 * mean_early << " ms (at most " << 1000 * max_early
            << " ms) after the predicted time of proximity";
    }
    if (late > 0)
        out << "; " << late << " came before the predicted time, as the hand had left its predicted path";
    out << "; " << missed << " were missed.";
    return out.str();
}
} // namespace ode_predictive_space::haptics
