// The servo's side of the loop of two threads.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DECOUPLED_SERVO_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DECOUPLED_SERVO_H

#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "ode_predictive_space/haptics/loop/hand_impulses.h"
#include "ode_predictive_space/haptics/loop/loop_parts.h"

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
