// Compares the predicted encounters of the probe with its contacts.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_ENCOUNTER_LOG_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_ENCOUNTER_LOG_H

#include "ode_predictive_space/haptics/probe.h"

#include <string>

namespace ode_predictive_space::demo
{
/// A first contact with an object, after a time without.
struct LoggedContact
{
    std::uintptr_t object = 0; ///< as in Touch
    double time = 0;           ///< s; of the first tick in which it was touched
    bool predicted = false;    ///< the space had listed it in a tick before
    double warning = 0;        ///< s; for how long it had been listed then, without a gap
    double forecast = 0;       ///< s; when it could be near, as predicted last before it was near
};

/// Of all contacts so far.
struct EncounterSummary
{
    std::size_t contacts = 0;  ///< first touches of an object
    std::size_t predicted = 0; ///< of these, listed before they were touched
    std::size_t missed = 0;    ///< touched while the space did not hold it for near: never, unless the space is broken
    std::size_t late =
        0; ///< predicted, but for later: the hand left its predicted path, and the space saw that in time
    double mean_warning = 0; ///< s; of those that were predicted
    double mean_early = 0;   ///< s; contact minus forecast; of those that were predicted and not late
    double max_early = 0;    ///< s

    /// In sentences.
    std::string text() const;
};

/// Compares the times of proximity that a predictive space predicts for the probe with the times of its contacts. The prediction is of
/// bounding boxes, hence early; with dPredictiveProximityShape it is of the shapes. It must never be late.
///
/// Only objects in the probe's own space are listed by it: those in nested spaces are never predicted. Allocates: not for a servo of
/// its own thread.
class EncounterLog
{
public:
    /// Call in each tick, between the collision and the next one. Asks the probe for its encounters, which costs time.
    void add(double time, haptics::HapticProbe &probe);

    /// The same with lists that the program has made.
    ///
    /// @param time s; later than in the call before.
    void add(double time, const std::vector<haptics::Encounter> &encounters,
             const std::vector<haptics::Touch> &touches);

    /// All so far, in the order in which they were touched.
    const std::vector<LoggedContact> &contacts() const { return contacts_; }
    /// Of contacts().
    EncounterSummary summary() const;

private:
    /// An object that is listed.
    struct Listed
    {
        std::uintptr_t object;
        double since;    ///< s
        double forecast; ///< s; when it can be near
        bool near;
    };

    static const Listed *find(const std::vector<Listed> &list, std::uintptr_t object);
    void log_contact(double time, std::uintptr_t object);
    std::vector<Listed> list(double time, const std::vector<haptics::Encounter> &encounters) const;

    std::vector<Listed> listed_;
    std::vector<std::uintptr_t> touched_; ///< in the tick before
    std::vector<LoggedContact> contacts_;
    std::size_t missed_ = 0;
};
} // namespace ode_predictive_space::demo

#endif
