#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_PROBE_CONTACTS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_PROBE_CONTACTS_H

#include "demos/haptic/encounter_log.h"

#include <algorithm>

namespace ode_predictive_space::demo
{
/// The geoms near the probe and the touched ones of the last step, and a log of all steps.
class ProbeContacts
{
public:
    void clear() { near_.clear(); }

    /// To be called for each pair that the space reports. @return whether the probe is one of the two.
    bool take(haptics::HapticProbe &probe, dGeomID first, dGeomID second)
    {
        const bool is_of_probe = probe.touch(first, second);
        if (is_of_probe)
            near_.push_back(first == probe.geom() ? second : first);
        return is_of_probe;
    }

    /// To be called when the forces of the step have been rendered.
    void follow(double time, haptics::HapticProbe &probe)
    {
        const auto touched = [&touches = probe.touches()](dGeomID geom) {
            return std::any_of(touches.begin(), touches.end(), [geom](const haptics::Touch &touch) {
                return touch.depth > 0 && touch.object == haptics::object_of(geom);
            });
        };
        touched_.clear();
        std::copy_if(near_.begin(), near_.end(), std::back_inserter(touched_), touched);
        encounters_ = probe.encounters();
        log_.add(time, encounters_, probe.touches());
    }

    const std::vector<dGeomID> &near() const { return near_; }
    const std::vector<dGeomID> &touched() const { return touched_; }
    const std::vector<haptics::Encounter> &encounters() const { return encounters_; }
    const EncounterLog &log() const { return log_; }

private:
    std::vector<dGeomID> near_;
    std::vector<dGeomID> touched_;
    std::vector<haptics::Encounter> encounters_;
    EncounterLog log_;
};
} // namespace ode_predictive_space::demo

#endif
