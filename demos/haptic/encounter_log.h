#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_ENCOUNTER_LOG_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_ENCOUNTER_LOG_H

#include "ode_predictive_space/haptics/probe.h"

#include <map>
#include <set>

namespace ode_predictive_space::demo
{
struct LoggedContact
{
    double time = 0;        ///< s; of the first tick in which the object was touched
    bool predicted = false; ///< the space listed it in an earlier tick
    double warning = 0;     ///< s; time for which it had been listed without a gap
    double forecast = 0;    ///< s; last predicted time of proximity before it was near
};

struct EncounterSummary
{
    std::size_t contacts = 0;  ///< first touches of an object
    std::size_t predicted = 0; ///< those that were listed before they were touched
    std::size_t missed = 0;    ///< touched but not listed as near: a bug in the space
    std::size_t late = 0;      ///< predicted for later: the hand left its path, and the space noticed in time
    double mean_warning = 0;   ///< s; of the predicted contacts
    double mean_early = 0;     ///< s; contact minus forecast, of the predicted contacts that were not late
};

/// Compares the times of proximity that a predictive space predicts for the probe with the times of its contacts. The space
/// predicts for bounding boxes, hence early; with dPredictiveProximityShape it predicts for shapes. It must never be late.
/// Objects in nested spaces are not listed. Not for a separate servo thread, because add() allocates.
class EncounterLog
{
public:
    /// Call once per tick, between the collision and the next one. @param time s; later than in the call before.
    void add(double time, const std::vector<haptics::Encounter> &encounters,
             const std::vector<haptics::Touch> &touches);

    /// In the order in which they began.
    const std::vector<LoggedContact> &contacts() const { return contacts_; }
    EncounterSummary summary() const;

private:
    using Object = std::uintptr_t; ///< as haptics::object_of() gives it

    struct Listed
    {
        double since;    ///< s
        double forecast; ///< s; when it can be near
        bool near;
    };

    std::map<Object, Listed> listed_; ///< in the tick before
    std::set<Object> touched_;        ///< in the tick before
    std::vector<LoggedContact> contacts_;
    std::size_t missed_ = 0;
};
} // namespace ode_predictive_space::demo

#endif
