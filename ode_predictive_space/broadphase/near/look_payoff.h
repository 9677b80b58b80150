// Do looks at the gaps of primitives pay in this scene? In: what looks led to. Out: a decision for the next reports.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_LOOK_PAYOFF_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_NEAR_LOOK_PAYOFF_H

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
        if (pays_ && postponed_ + tuning::few_reports >= tuning::least_wait * looks_)
        {
            reports_ = tuning::reports_of_trial;
            looks_ *= tuning::memory_of_trials;
            postponed_ *= tuning::memory_of_trials;
            return false;
        }
        const bool paid = pays_;
        *this = {};
        pays_ = !paid;
        return true;
    }

private:
    bool pays_ = true;
    int reports_ = 0;                  // since the decision
    double looks_ = 0, postponed_ = 0; // those of earlier trials count less
};
} // namespace ode_predictive_space

#endif
