// The servo's side of the loop of two threads.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DECOUPLED_SERVO_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DECOUPLED_SERVO_H

#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "ode_predictive_space/haptics/loop/loop_parts.h"
#include "ode_predictive_space/haptics/loop/motion_forecast.h"

#include <exception>
#include <optional>

namespace ode_predictive_space::haptics
{
/// What the servo knows of the scene, as it was at the last step.
struct Surroundings
{
    ContactModel planes; ///< of what only dCollide() knows
    NearbyGeoms geoms;   ///< all others
    MotionForecast forecast;
    int tool_jumps = 0; ///< as RenderedTick has it: with more of them, the tool is somewhere else by now
};

/// What the hand gets of each object, as impulses on their way to the scene.
///
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

/// Its constructor and destructor run in the scene's thread, all else in the servo's.
class DecoupledServo
{
public:
    explicit DecoupledServo(LoopParts &parts);

    void tick(double due);

    /// After each write: what the force before it gave to the hand, to the impulses.
    void settle();

    /// By an exception of the law. Of the scene's thread, when the servo has ended or ended() is true.
    std::exception_ptr error() const { return error_; }
    bool ended() const { return ended_.load(std::memory_order_acquire); }

    Snapshot<Surroundings> &surroundings() { return surroundings_; }
    Snapshot<ContactMemory> &memory() { return memory_; }
    Queue<Impulse> &impulses() { return impulses_.queue(); }

private:
    void render(double due);
    bool feel(const Surroundings &scene, double due);
    bool feel_geoms(const Surroundings &scene, double due);
    ContactModel::Shift shift_of(std::uintptr_t object, const ContactModel &planes) const;
    void end();

    LoopParts &parts_;
    Renderer &renderer_;
    Snapshot<Surroundings> surroundings_;
    Snapshot<ContactMemory> memory_;
    std::optional<ContactTracker> tracker_; ///< of the probe's own sphere
    int tool_jumps_ = 0;                    ///< as RenderedTick has it
    HandImpulses impulses_;
    ContactModel::Shifts shifts_;
    std::vector<Touch> touches_;
    std::exception_ptr error_;
    std::atomic<bool> ended_{false};
};
} // namespace ode_predictive_space::haptics

#endif
