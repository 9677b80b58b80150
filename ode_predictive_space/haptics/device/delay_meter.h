// How old the states are that a device tells.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DELAY_METER_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DELAY_METER_H

namespace ode_predictive_space::haptics
{
/// The delay by which a device tells its position, from the time stamps of its states. It is the largest mean over some
/// hundred readings: a mean, so that a single late state does not change it; the largest, so that the rendered stiffness does not vary.
class DelayMeter
{
public:
    /// @param age s; from the time stamp of a state to when it was read. Out of reason (below 0, above 0.1): not counted.
    /// @param period s; of the device or the loop, the longer one: a state may be that old without being late.
    /// @return whether the delay has grown.
    bool note(double age, double period);

    /// s; 0 before there is a mean.
    double delay() const { return delay_; }

private:
    double sum_ = 0; ///< s
    int count_ = 0;
    double delay_ = 0; ///< s
};
} // namespace ode_predictive_space::haptics

#endif
