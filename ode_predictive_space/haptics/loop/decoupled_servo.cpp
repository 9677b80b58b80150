#include "ode_predictive_space/haptics/loop/decoupled_servo.h"

#include "ode_predictive_space/haptics/safety/watchdog.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr std::size_t reserved_touches = 256; // before the deepest are chosen
constexpr std::size_t most_shares = 2 * ContactModel::capacity;
constexpr std::uint64_t unnumbered = ~std::uint64_t{0};

/// Impulses that can be on their way before the watchdog has taken the force away from a scene that does not fetch them.
std::size_t most_impulses(const LoopSettings &settings)
{
    constexpr double decay = 0.01; // s; of the watchdog, at most
    const WatchdogLimits limits = WatchdogLimits::of(settings.rate, settings.physics_rate);
    const double ticks = std::ceil(settings.rate * (limits.stale_after + decay)) + 2;
    return most_shares * static_cast<std::size_t>(ticks);
}
} // namespace

HandImpulses::HandImpulses(std::size_t most, double start) : queue_(most), rendered_due_(start)
{
    given_.reserve(most + most_shares);
    held_.reserve(most_shares);
}

void HandImpulses::foresee(const MotionForecast &forecast, const ContactModel &planes, double due,
                           ContactModel::Shifts &shifts)
{
    given_.erase(given_.begin(), std::find_if(given_.begin(), given_.end(), [&](const Impulse &impulse) {
                     return impulse.number > forecast.last_included();
                 }));
    const std::size_t known = given_.size();
    for (const ForceShare &share : held_)
        given_.push_back({share.object, share.point, (due - rendered_due_) * share.force, rendered_due_, unnumbered});
    forecast.shift(given_, due, planes, shifts);
    given_.resize(known);
}

void HandImpulses::settle(double now, const DeviceGate &gate, const std::vector<ForceShare> &shares)
{
    const std::uint64_t zeros = gate.zeros();
    const bool guard_took_it = zeros != zeros_; // the servo has hung since
    const double held_until = guard_took_it ? std::clamp(gate.last_zero(), settled_, now) : now;
    for (const ForceShare &share : held_)
        give(share, held_until - settled_);
    zeros_ = zeros;
    settled_ = now;
    held_ = shares;
    if (guard_took_it)
        held_.clear();
}

/// The tick began when it was due: then the scene's semi-implicit steps and the forecast are of one kind, and create no energy.
void HandImpulses::give(const ForceShare &share, double seconds)
{
    const Impulse impulse = {share.object, share.point, seconds * share.force, rendered_due_, ++numbered_};
    if (queue_.give(impulse) && given_.size() + held_.size() < given_.capacity())
        given_.push_back(impulse);
}

DecoupledServo::DecoupledServo(LoopParts &parts)
    : parts_(parts), renderer_(parts.probe.renderer()), impulses_(most_impulses(parts.settings), parts.time.start)
{
    if (parts.probe.sensor()->tracker() != nullptr)
        tracker_.emplace(parts.probe.sensor()->radius());
    touches_.reserve(reserved_touches);
}

void DecoupledServo::tick(double due)
{
    const double now = parts_.clock.now();
    parts_.guard->beat(now);
    if (ended())
        return;
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
        impulses_.set_due(due);
    }
    catch (...)
    {
        error_ = std::current_exception();
        end();
    }
    parts_.servo.end(parts_.clock.now(), due + 1 / parts_.settings.rate);
}

void DecoupledServo::render(double due)
{
    surroundings_.take();
    const Surroundings &scene = surroundings_.latest();
    impulses_.foresee(scene.forecast, scene.planes, due, shifts_);
    renderer_.read(parts_.time.first + (due - parts_.time.start), parts_.clock.now());
    const bool all_known = feel(scene, due);
    renderer_.render(touches_, all_known, 1 / parts_.settings.rate);
    parts_.note_rendered(renderer_.last_tick());
}

/// @return whether the touches are all there are.
bool DecoupledServo::feel(const Surroundings &scene, double due)
{
    if (scene.tool_jumps != renderer_.last_tick().tool_jumps)
        touches_.clear();
    else
        scene.planes.evaluate(renderer_.tool().position, due, shifts_, touches_);
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
ContactModel::Shift DecoupledServo::shift_of(std::uintptr_t object, const ContactModel &planes) const
{
    for (std::size_t i = 0; i < planes.count(); ++i)
        if (planes.touch(i).object == object)
            return shifts_[i];
    return {};
}

bool DecoupledServo::feel_geoms(const Surroundings &scene, double due)
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
    if (scene.tool_jumps == tool_jumps_)
    {
        for (const NearbyGeom &known : nearby.geoms)
        {
            NearbyGeom geom = known.later(due - nearby.time);
            const ContactModel::Shift shift = shift_of(geom.object(), scene.planes);
            geom.shift(shift.moved, shift.turned, shift.velocity, shift.spin);
            tracker_->add(std::move(geom));
        }
    }
    tracker_->follow();
    tracker_->remember_in(memory_.draft());
    memory_.publish();
    return tracker_->touches(renderer_.law().view(), touches_);
}

void DecoupledServo::settle()
{
    impulses_.settle(parts_.clock.now(), renderer_.gate(), renderer_.shares());
}

void DecoupledServo::end()
{
    renderer_.relax();
    settle();
    ended_.store(true, std::memory_order_release);
}
} // namespace ode_predictive_space::haptics
