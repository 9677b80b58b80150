// The loop of two threads: the scene at its own rate, and the servo, which feels a local model of the scene around the
// probe.
//
//     scene's thread, at t                     servo's thread
//     --------------------                     --------------
//     push the bodies  <---- impulses --------  what the hand got up to t
//     advance to t     <--- ContactMemory ----
//     pose the probe   <--- RenderedTick -----  read the device
//     collide
//     roll out         ---- Surroundings ---->  proxy, touches, law, safety, write
//
// The scene steps the interval that has just passed, in which it knows what the hand did. Then it tries out how the touched bodies
// will go on and how they answer a push, through all joints and contacts, and the servo moves them by that.

#include "ode_predictive_space/haptics/loop/decoupled_loop.h"

#include "ode_predictive_space/haptics/loop/decoupled_servo.h"
#include "ode_predictive_space/haptics/loop/scene_motion.h"

#include <cstdio>
#include <ode/misc.h>

namespace ode_predictive_space::haptics
{
namespace
{
/// The scene's side.
class SceneLoop
{
public:
    SceneLoop(LoopParts &parts, DecoupledServo &servo, const SceneWork &work)
        : parts_(parts), servo_(servo), work_(work), sensor_(*parts.probe.sensor()),
          dt_(1 / parts.settings.physics_rate), motion_(sensor_)
    {}

    void run();

    /// All that the hand got and the bodies have not got yet.
    void push_rest();

private:
    void advance(double due);
    void look(double due);
    void find_touches();
    void receive();
    void tell_of_inner_steps();
    void tell_of_surprise();

    LoopParts &parts_;
    DecoupledServo &servo_;
    const SceneWork &work_;
    TouchSensor &sensor_;
    double dt_; ///< s
    SceneMotion motion_;
    bool surprised_ = false; ///< and it has been told
};

void SceneLoop::run()
{
    Pacer pacer(parts_.time.start, dt_, parts_.settings.most_steps_behind);
    const auto goes_on = [this](std::uint64_t steps) {
        return static_cast<double>(steps) * dt_ < parts_.settings.duration && !parts_.must_end() && !servo_.ended();
    };
    for (std::uint64_t steps = 0; goes_on(steps); ++steps)
    {
        if (steps == 0)
        {
            look(pacer.due());
        }
        parts_.counts.dropped += pacer.go_on(parts_.clock.now());
        parts_.clock.sleep_until(pacer.due());
        parts_.scene.begin(parts_.clock.now());
        parts_.guard->begin_step(parts_.clock.now());
        advance(pacer.due());
        parts_.time.simulated = static_cast<double>(steps + 1) * dt_;
        if (goes_on(steps + 1))
        {
            look(pacer.due());
        }
        parts_.scene.end(parts_.clock.now(), pacer.due() + dt_);
    }
    parts_.guard->end_steps();
}

/// The interval that ends now, with what the hand got in it.
void SceneLoop::advance(double due)
{
    const int parts = motion_.inner_steps();
    const double length = dt_ / parts;
    for (int part = 0; part < parts; ++part)
    {
        if (part > 0)
        {
            find_touches();
        }
        receive();
        motion_.push(due - dt_ + part * length, length);
        const unsigned long seed = dRandGetSeed();
        work_.advance(length);
        motion_.note_step(dRandGetSeed() != seed);
        if (!motion_.repeats() && !surprised_)
        {
            tell_of_surprise();
        }
    }
}

void SceneLoop::receive()
{
    Impulse impulse;
    while (servo_.impulses().receive(impulse))
    {
        motion_.receive(impulse);
    }
}

void SceneLoop::find_touches()
{
    parts_.rendered.take();
    sensor_.clear();
    if (sensor_.tracker() != nullptr)
    {
        servo_.memory().take();
        sensor_.tracker()->adopt(servo_.memory().latest());
    }
    parts_.probe.place(parts_.rendered.latest());
    parts_.collide(work_);
}

void SceneLoop::look(double due)
{
    find_touches();
    const RenderedTick &tick = parts_.rendered.latest();
    Surroundings &surroundings = servo_.surroundings().draft();
    surroundings.tool_jumps = tick.tool_jumps;
    surroundings.planes.set(sensor_.touches(), !sensor_.saw_nonsense(), tick.tool.position, due);
    const int inner_steps = motion_.inner_steps();
    motion_.foresee(surroundings.planes, due, dt_, surroundings.forecast);
    if (motion_.inner_steps() != inner_steps)
    {
        tell_of_inner_steps();
    }
    if (sensor_.tracker() != nullptr)
    {
        sensor_.tracker()->hand_over(surroundings.geoms, due);
    }
    servo_.surroundings().publish();
    parts_.probe.renderer().physics_fresh(parts_.clock.now());
}

void SceneLoop::tell_of_inner_steps()
{
    std::array<char, std::tuple_size_v<decltype(Notice::text)>> text;
    std::snprintf(text.data(), text.size(),
                  "The scene is stepped %d times as often, at %.0f Hz: what the probe is near to has joints that are "
                  "too stiff and "
                  "light for steps of %.1f ms.",
                  motion_.inner_steps(), motion_.inner_steps() / dt_, 1000 * dt_);
    parts_.guard->post_of_scene(Notice(NoticeKind::coupling, parts_.now(), text.data()));
}

void SceneLoop::tell_of_surprise()
{
    surprised_ = true;
    parts_.guard->post_of_scene(Notice(NoticeKind::coupling, parts_.now(),
                                       "The program's step does more than ODE's, or less: what is touched is taken to "
                                       "go on with its velocity. Step such a "
                                       "scene at 200 Hz or more, or in one thread."));
}

void SceneLoop::push_rest()
{
    receive();
    motion_.push_all(dt_);
}
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
            {1 / settings.rate, parts.priority_request(false), [&](double due) { servo_side.tick(due); }});
        scene_side.run();
    }
    probe.renderer().relax();
    servo_side.settle();
    scene_side.push_rest();
    if (servo_side.error())
    {
        std::rethrow_exception(servo_side.error());
    }
}
} // namespace ode_predictive_space::haptics
