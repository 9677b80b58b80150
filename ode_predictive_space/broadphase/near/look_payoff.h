// Do looks at the gaps of primitives pay in this scene? In: what looks led to. Out: a decision for the next reports.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_LOOK_PAYOFF_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_LOOK_PAYOFF_H

#include <cstdint>

#include "ode_predictive_space/broadphase/tuning.h"

namespace ode_predictive_space
{
/// The contacts of two primitives cost little to find. To look at their gap, and to follow both objects, costs as much as a few
/// reports of the pair: in piles and of ragdolls more than is spared, of what flies much less. It is decided for all pairs of
/// primitives together, by counts: callbacks stay the same in every run.
class LookPayoff
{
public:
    bool pays() const { return pays_; }

    void note_look() { ++looks_; }
    /// A pair was not reported.
    void note_postponed() { ++postponed_; }

    /// A look had to wait for a surface to be built: what was counted says little.
    void note_waiting() { *this = {}; }

    /// @return has the decision changed?
    bool end_report()
    {
        ++reports_;
        if (reports_ == tuning::reports_of_trial && pays_)
            looks_ = postponed_ = 0; // the first looks, at all pairs, say little
        if (reports_ < (pays_ ? 2 * tuning::reports_of_trial : tuning::reports_between_trials))
            return false;
        const bool paid = pays_;
        pays_ = !paid || postponed_ >= std::uint64_t{tuning::least_wait} * looks_;
        reports_ = paid && pays_ ? tuning::reports_of_trial : 0;
        looks_ = postponed_ = 0;
        return pays_ != paid;
    }

private:
    bool pays_ = true;
    int reports_ = 0;                         // since the decision
    std::uint64_t looks_ = 0, postponed_ = 0; // in as many reports as a trial has
};
} // namespace ode_predictive_space

#endif
