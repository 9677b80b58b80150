#include "demos/haptic/encounter_log.h"

#include "ode_predictive_space/haptics/contact/short_list.h"

#include <sstream>

namespace ode_predictive_space::demo
{
using namespace haptics;

void EncounterLog::add(double time, HapticProbe &probe)
{
    add(time, probe.encounters(), probe.touches());
}

void EncounterLog::add(double time, const std::vector<Encounter> &encounters, const std::vector<Touch> &touches)
{
    std::vector<Listed> now = list(time, encounters);
    std::vector<std::uintptr_t> touched;
    for (const Touch &touch : touches)
    {
        if (touch.depth < 0)
            continue; // near, in a decoupled loop's margin
        touched.push_back(touch.object);
        if (std::find(touched_.begin(), touched_.end(), touch.object) != touched_.end())
            continue;
        log_contact(time, touch.object);
        const Listed *listed = find(now, touch.object);
        missed_ += listed == nullptr || !listed->near ? 1 : 0;
    }
    touched_ = std::move(touched);
    listed_ = std::move(now);
}

const EncounterLog::Listed *EncounterLog::find(const std::vector<Listed> &list, std::uintptr_t object)
{
    return find_in(list, [&](const Listed &listed) { return listed.object == object; });
}

void EncounterLog::log_contact(double time, std::uintptr_t object)
{
    LoggedContact contact{object, time};
    if (const Listed *listed = find(listed_, object))
    {
        contact.predicted = true;
        contact.warning = time - listed->since;
        contact.forecast = listed->forecast;
    }
    contacts_.push_back(contact);
}

/// A body of several geoms can be listed several times: the soonest comes first, and counts.
std::vector<EncounterLog::Listed> EncounterLog::list(double time, const std::vector<Encounter> &encounters) const
{
    std::vector<Listed> now;
    for (const Encounter &encounter : encounters)
    {
        const std::uintptr_t object = object_of(encounter.geom);
        if (find(now, object) != nullptr)
            continue;
        const Listed *known = find(listed_, object);
        Listed listed = known != nullptr ? *known : Listed{object, time, time, false};
        listed.near = encounter.seconds <= 0;
        // What is near was predicted for this moment, unless it was for an earlier one.
        if (!listed.near || listed.since == time)
            listed.forecast = time + encounter.seconds;
        now.push_back(listed);
    }
    return now;
}

EncounterSummary EncounterLog::summary() const
{
    EncounterSummary summary;
    summary.contacts = contacts_.size();
    summary.missed = missed_;
    for (const LoggedContact &contact : contacts_)
    {
        if (!contact.predicted)
            continue;
        ++summary.predicted;
        summary.mean_warning += contact.warning;
        const double early = contact.time - contact.forecast;
        if (early < -1e-9)
            ++summary.late;
        else
        {
            summary.mean_early += early;
            summary.max_early = std::max(summary.max_early, early);
        }
    }
    const auto divide = [](double &sum, std::size_t count) { sum = count > 0 ? sum / static_cast<double>(count) : 0; };
    divide(summary.mean_warning, summary.predicted);
    divide(summary.mean_early, summary.predicted - summary.late);
    return summary;
}

std::string EncounterSummary::text() const
{
    std::ostringstream out;
    out.precision(3);
    if (contacts == 0)
        return "No contact began.";
    out << "Of " << contacts << " first contacts, " << predicted << " were predicted";
    if (predicted > 0)
        out << ", " << 1000 * mean_warning << " ms ahead on average";
    if (predicted > late)
    {
        out << ". They came " << 1000 * mean_early << " ms (at most " << 1000 * max_early
            << " ms) after the predicted time of proximity";
    }
    if (late > 0)
        out << "; " << late << " came before the predicted time, as the hand had left its predicted path";
    out << "; " << missed << " were missed.";
    return out.str();
}
} // namespace ode_predictive_space::demo
