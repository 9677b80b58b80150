#include "demos/haptic/encounter_log.h"

#include "ode_predictive_space/haptics/contact/short_list.h"

namespace ode_predictive_space::demo
{
using namespace haptics;

namespace
{
constexpr double rounding = 1e-9; // s

template <typename Listed> const Listed *find(const std::vector<Listed> &list, std::uintptr_t object)
{
    return find_in(list, [&](const Listed &listed) { return listed.object == object; });
}
} // namespace

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
        const Listed *before = find(listed_, touch.object), *listed = find(now, touch.object);
        contacts_.push_back(before ? LoggedContact{time, true, time - before->since, before->forecast}
                                   : LoggedContact{time});
        missed_ += listed == nullptr || !listed->near ? 1 : 0;
    }
    touched_ = std::move(touched);
    listed_ = std::move(now);
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
        // A near object keeps the forecast that it had before it came near.
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
    std::size_t early = 0;
    for (const LoggedContact &contact : contacts_)
    {
        if (!contact.predicted)
            continue;
        ++summary.predicted;
        const auto predicted = static_cast<double>(summary.predicted);
        summary.mean_warning += (contact.warning - summary.mean_warning) / predicted;
        if (contact.time < contact.forecast - rounding)
        {
            ++summary.late;
            continue;
        }
        ++early;
        summary.mean_early += (contact.time - contact.forecast - summary.mean_early) / static_cast<double>(early);
    }
    return summary;
}
} // namespace ode_predictive_space::demo
