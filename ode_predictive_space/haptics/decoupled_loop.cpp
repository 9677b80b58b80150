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

#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "ode_predictive_space/haptics/contact_model.h"
#include "ode_predictive_space/haptics/loop_parts.h"
#include "ode_predictive_space/haptics/motion_forecast.h"
#include "ode_predictive_space/haptics/scene_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <ode/misc.h>
#include <optional>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
/// What the servo knows of the scene, as it was at the last step.
struct Surroundings
{
    ContactModel planes; ///< of what only dCollide() knows
    NearbyGeoms geoms;   ///< all others
    MotionForecast forecast;
    int tool_jumps = 0; ///< as RenderedTick has it: with more of them, the tool is somewhere else by now
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
          rendered_due_(parts.start)
    {
        if (parts.probe.sensor()->tracker() != nullptr)
        {
            tracker_.emplace(parts.probe.sensor()->radius());
        }
        given_.reserve(most_impulses(parts.settings) + 2 * ContactModel::capacity);
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
    void give(const ForceShare &share, double seconds);
    void foresee(const Surroundings &scene, double due);
    bool feel(const Surroundings &scene, double due);
    bool feel_geoms(const Surroundings &scene, double due);
    ContactModel::Shift shift_of(std::uintptr_t object, const ContactModel &planes) const;
    void end();

    static constexpr std::size_t reserved_touches = 256; ///< before the deepest are chosen
    static constexpr std::uint64_t unnumbered = ~std::uint64_t{0};

    LoopParts &parts_;
    Renderer &renderer_;
    Snapshot<Surroundings> surroundings_;
    Snapshot<ContactMemory> memory_;
    std::optional<ContactTracker> tracker_; ///< of the probe's own sphere
    int tool_jumps_ = 0;                    ///< as RenderedTick has it
    Queue<Impulse> impulses_;
    std::vector<Impulse> given_; ///< what the latest surroundings do not include
    ContactModel::Shifts shifts_;
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
    surroundings_.take();
    const Surroundings &scene = surroundings_.latest();
    foresee(scene, due);
    renderer_.read(parts_.first_time + (due - parts_.start), parts_.clock.now());
    const bool all_known = feel(scene, due);
    renderer_.render(touches_, all_known, 1 / parts_.settings.rate);
    parts_.note_rendered(renderer_.last_tick());
}

/// The force that is being held counts as long as nothing else is known.
void Servo::foresee(const Surroundings &scene, double due)
{
    given_.erase(given_.begin(), std::find_if(given_.begin(), given_.end(), [&](const Impulse &impulse) {
                     return impulse.number > scene.forecast.last_included();
                 }));
    const std::size_t known = given_.size();
    for (const ForceShare &share : held_)
    {
        given_.push_back({share.object, share.point, (due - rendered_due_) * share.force, rendered_due_, unnumbered});
    }
    scene.forecast.shift(given_, due, scene.planes, shifts_);
    given_.resize(known);
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
        scene.planes.evaluate(renderer_.tool().position, due, shifts_, touches_);
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
        if (planes.touch(i).object == object)
        {
            return shifts_[i];
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
        geom.shift(shift.moved, shift.turned, shift.velocity, shift.spin);
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
        give(share, held_until - settled_);
    }
    zeros_ = zeros;
    settled_ = now;
    held_ = renderer_.shares();
    if (guard_took_it)
    {
        held_.clear();
    }
}

/// The tick began when it was due: then the scene's semi-implicit steps and the forecast are of one kind, and create no energy.
void Servo::give(const ForceShare &share, double seconds)
{
    const Impulse impulse = {share.object, share.point, seconds * share.force, rendered_due_, ++numbered_};
    if (impulses_.give(impulse) && given_.size() + held_.size() < given_.capacity())
    {
        given_.push_back(impulse);
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
          dt_(1 / parts.settings.physics_rate), motion_(sensor_, parts.probe.renderer().law().material().stiffness)
    {}

    void run();

    /// All that the hand got and the bodies have not got yet.
    void push_rest();

private:
    bool goes_on() const;
    double step_length();
    int affordable_steps() const;
    void advance(double due, double length);
    void look(double due);
    void find_touches();
    void receive();
    void tell_of_shorter_steps();
    void tell_of_surprise();

    LoopParts &parts_;
    Servo &servo_;
    const SceneWork &work_;
    TouchSensor &sensor_;
    double dt_; ///< s; of the program's rate
    SceneMotion motion_;
    int steps_per_period_ = 1; ///< in a time dt_
    double changed_ = 0;       ///< s, simulated; when that became so
    std::uint64_t steps_ = 0;  ///< since then
    double longest_ = 0;       ///< s; that a step took of late
    static constexpr double forgetting = 0.95;
    bool surprised_ = false; ///< and it has been told
};

void SceneLoop::run()
{
    const int most_behind = parts_.settings.most_steps_behind;
    Pacer pacer(parts_.start, dt_, most_behind);
    if (goes_on())
    {
        look(pacer.due());
    }
    while (goes_on())
    {
        const double length = step_length();
        pacer.set_period(length, most_behind * steps_per_period_);
        parts_.dropped += pacer.go_on(parts_.clock.now());
        parts_.clock.sleep_until(pacer.due());
        const double begin = parts_.clock.now();
        parts_.scene.begin(begin);
        parts_.guard->begin_step(begin);
        advance(pacer.due(), length);
        if (goes_on())
        {
            look(pacer.due());
        }
        const double end = parts_.clock.now();
        longest_ = std::max(end - begin, forgetting * longest_);
        parts_.scene.end(end, pacer.due() + length);
    }
    parts_.guard->end_steps();
}

bool SceneLoop::goes_on() const
{
    return parts_.simulated < parts_.settings.duration && !parts_.must_end() && !servo_.ended();
}

/// s; of the step that comes next.
double SceneLoop::step_length()
{
    if (motion_.steps_per_period() != steps_per_period_)
    {
        steps_per_period_ = motion_.steps_per_period();
        changed_ = parts_.simulated;
        steps_ = 0;
        parts_.probe.set_tick_length(dt_ / steps_per_period_);
    }
    return dt_ / steps_per_period_;
}

/// In a period, so that half of it remains.
int SceneLoop::affordable_steps() const
{
    constexpr int enough = 100;
    return longest_ > 0 ? static_cast<int>(std::clamp<double>(0.5 * dt_ / longest_, 1, enough)) : enough;
}

/// The interval that ends now, with what the hand got in it.
void SceneLoop::advance(double due, double length)
{
    receive();
    motion_.push(due - length, length);
    const unsigned long seed = dRandGetSeed();
    work_.advance(length);
    motion_.note_step(dRandGetSeed() != seed);
    if (!motion_.repeats() && !surprised_)
    {
        tell_of_surprise();
    }
    ++steps_;
    parts_.simulated = changed_ + static_cast<double>(steps_) * length;
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
    const int steps = motion_.steps_per_period();
    motion_.foresee(surroundings.planes, due, dt_, affordable_steps(), surroundings.forecast);
    if (motion_.steps_per_period() != steps)
    {
        tell_of_shorter_steps();
    }
    if (sensor_.tracker() != nullptr)
    {
        sensor_.tracker()->hand_over(surroundings.geoms, due);
    }
    servo_.surroundings().publish();
    parts_.probe.renderer().physics_fresh(parts_.clock.now());
}

void SceneLoop::tell_of_shorter_steps()
{
    std::array<char, std::tuple_size_v<decltype(Notice::text)>> text;
    std::snprintf(
        text.data(), text.size(),
        "The scene is stepped %d times as often, at %.0f Hz: what the probe is near to has joints or contacts "
        "that are too stiff and light for steps of %.1f ms.",
        motion_.steps_per_period(), motion_.steps_per_period() / dt_, 1000 * dt_);
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
    scene_side.push_rest();
    if (servo_side.error())
    {
        std::rethrow_exception(servo_side.error());
    }
}
} // namespace ode_predictive_space::haptics
