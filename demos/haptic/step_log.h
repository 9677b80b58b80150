#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_STEP_LOG_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_STEP_LOG_H

#include "ode_predictive_space/haptics/loop/time_histogram.h"
#include "ode_predictive_space/recording/bounded_series.h"

namespace ode_predictive_space::demo
{
/// Totals of a whole run. The thread that steps the scene keeps them.
class StepLog
{
public:
    /// @param seconds in dSpaceCollide(). @param pairs that it reported.
    void collided(double seconds, std::size_t pairs)
    {
        collide_times_.add(seconds);
        collide_series_.add(seconds);
        pairs_ += pairs;
    }

    /// @param seconds for contacts, forces and the step of the world.
    void advanced(double seconds) { advance_series_.add(seconds); }

    haptics::TimeSummary collide() const { return collide_times_.summary(); }          ///< s
    const recording::BoundedSeries &collide_series() const { return collide_series_; } ///< s
    const recording::BoundedSeries &advance_series() const { return advance_series_; } ///< s
    std::uint64_t pairs() const { return pairs_; }                                     ///< sum

private:
    haptics::TimeHistogram collide_times_;
    recording::BoundedSeries collide_series_{};
    recording::BoundedSeries advance_series_{};
    std::uint64_t pairs_ = 0;
};
} // namespace ode_predictive_space::demo

#endif
