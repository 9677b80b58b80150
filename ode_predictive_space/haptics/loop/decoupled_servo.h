// The servo's side of the loop of two threads.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DECOUPLED_SERVO_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DECOUPLED_SERVO_H

#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "ode_predictive_space/haptics/loop/loop_parts.h"
#include "ode_predictive_space/haptics/loop/motion_forecast.h"
#include "ode_predictive_space/haptics/safety/watchdog.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <utility>

namespace ode_predictive_space::haptics
{
struct Surroundings
{
    std::vector<NearbyGeom> geoms; ///< around the library's sphere, or in contact with a geom of the program
    bool all_known = true;         ///< all contacts are finite
    MotionForecast forecast;       ///< from the time at which the geoms were so
    int tool_jumps = 0;            ///< of RenderedTick; if it has grown since, the copy is out of date
};

/// The impulses between hand and objects on their way to the scene. A device holds each force until the next write, which is
/// due a tick later. The impulse of that tick is sent as soon as the force is written, so that it reaches the scene before its
/// step: late impulses would act as pulses, which add energy to bodies in contact. If a force is held longer or shorter than a
/// tick, the difference follows after the next write, so no impulse is lost or counted twice. For the servo's thread, except
/// the queue's other end. Neither allocates nor locks.
class HandImpulses
{
public:
    explicit HandImpulses(const LoopParts &parts)
        : queue_(most_on_their_way(parts.settings)), tick_(1 / parts.settings.rate), due_(parts.time.start)
    {
        given_.reserve(most_on_their_way(parts.settings) + most_shares);
        held_.reserve(most_shares);
    }

    Queue<Impulse> &queue() { return queue_; }

    /// The motion of touched bodies by impulses that the forecast lacks, and by a force that is held longer than a tick.
    Shifts predict(const MotionForecast &forecast, double due)
    {
        const auto is_new = [&](const Impulse &impulse) { return impulse.number > forecast.last_included; };
        given_.erase(given_.begin(), std::find_if(given_.begin(), given_.end(), is_new));
        const std::size_t known = given_.size();
        const double longer = due - due_ - tick_;
        if (longer > rounding)
            for (const ForceShare &share : held_)
                given_.push_back({share.object, share.arm, longer * share.force, due_ + tick_, unnumbered});
        const Shifts shifts = forecast.shifts(given_, due);
        given_.resize(known);
        return shifts;
    }

    /// Moves a body without a forecast by the impulses that the scene has not got.
    void push(NearbyGeom &geom, double due) const
    {
        for (const Impulse &impulse : given_)
            if (impulse.object == geom.object())
                geom.push(-impulse.impulse, impulse.arm, due - impulse.time);
    }

    /// After each write. Both times are in s, on the clock. The due time of the tick counts as its beginning, so the impulses
    /// agree with the scene's semi-implicit steps, and create no energy.
    void settle(double now, double due, const DeviceGate &gate, const std::vector<ForceShare> &shares)
    {
        const double zero = gate.last_zero();
        const bool guard_took_it = zero != zero_; // the servo has hung since then
        const double held_until = guard_took_it ? std::clamp(zero, written_, now) : now;
        give(held_until - written_ - tick_, due_ + tick_);
        zero_ = zero;
        written_ = now;
        due_ = due;
        held_ = shares;
        if (guard_took_it)
            held_.clear();
        give(tick_, due);
    }

private:
    static constexpr std::size_t most_shares = 2 * touch_capacity;
    static constexpr std::uint64_t unnumbered = ~std::uint64_t{0};
    static constexpr double rounding = 1e-12; ///< s

    /// Impulses until the watchdog stops the force of a scene that hangs: a force has one for its tick, one for the difference.
    static std::size_t most_on_their_way(const LoopSettings &settings)
    {
        constexpr double decay = 0.01; // s; of the watchdog, at most
        const WatchdogLimits limits = WatchdogLimits::of(settings.rate, settings.physics_rate);
        const double ticks = std::ceil(settings.rate * (limits.stale_after + decay)) + 2;
        return 2 * most_shares * static_cast<std::size_t>(ticks);
    }

    void give(double seconds, double time)
    {
        if (std::abs(seconds) <= rounding)
            return;
        for (const ForceShare &share : held_)
        {
            const Impulse impulse = {share.object, share.arm, seconds * share.force, time, ++numbered_};
            if (!share.force.isZero(0) && queue_.give(impulse) && given_.size() + held_.size() < given_.capacity())
                given_.push_back(impulse);
        }
    }

    Queue<Impulse> queue_;
    std::vector<Impulse> given_; ///< impulses that the latest forecast does not include
    std::uint64_t numbered_ = 0;
    double tick_;                  ///< s; length of a tick
    double due_;                   ///< s, on the clock; when the tick of the last write was due
    std::vector<ForceShare> held_; ///< the force since the last write
    double written_ = 0;           ///< s, on the clock; of the last write
    double zero_ = -std::numeric_limits<double>::infinity(); ///< of the gate at the last write
};

/// Constructor and destructor run in the scene's thread, all else in the servo's.
class DecoupledServo
{
public:
    explicit DecoupledServo(LoopParts &parts) : impulses(parts), parts_(parts), renderer_(parts.probe.renderer())
    {
        if (parts.probe.sensor()->tracker() != nullptr)
        {
            tracker_.emplace(parts.probe.sensor()->radius());
            tracker_->set_tick_length(1 / parts.settings.rate);
        }
        touches_.reserve(reserved_touches);
    }

    void tick(double due)
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
            settle(due);
        }
        catch (...)
        {
            error_ = std::current_exception();
            end();
        }
        parts_.servo.end(parts_.clock.now(), due + 1 / parts_.settings.rate);
    }

    /// After each write. @param due s, on the clock; when the tick was due.
    void settle(double due) { impulses.settle(parts_.clock.now(), due, renderer_.gate(), renderer_.shares()); }

    /// The exception of the law that ended the servo. For the scene's thread, once ended() is true.
    std::exception_ptr error() const { return error_; }
    bool ended() const { return ended_.load(std::memory_order_acquire); }

    // The scene's thread uses the other ends.
    Snapshot<Surroundings> surroundings;
    Snapshot<ContactMemory> memory;
    HandImpulses impulses;

private:
    static constexpr std::size_t reserved_touches = 2 * touch_capacity; ///< before touches are dropped

    void render(double due)
    {
        surroundings.take();
        const Surroundings &scene = surroundings.latest();
        shifts_ = impulses.predict(scene.forecast, due);
        renderer_.read(parts_.time.first + (due - parts_.time.start), parts_.clock.now());
        const bool all_known = feel(scene, due);
        renderer_.render(touches_, all_known, 1 / parts_.settings.rate);
        parts_.note_rendered(renderer_.last_tick());
    }

    bool feel(const Surroundings &scene, double due)
    {
        touches_.clear();
        begin_contact();
        if (scene.tool_jumps == tool_jumps_)
        {
            for (const NearbyGeom &known : scene.geoms)
            {
                NearbyGeom geom = known.later(due - scene.forecast.time);
                move_on(geom, scene.forecast, due);
                add(std::move(geom));
            }
        }
        const bool all_known = follow();
        if (keep_within_capacity(touches_) && !std::exchange(notified_of_capacity_, true))
            parts_.notify(NoticeKind::contact, capacity_notice);
        return all_known && scene.all_known;
    }

    void begin_contact()
    {
        const int jumps = renderer_.last_tick().tool_jumps;
        const bool jumped = std::exchange(tool_jumps_, jumps) != jumps;
        if (!tracker_)
            return;
        tracker_->begin();
        if (jumped)
            tracker_->forget();
        tracker_->aim(renderer_.tool().position);
        tracker_->set_stiffness(renderer_.law().material().stiffness);
    }

    void add(NearbyGeom geom)
    {
        if (tracker_)
            return tracker_->add(std::move(geom));
        const Touch touch = geom.touch_at(renderer_.tool().position);
        if (touch.depth > 0)
            touches_.push_back(touch);
    }

    bool follow()
    {
        if (!tracker_)
            return true;
        tracker_->follow();
        tracker_->remember_in(memory.draft());
        memory.publish();
        return tracker_->touches(renderer_.law().view(), touches_);
    }

    /// Moves a geom by its forecast. Without one, a body in contact waits for the next step of the scene, and yields by
    /// its displacement in a step; other bodies move freely by their impulses.
    void move_on(NearbyGeom &geom, const MotionForecast &forecast, double due) const
    {
        if (forecast.predicts(geom.object()))
        {
            const Shift shift = shift_of(geom.object(), shifts_);
            geom.shift(shift.moved, shift.turned, shift.velocity, shift.spin);
        }
        else if (geom.is_in_contact())
            geom.set_step(forecast.node_length);
        else
            impulses.push(geom, due);
    }

    void end()
    {
        renderer_.relax();
        settle(parts_.clock.now());
        ended_.store(true, std::memory_order_release);
    }

    LoopParts &parts_;
    Renderer &renderer_;
    std::optional<ContactTracker> tracker_; ///< of the library's sphere
    int tool_jumps_ = 0;                    ///< of RenderedTick
    Shifts shifts_;
    std::vector<Touch> touches_;
    bool notified_of_capacity_ = false;
    std::exception_ptr error_;
    std::atomic<bool> ended_{false};
};
} // namespace ode_predictive_space::haptics

#endif
