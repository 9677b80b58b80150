// The loop of two threads: the scene at its own rate, and the servo, which feels a local model of the scene around the
// probe.
//
//     scene's thread                           servo's thread
//     --------------                           --------------
//                      <--- ContactMemory ---
//     pose the probe   <--- RenderedTick -----  read the device
//     collide          ---- Surroundings ---->  proxy, touches, law, safety, write
//     push the bodies  <---- impulses --------  what the hand got since
//     advance

#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "ode_predictive_space/haptics/contact_model.h"
#include "ode_predictive_space/haptics/loop_parts.h"
#include "ode_predictive_space/haptics/pending_motion.h"
#include "ode_predictive_space/haptics/push_response.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
/// What the hand got of an object: it owes the object the opposite.
struct Impulse
{
    std::uintptr_t object;
    Vector3 point;   ///< m
    Vector3 impulse; ///< N s
    std::uint64_t number = 0;
};

/// What the servo knows of the scene, as it was at the last step.
struct Surroundings
{
    ContactModel planes; ///< of what only dCollide() knows
    NearbyGeoms geoms;   ///< all others
    int tool_jumps = 0;  ///< as RenderedTick has it: with more of them, the tool is somewhere else by now
};

/// Impulses that can be on their way before the watchdog has taken the force away from a scene that does not fetch them.
std::size_t most_impulses(const LoopSettings &settings)
{
    constexpr double decay = 0.01; // s; of the watchdog, at most
    const WatchdogLimits limits = WatchdogLimits::of(settings.rate, settings.physics_rate);
    const double ticks = std::ceil(settings.rate * (limits.stale_after + decay)) + 2;
    return 2 * ContactModel::capacity * static_cast<std::size_t>(ticks);
}

/// The servo's side. Its constructor and destructor run in the scene's thread, all else in the servo's.
class Servo
{
public:
    Servo(LoopParts &parts)
        : parts_(parts), renderer_(parts.probe.renderer()), impulses_(most_impulses(parts.settings)),
          pending_(most_impulses(parts.settings)), rendered_due_(parts.start)
    {
        if (parts.probe.sensor()->tracker() != nullptr)
        {
            tracker_.emplace(parts.probe.sensor()->radius());
        }
        touches_.reserve(reserved_touches);
        held_.reserve(2 * ContactModel::capacity);
    }

    void tick(double due);

    /// After each write: what the force before it gave to the hand, to the impulses.
    void settle();

    /// By an exception of the law. Of the scene's thread, when the servo has ended or ended() is true.
    std::exception_ptr error() const { return error_; }
    bool ended() const { return ended_.load(std::memory_order_acquire); }

    Snapshot<Surroundings> &surroundings() { return surroundings_; }
    Snapshot<ContactMemory> &memory() { return memory_; }
    Queue<Impulse> &impulses() { return impulses_; }

private:
    void render(double due);
    void give(const Impulse &impulse);
    bool feel(const Surroundings &scene, double due);
    bool feel_geoms(const Surroundings &scene, double due);
    ContactModel::Shift shift_of(std::uintptr_t object, const ContactModel &planes) const;
    void end();

    static constexpr std::size_t reserved_touches = 256; ///< before the deepest are chosen

    LoopParts &parts_;
    Renderer &renderer_;
    Snapshot<Surroundings> surroundings_;
    Snapshot<ContactMemory> memory_;
    std::optional<ContactTracker> tracker_; ///< of the probe's own sphere
    int tool_jumps_ = 0;                    ///< as RenderedTick has it
    Queue<Impulse> impulses_;
    PendingMotion pending_;
    std::uint64_t numbered_ = 0; ///< impulses so far
    double rendered_due_;        ///< s, on the clock; when the tick of the last write was due
    std::vector<Touch> touches_;
    std::vector<ForceShare> held_; ///< what the device has rendered since the last write
    double settled_ = 0;           ///< s, on the clock; when that was
    std::uint64_t zeros_ = 0;      ///< of the gate, by then
    std::exception_ptr error_;
    std::atomic<bool> ended_{false};
};

void Servo::tick(double due)
{
    const double now = parts_.clock.now();
    parts_.guard->beat(now);
    if (ended())
    {
        return;
    }
    parts_.servo.begin(now);
    if (parts_.must_end())
    {
        end();
        return;
    }
    try
    {
        render(due);
        settle();
        rendered_due_ = due;
    }
    catch (...)
    {
        error_ = std::current_exception();
        end();
    }
    parts_.servo.end(parts_.clock.now(), due + 1 / parts_.settings.rate);
}

void Servo::render(double due)
{
    const bool is_new = surroundings_.take();
    const Surroundings &scene = surroundings_.latest();
    pending_.update(scene.planes, is_new, held_, rendered_due_, due);
    renderer_.read(parts_.first_time + (due - parts_.start), parts_.clock.now());
    const bool all_known = feel(scene, due);
    renderer_.render(touches_, all_known, 1 / parts_.settings.rate);
    parts_.note_rendered(renderer_.last_tick());
}

/// @return whether the touches are all there are.
bool Servo::feel(const Surroundings &scene, double due)
{
    if (scene.tool_jumps != renderer_.last_tick().tool_jumps)
    {
        touches_.clear();
    }
    else
    {
        scene.planes.evaluate(renderer_.tool().position, due, pending_.shifts(), touches_);
    }
    const bool all_known = !tracker_ || feel_geoms(scene, due);
    if (touches_.size() > ContactModel::capacity)
    {
        std::nth_element(touches_.begin(), touches_.begin() + ContactModel::capacity, touches_.end(),
                         [](const Touch &a, const Touch &b) { return a.depth > b.depth; });
        touches_.resize(ContactModel::capacity);
    }
    return all_known && scene.planes.all_known();
}

/// The deepest touch says how far the whole object has gone.
ContactModel::Shift Servo::shift_of(std::uintptr_t object, const ContactModel &planes) const
{
    for (std::size_t i = 0; i < planes.count(); ++i)
    {
        if (planes.surface(i).touch.object == object)
        {
            return pending_.shifts()[i];
        }
    }
    return {};
}

bool Servo::feel_geoms(const Surroundings &scene, double due)
{
    const NearbyGeoms &nearby = scene.geoms;
    tracker_->begin();
    if (renderer_.last_tick().tool_jumps != tool_jumps_)
    {
        tool_jumps_ = renderer_.last_tick().tool_jumps;
        tracker_->forget();
    }
    tracker_->aim(renderer_.tool().position);
    tracker_->set_stiffness(renderer_.law().material().stiffness);
    const std::size_t count = scene.tool_jumps == tool_jumps_ ? nearby.count : 0;
    for (std::size_t i = 0; i < count; ++i)
    {
        NearbyGeom geom = nearby.geoms[i].later(due - nearby.time);
        const ContactModel::Shift shift = shift_of(geom.object(), scene.planes);
        geom.shift(shift.moved, shift.velocity);
        tracker_->add(std::move(geom));
    }
    tracker_->follow();
    tracker_->remember_in(memory_.draft());
    memory_.publish();
    return tracker_->touches(renderer_.law().view(), touches_);
}

void Servo::settle()
{
    const double now = parts_.clock.now();
    const std::uint64_t zeros = renderer_.gate().zeros();
    const bool guard_took_it = zeros != zeros_; // the servo has hung since
    const double held_until = guard_took_it ? std::clamp(renderer_.gate().last_zero(), settled_, now) : now;
    for (const ForceShare &share : held_)
    {
        give({share.object, share.point, (held_until - settled_) * share.force});
    }
    zeros_ = zeros;
    settled_ = now;
    held_ = renderer_.shares();
    if (guard_took_it)
    {
        held_.clear();
    }
}

/// The pending motion is of the body, which gets the opposite.
void Servo::give(const Impulse &impulse)
{
    Impulse numbered = impulse;
    numbered.number = ++numbered_;
    if (impulses_.give(numbered))
    {
        pending_.add(impulse.object, impulse.point, -impulse.impulse, rendered_due_, numbered_);
    }
}

void Servo::end()
{
    renderer_.relax();
    settle();
    ended_.store(true, std::memory_order_release);
}

/// The scene's side.
class SceneLoop
{
public:
    SceneLoop(LoopParts &parts, Servo &servo, const SceneWork &work)
        : parts_(parts), servo_(servo), work_(work), sensor_(*parts.probe.sensor()),
          dt_(1 / parts.settings.physics_rate), response_(dt_)
    {}

    void run();

    /// What the hand got since the last step: the bodies get it with the next one.
    void push();

private:
    void step(double due);
    void publish(const RenderedTick &tick, double due);

    LoopParts &parts_;
    Servo &servo_;
    const SceneWork &work_;
    TouchSensor &sensor_;
    double dt_; ///< s
    PushResponse response_;
    std::vector<ForceShare> shares_;
    std::uint64_t received_ = 0; ///< the number of the last impulse that has moved a body
    double pushed_at_ = 0;       ///< s, on the clock; from when on
};

void SceneLoop::run()
{
    Pacer pacer(parts_.start, dt_, parts_.settings.most_steps_behind);
    for (std::uint64_t steps = 0;
         static_cast<double>(steps) * dt_ < parts_.settings.duration && !parts_.must_end() && !servo_.ended(); ++steps)
    {
        parts_.clock.sleep_until(pacer.due());
        parts_.scene.begin(parts_.clock.now());
        parts_.guard->begin_step(parts_.clock.now());
        step(pacer.due());
        parts_.simulated = static_cast<double>(steps + 1) * dt_;
        parts_.dropped += pacer.go_on(parts_.clock.now());
        parts_.scene.end(parts_.clock.now(), pacer.due());
    }
    parts_.guard->end_steps();
}

void SceneLoop::step(double due)
{
    parts_.rendered.take();
    const RenderedTick &tick = parts_.rendered.latest();
    sensor_.clear();
    if (sensor_.tracker() != nullptr)
    {
        servo_.memory().take();
        sensor_.tracker()->adopt(servo_.memory().latest());
    }
    parts_.probe.place(tick);
    parts_.collide(work_);
    publish(tick, due);
    parts_.probe.renderer().physics_fresh(parts_.clock.now());
    push();
    pushed_at_ = due;
    work_.advance(dt_);
}

void SceneLoop::publish(const RenderedTick &tick, double due)
{
    Surroundings &surroundings = servo_.surroundings().draft();
    surroundings.tool_jumps = tick.tool_jumps;
    ContactModel &model = surroundings.planes;
    model.set(sensor_.touches(), !sensor_.saw_nonsense(), tick.tool.position, due);
    model.set_included(received_, pushed_at_);
    response_.begin();
    for (std::size_t i = 0; i < model.count(); ++i)
    {
        const Touch &touch = model.surface(i).touch;
        model.mobility(i) = response_.look(touch, sensor_.body_of(touch.object));
    }
    if (sensor_.tracker() != nullptr)
    {
        sensor_.tracker()->hand_over(surroundings.geoms, due);
    }
    servo_.surroundings().publish();
}

void SceneLoop::push()
{
    shares_.clear();
    Impulse impulse;
    while (servo_.impulses().receive(impulse))
    {
        shares_.push_back({impulse.object, impulse.point, impulse.impulse / dt_});
        received_ = impulse.number;
    }
    response_.note_pushes(shares_);
    sensor_.push(shares_);
}
} // namespace

void LoopParts::run_decoupled(const SceneWork &work)
{
    Servo servo_side(*this);
    SceneLoop scene_side(*this, servo_side, work);
    probe.set_tick_length(1 / settings.physics_rate);
    probe.sensor()->set_margin(settings.margin);
    probe.begin(first_time, start);
    note_rendered(probe.last_tick());
    {
        const std::unique_ptr<RunningTask> servo_task =
            clock.start({1 / settings.rate, priority_request(false), [&](double due) { servo_side.tick(due); }});
        scene_side.run();
    }
    probe.renderer().relax();
    servo_side.settle();
    scene_side.push();
    if (servo_side.error())
    {
        std::rethrow_exception(servo_side.error());
    }
}
} // namespace ode_predictive_space::haptics
