// The loop of two threads: the scene at its own rate, and the servo, which renders a local model of the scene.
//
//     scene's thread, at t                     servo's thread
//     --------------------                     --------------
//     push the bodies  <---- impulses --------  what the hand got up to t
//     advance to t     <--- ContactMemory ----
//     pose the probe   <--- RenderedTick -----  read the device
//     collide
//     roll out         ---- Surroundings ---->  proxy, touches, law, safety, write
//
// The scene steps the interval that has just passed, for which the hand's impulses are known. Then it predicts the
// motion of the touched bodies, and their response to a push through all joints and contacts, for the servo.

#include "ode_predictive_space/haptics/loop/decoupled_servo.h"
#include "ode_predictive_space/haptics/loop/scene_motion.h"
#include "ode_predictive_space/haptics/loop/trial_messages.h"

#include <cstdio>
#include <ode/misc.h>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double rounding_of_ticks = 1e-9; // of a number of ticks

class SceneLoop
{
public:
    SceneLoop(LoopParts &parts, DecoupledServo &servo, const SceneWork &work)
        : parts_(parts), servo_(servo), work_(work), sensor_(*parts.probe.sensor()),
          dt_(1 / parts.settings.physics_rate), motion_(sensor_, parts.probe.renderer().law().material().stiffness)
    {}

    void run()
    {
        double due = parts_.time.start;
        if (goes_on())
            look(due);
        while (goes_on())
        {
            const double length = step_length();
            const int most_behind = parts_.settings.most_steps_behind * steps_per_period_;
            parts_.counts.dropped += go_on(due, length, most_behind, parts_.clock.now());
            parts_.sleep_until(due);
            const double begin = parts_.clock.now();
            parts_.scene.begin(begin);
            parts_.guard->begin_step(begin);
            advance(due, length);
            if (goes_on())
                look(due);
            const double end = parts_.clock.now();
            budget_.note(end - begin);
            parts_.scene.end(end, due + length);
        }
        parts_.guard->end_steps();
    }

    void push_rest()
    {
        receive();
        motion_.push_all(dt_);
    }

private:
    bool goes_on() const
    {
        return parts_.time.simulated < parts_.settings.duration && !parts_.must_end() && !servo_.ended();
    }

    double step_length()
    {
        if (motion_.steps_per_period() != steps_per_period_)
        {
            steps_per_period_ = motion_.steps_per_period();
            changed_ = parts_.time.simulated;
            steps_ = 0;
            parts_.probe.set_tick_length(dt_ / steps_per_period_);
        }
        return dt_ / steps_per_period_;
    }

    void advance(double due, double length)
    {
        receive();
        motion_.push(due - length, length);
        const unsigned long seed = dRandGetSeed();
        work_.advance(length);
        motion_.note_step(dRandGetSeed() != seed);
        if (motion_.steps_otherwise() && !deviated_)
            notify_of_deviation();
        ++steps_;
        parts_.time.simulated = changed_ + static_cast<double>(steps_) * length;
    }

    void receive()
    {
        Impulse impulse;
        while (servo_.impulses.queue().receive(impulse))
            motion_.receive(impulse);
    }

    void find_touches()
    {
        parts_.rendered.take();
        sensor_.clear();
        if (sensor_.tracker() != nullptr)
        {
            servo_.memory.take();
            sensor_.tracker()->adopt(servo_.memory.latest());
        }
        parts_.probe.place(parts_.rendered.latest());
        parts_.collide(work_);
        if (sensor_.is_reading() && !std::exchange(notified_of_reading_, true))
            parts_.notify(NoticeKind::contact, reading_notice, LoopGuard::Side::scene);
        if (sensor_.exceeds_capacity() && !std::exchange(notified_of_capacity_, true))
            parts_.notify(NoticeKind::contact, capacity_notice, LoopGuard::Side::scene);
    }

    void look(double due)
    {
        find_touches();
        Surroundings &surroundings = servo_.surroundings.draft();
        surroundings.tool_jumps = parts_.rendered.latest().tool_jumps;
        surroundings.all_known = !sensor_.saw_nonsense();
        const int steps = motion_.steps_per_period();
        {
            const TrialMessages messages;
            motion_.predict(due, dt_, affordable_steps(), surroundings.forecast);
            note_messages(messages.count());
        }
        if (motion_.steps_per_period() != steps)
            notify_of_shorter_steps();
        hand_over_geoms(surroundings);
        servo_.surroundings.publish();
        parts_.probe.renderer().physics_fresh(parts_.clock.now());
    }

    void hand_over_geoms(Surroundings &surroundings)
    {
        sensor_.hand_over(surroundings.geoms);
        for (NearbyGeom &geom : surroundings.geoms)
            if (!geom.is_in_contact() && !surroundings.forecast.predicts(geom.object()))
                motion_.push_rest(geom);
    }

    /// Maximum number of steps per period. A step shorter than a tick would get the impulse of a tick as a pulse, which
    /// adds energy to bodies in contact.
    int affordable_steps() const
    {
        return std::min(budget_.affordable(dt_),
                        static_cast<int>(parts_.settings.rate * dt_ * (1 + rounding_of_ticks)));
    }

    void note_messages(std::uint64_t count)
    {
        if (count > 0 && parts_.counts.trial_messages == 0)
            notify("ODE gives messages about trial steps, which predict the motion of touched bodies. They are counted "
                   "and not passed on.");
        parts_.counts.trial_messages += count;
    }

    void notify_of_shorter_steps()
    {
        std::array<char, std::tuple_size_v<decltype(Notice::text)>> text;
        std::snprintf(
            text.data(), text.size(),
            "The scene is stepped %d times as often, at %.0f Hz: bodies near the probe have joints or contacts that "
            "are too stiff for steps of %.1f ms.",
            motion_.steps_per_period(), motion_.steps_per_period() / dt_, 1000 * dt_);
        notify(text.data());
    }

    void notify_of_deviation()
    {
        deviated_ = true;
        notify(
            "The program's step does more or less than ODE's: touched bodies are predicted from their velocity alone. "
            "Step such a scene at 200 Hz or more, or in one thread.");
    }

    void notify(std::string_view sentence) { parts_.notify(NoticeKind::coupling, sentence, LoopGuard::Side::scene); }

    LoopParts &parts_;
    DecoupledServo &servo_;
    const SceneWork &work_;
    TouchSensor &sensor_;
    double dt_; ///< s; of the program's rate
    SceneMotion motion_;
    int steps_per_period_ = 1; ///< in a time dt_
    double changed_ = 0;       ///< s, simulated; of the last change
    std::uint64_t steps_ = 0;  ///< since the last change
    StepBudget budget_;
    bool notified_of_reading_ = false;
    bool notified_of_capacity_ = false;
    bool deviated_ = false; ///< the notice was sent
};
} // namespace

void run_decoupled(LoopParts &parts, const SceneWork &work)
{
    const LoopSettings &settings = parts.settings;
    HapticProbe &probe = parts.probe;
    DecoupledServo servo_side(parts);
    SceneLoop scene_side(parts, servo_side, work);
    probe.set_tick_length(1 / settings.physics_rate);
    probe.sensor()->set_margin(settings.margin);
    probe.begin(parts.time.first, parts.time.start);
    parts.note_rendered(probe.last_tick());
    {
        const std::unique_ptr<RunningTask> servo_task = parts.clock.start(
            {1 / settings.rate, [&] { parts.ask_for_priority(false); }, [&](double due) { servo_side.tick(due); }});
        scene_side.run();
    }
    probe.renderer().relax();
    servo_side.settle(parts.clock.now());
    scene_side.push_rest();
    if (servo_side.error())
        std::rethrow_exception(servo_side.error());
}
} // namespace ode_predictive_space::haptics
