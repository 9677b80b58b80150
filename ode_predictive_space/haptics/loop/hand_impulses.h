// What the hand gets of each object, as impulses on their way to the scene.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_HAND_IMPULSES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_HAND_IMPULSES_H

#include "ode_predictive_space/haptics/exchange.h"
#include "ode_predictive_space/haptics/loop/motion_forecast.h"
#include "ode_predictive_space/haptics/safety/device_gate.h"

namespace ode_predictive_space::haptics
{
/// A device holds each force until the next write. So each force becomes an impulse when it is over: none is lost and none counts twice.
/// Of the servo, but for the queue's other end. Neither allocates nor locks.
class HandImpulses
{
public:
    /// @param most that can be on their way. @param start s, on the clock.
    HandImpulses(std::size_t most, double start);

    /// To the scene.
    Queue<Impulse> &queue() { return queue_; }

    /// How touched bodies move by what is not in the forecast: the impulses that the scene has not got, and the force that is being held,
    /// as long as nothing else is known.
    void foresee(const MotionForecast &forecast, const ContactModel &planes, double due, ContactModel::Shifts &shifts);

    /// After each write: what the force before it gave to the hand goes to the scene, and the shares of the new one are held.
    ///
    /// @param now s, on the clock.
    void settle(double now, const DeviceGate &gate, const std::vector<ForceShare> &shares);

    /// s, on the clock: when the tick of the last write was due.
    void set_due(double due) { rendered_due_ = due; }

private:
    void give(const ForceShare &share, double seconds);

    Queue<Impulse> queue_;
    std::vector<Impulse> given_;   ///< what the latest forecast does not include
    std::uint64_t numbered_ = 0;   ///< impulses so far
    double rendered_due_;          ///< s, on the clock
    std::vector<ForceShare> held_; ///< what the device has rendered since the last write
    double settled_ = 0;           ///< s, on the clock; when that was
    std::uint64_t zeros_ = 0;      ///< of the gate, by then
};
} // namespace ode_predictive_space::haptics

#endif
