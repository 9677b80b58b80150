// A few objects that are watched while the others are only scanned.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SCOUTS_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SCOUTS_H

#include <algorithm>
#include <vector>

#include "ode_predictive_space/broadphase/id_set.h"
#include "ode_predictive_space/broadphase/predictor.h"
#include "ode_predictive_space/broadphase/scan_policy.h"

namespace ode_predictive_space
{
/// Tells whether objects move as could be predicted: whether each is where its last two positions lead. Learns meanwhile
/// how far a body's velocity carries it in a tick.
class Scouts
{
public:
    /// Makes room, which the first tick should not spend its time on.
    Scouts() { scouts_.reserve(most); }

    /// Chooses among the members, evenly by number, the same ones for the same members.
    void choose(const IdSet &members)
    {
        // An eighth of a small scene will do. Odd strides meet all sorts where sorts alternate.
        const std::size_t count = members.size(), wanted = std::clamp(count / 8, least, most);
        const std::size_t stride = std::max<std::size_t>(1, count / wanted) | 1;
        std::size_t rank = 0, next = 0;
        scouts_.clear();
        looks_ = ticks_to_rest_ = 0;
        members.for_each([&](ProxyId id) {
            if (rank++ != next || scouts_.size() == most)
                return;
            scouts_.push_back({id, Vector3::Zero(), Vector3::Zero(), Vector3::Zero()});
            next += stride;
        });
    }

    /// Looks where they are now, a tick after the last call. When they were disturbed `patience` times in a row it does not
    /// look in the next `rest` ticks: among few objects a look costs as much as sweeping them.
    ///
    /// @return true when so many moved as predicted that predicting all would pay.
    template <typename Scene> bool calm(Scene &scene, const IdSet &members, StepEstimate &step)
    {
        if (ticks_to_rest_ > 0)
        {
            --ticks_to_rest_;
            return false;
        }
        std::size_t strayed = 0;
        for (Scout &scout : scouts_)
            if (members.contains(scout.id))
                strayed += !keeps_on(scene, scout, step);
        const bool calm = strayed * ScanPolicy::bad_part <= scouts_.size();
        disturbances_ = calm || looks_ < looks_for_line ? 0 : disturbances_ + 1;
        looks_ = std::min(looks_ + 1, looks_for_line);
        if (disturbances_ == patience)
        {
            looks_ = 0;
            ticks_to_rest_ = rest;
        }
        return calm;
    }

    static constexpr int patience = 4, rest = 16;

    std::size_t bytes() const { return scouts_.capacity() * sizeof(Scout); }

private:
    static constexpr std::size_t least = 8, most = 32;

    static constexpr int looks_for_line = 2; // after so many it is known where those that keep on will be

    struct Scout
    {
        ProxyId id;
        Vector3 before;
        Vector3 last;
        Vector3 velocity; // when it was last seen
    };

    template <typename Scene> bool keeps_on(Scene &scene, Scout &scout, StepEstimate &step) const
    {
        const Box bounds = scene.bounds(scout.id);
        const Observation seen = scene.observe(scout.id, false);
        // The middle of what turns is carried round as well.
        const Vector3 centre = seen.centre.value_or(bounds.center()),
                      velocity = seen.velocity.value_or(Vector3::Zero());
        const double tolerance = 0.1 * bounds.diagonal().minCoeff();
        const Vector3 expected = 2 * scout.last - scout.before;
        // False, too, when there is NaN in it.
        const bool kept = looks_ == looks_for_line && (centre - expected).cwiseAbs().maxCoeff() <= tolerance;
        if (looks_ > 0 && (centre - scout.last).allFinite())
            step.add(centre - scout.last, scout.velocity, velocity, 1);
        scout.before = scout.last;
        scout.last = centre;
        scout.velocity = velocity;
        return kept;
    }

    std::vector<Scout> scouts_;
    int looks_ = 0;        // in a row, up to looks_for_line
    int disturbances_ = 0; // in a row
    int ticks_to_rest_ = 0;
};
} // namespace ode_predictive_space

#endif
