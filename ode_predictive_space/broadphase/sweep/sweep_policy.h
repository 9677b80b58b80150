// When does prediction not pay, and when does it again?

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_SWEEP_SWEEP_POLICY_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_SWEEP_SWEEP_POLICY_H

#include <algorithm>
#include <cstddef>

#include "ode_predictive_space/broadphase/tuning.h"

namespace ode_predictive_space
{
/// Counts the objects that break their predictions. When they are a large part of the scene for several ticks in a row, the
/// scene is to be swept until its motion has been calm for some ticks; for more, each time that the calm did not last.
class SweepPolicy
{
public:
    /// Sweeping begins for another reason: any calm ends it.
    void begin_with_new_objects()
    {
        streak_ = 0;
        required_calm_ = 1;
    }

    /// A tick of prediction has passed; the first prediction of an object does not count as broken.
    ///
    /// @return true when the scene is to be swept from this tick on.
    bool prediction_fails(std::size_t broken, std::size_t objects)
    {
        const bool bad = broken * tuning::sweeps_per_prediction > objects;
        streak_ = bad == was_bad_ ? streak_ + 1 : 1;
        was_bad_ = bad;
        if (!bad && streak_ >= tuning::proven_ticks)
            required_calm_ = tuning::first_calm;
        const bool fails = bad && streak_ >= tuning::tolerated_failures;
        if (fails)
            streak_ = 0;
        return fails;
    }

    /// A tick of sweeping has passed.
    ///
    /// @param calm enough objects moved as could have been predicted.
    /// @return true when all objects are to be predicted from this tick on.
    bool calm_returns(bool calm)
    {
        streak_ = calm ? streak_ + 1 : 0;
        if (streak_ < required_calm_)
            return false;
        streak_ = 0;
        required_calm_ = std::min(2 * required_calm_, tuning::last_calm);
        return true;
    }

private:
    bool was_bad_ = false;
    int streak_ = 0;
    int required_calm_ = tuning::first_calm;
};
} // namespace ode_predictive_space

#endif
