// A tick of the hand's side: read, law, safety, write, and what there is to tell. How it is set up: renderer_setup.cpp.

#include "ode_predictive_space/haptics/renderer.h"

#include "ode_predictive_space/haptics/contact/contact_manifold.h"
#include "ode_predictive_space/haptics/contact_birth.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double try_again_after = 0.1;    // s
constexpr double shortest_silence = 0.004; // s
constexpr double periods_of_silence = 4;
constexpr double tell_again_after = 1; // s
constexpr double longest_gap = 0.5;    // s; after that, a device that answers again can be anywhere
constexpr double longest_doubt = 0.01; // s; after that, a device that tells nonsense is one that does not answer
constexpr double jump = 10;            // times the maximum of speed
constexpr const char *unknown_exception = "The device has thrown something that is no std::exception.";

bool is_finite(const DeviceState &state)
{
    return std::isfinite(state.time) && state.position.allFinite() && state.orientation.coeffs().allFinite() &&
           state.linear_velocity.allFinite() && state.angular_velocity.allFinite();
}

/// Beyond its workspace by a metre and by twice its size: where no device can be, even one whose workspace is told too small.
bool is_far_off(const DeviceState &state, const Eigen::AlignedBox3d &workspace)
{
    return !workspace.isEmpty() &&
           workspace.exteriorDistance(state.position) > std::max(1.0, 2 * workspace.diagonal().norm());
}

bool is_held(const std::optional<unsigned> &button, const DeviceState &state)
{
    return button && *button < 32 && ((state.buttons >> *button) & 1U) != 0;
}

/// What makes the safety stage take the force away, or less of it than one would notice.
constexpr SafetyAction worth_telling[] = {SafetyAction::not_finite, SafetyAction::too_fast, SafetyAction::waiting,
                                          SafetyAction::no_axes, SafetyAction::clamped};
} // namespace

enum class Renderer::Topic
{
    contact,
    material,
    jump,
    safety,                                  ///< and one for each of its actions
    watchdog = safety + safety_action_count, ///< and one for each of its reasons
    count = watchdog + watchdog_reason_count
};

void Renderer::read(double time, double clock_time)
{
    tick_.time = time;
    clock_time_ = clock_time;
    guard_acted_ = gate_.notice_closing();
    if (guard_acted_ || relaxed_)
    {
        begin_anew();
    }
    const bool answered = answers_;
    answers_ = time >= next_try_ && read_device(time);
    if (!answers_)
    {
        return;
    }
    if (!answered)
    {
        come_back();
    }
    if (failed_)
    {
        failed_ = false;
        tell(NoticeKind::device, gate_.device().capabilities().name + " answers again; the force comes back slowly.");
    }
    if (!(time - last_answer_ <= longest_gap))
    {
        ++tick_.tool_jumps;
    }
    last_answer_ = time;
    move_clutch();
    tick_.tool = mapping_.to_scene(tick_.state);
}

// Where the clutch is let go, the tool may be deep in something: no force jumps at the hand.
void Renderer::move_clutch()
{
    const bool was_held = mapping_.clutched();
    mapping_.clutch(is_held(settings_.clutch_button, tick_.state), tick_.state);
    if (was_held && !mapping_.clutched())
    {
        safety_.reset();
    }
}

bool Renderer::read_device(double time)
{
    try
    {
        DeviceState state = tick_.state;
        if (!gate_.read(time, state))
        {
            return answers_; // the guard is in it, just now: what it told before will do
        }
        if (!is_finite(state))
        {
            doubt("The device tells a position, a velocity or a time that is not a number.");
            return false;
        }
        if (is_far_off(state, gate_.device().capabilities().workspace))
        {
            doubt("The device tells a position far outside of its workspace.");
            return false;
        }
        if (is_silent(state, time))
        {
            fail("The device has told nothing new for too long.");
            return false;
        }
        measure_delay(time - state.time);
        follow(state);
        return true;
    }
    catch (const std::exception &error)
    {
        fail(error.what());
        return false;
    }
    catch (...)
    {
        fail(unknown_exception);
        return false;
    }
}

/// What is rendered from now on is as soft as the delay wants it: rendered() goes by that. The law itself is not changed.
void Renderer::measure_delay(double age)
{
    const double rate = std::min(gate_.device().capabilities().rate, settings_.rate);
    const double before = delay();
    if (!delay_meter_.note(age, rate > 0 ? 1 / rate : 0) || delay() <= before)
    {
        return;
    }
    const Material material = law_->material();
    const StabilityVerdict verdict =
        check_stability(gate_.device().capabilities(), rendering(material.stiffness, material.damping));
    if (verdict.outcome != StabilityOutcome::fine)
    {
        tell(NoticeKind::stability, verdict.reason);
    }
}

void Renderer::follow(DeviceState state)
{
    motion_.follow(state);
    tick_.state = state;
    if (motion_.speed() > jump * safety_.limits().max_speed)
    {
        ++tick_.tool_jumps;
        begin_anew();
        tell_once_a_second(Topic::jump, NoticeKind::device,
                           "No force until the probe is free: the device's position has jumped.");
    }
}

bool Renderer::is_silent(const DeviceState &state, double time)
{
    if (state.time != last_state_time_)
    {
        last_state_time_ = state.time;
        last_news_ = time;
    }
    const double rate = std::min(gate_.device().capabilities().rate, settings_.rate);
    return time - last_news_ > std::max(shortest_silence, periods_of_silence / rate);
}

void Renderer::fail(std::string_view why)
{
    answers_ = false;
    next_try_ = tick_.time + try_again_after;
    release_device();
    if (!failed_)
    {
        failed_ = true;
        tell(NoticeKind::device, "No force: " + std::string(why));
    }
}

/// Of one state that cannot be: the next may be right again, and the hand still lean on what it leant on.
void Renderer::doubt(std::string_view why)
{
    if (!failed_)
    {
        doubted_since_ = tick_.time;
    }
    fail(why);
    if (tick_.time - doubted_since_ < longest_doubt)
    {
        next_try_ = tick_.time;
    }
}

void Renderer::come_back()
{
    if (tick_.time - doubted_since_ <= longest_doubt)
    {
        safety_.restart_ramp();
    }
    else
    {
        begin_anew();
    }
}

// Zero, before anything else that might fail.
void Renderer::release_device() noexcept
{
    split_.clear();
    try
    {
        gate_.write(Wrench());
    }
    catch (...)
    {
        gate_.close_device();
    }
}

void Renderer::begin_anew()
{
    relaxed_ = false;
    safety_.reset();
    law_->reset();
    manifold_->reset();
    motion_.forget();
    split_.clear();
    if (passivity_)
    {
        passivity_->reset();
    }
}

void Renderer::relax() noexcept
{
    release_device();
    relaxed_ = true;
}

void Renderer::render(const std::vector<Touch> &touches, bool all_known, double dt)
{
    feel(touches, dt);
    law_->forces(tick_.tool, felt_, dt, forces_);
    Wrench wished;
    wished.force = sum_of(forces_);
    if (!all_known)
    {
        wished.force.setConstant(std::numeric_limits<double>::quiet_NaN());
        tell_once_a_second(Topic::contact, NoticeKind::contact,
                           "No force: a contact of the probe, or the velocity of what it touches, is not a number.");
    }
    const Vector3 given = write(wished, dt).force;
    if (given.isZero(0))
    {
        split_.clear();
    }
    else
    {
        split_.split(felt_, forces_, given);
    }
    close_tick(wished.force, given);
}

/// The touches as they are rendered: with what the device can render of their materials.
void Renderer::feel(const std::vector<Touch> &touches, double dt)
{
    const Material own = rendered(law_->material());
    felt_ = touches;
    const TouchView view = law_->view();
    manifold_->recognise(tick_.tool.position, view, dt, felt_);
    const ContactBirth birth(tick_.tool, std::max(dt, 1 / settings_.physics_rate));
    manifold_->let_rise(birth, safety_.engaged(), dt, felt_);
    manifold_->solve(tick_.tool.position, view, felt_);
    for (Touch &touch : felt_)
    {
        if (!touch.material)
        {
            touch.material = own;
            continue;
        }
        const Material asked = *touch.material;
        touch.material = rendered(asked);
        if (touch.material->stiffness < asked.stiffness || touch.material->damping < asked.damping)
        {
            tell_once_a_second(Topic::material, NoticeKind::stability,
                               "A material is softer or less damped than asked for: the device cannot render more.");
        }
    }
}

Wrench Renderer::render(const VirtualCoupling &coupling, const ToolState &body, double dt)
{
    const Wrench wished = softened(coupling).on_device(tick_.tool, body);
    Wrench given = write(wished, dt);
    if (gate_.device().capabilities().force_axes < 6 && answers_)
    {
        given.torque = watchdog_->factor() * wished.torque;
    }
    close_tick(wished.force, given.force);
    return opposite(given);
}

/// @return what was written, in the scene's frame.
Wrench Renderer::write(const Wrench &wished, double dt)
{
    watchdog_->device_answered(answers_);
    watchdog_->servo_ticked(clock_time_);
    const Wrench written = answers_ ? delivered(limited(wished, dt)) : Wrench();
    tell_of_watchdog();
    tell_what_was_held_back(tell_again_after);
    if (passivity_)
    {
        passivity_->written(written.force);
    }
    const WorkspacePlacement &placement = mapping_.placement();
    tick_.wrench = written;
    return {placement.rotation * written.force / placement.force_scale,
            placement.rotation * written.torque / placement.force_scale};
}

Wrench Renderer::limited(const Wrench &wished, double dt)
{
    Wrench at_device = mapping_.to_device(wished);
    if (passivity_ && !mapping_.clutched())
    {
        passivity_->set_delay(static_cast<int>(std::lround(
            std::min(1.0, delay() / dt / PassivityController::most_delay) * PassivityController::most_delay)));
        at_device.force = passivity_->control(tick_.state, at_device.force, dt);
    }
    Vector3 velocity = tick_.state.linear_velocity;
    if (motion_.speed() > safety_.limits().max_speed) // whatever the device tells
    {
        velocity = motion_.speed() * Vector3::UnitX();
    }
    Wrench safe = safety_.limit(at_device, velocity, tick_.time, watchdog_->factor());
    tell_of_safety();
    return safe;
}

/// @return zero when it could not be.
Wrench Renderer::delivered(const Wrench &safe)
{
    if (gate_.device().capabilities().force_axes == 0)
    {
        return safe;
    }
    try
    {
        if (gate_.write(safe))
        {
            return safe;
        }
    }
    catch (const std::exception &error)
    {
        fail(error.what());
    }
    catch (...)
    {
        fail(unknown_exception);
    }
    return {};
}

void Renderer::close_tick(const Vector3 &wished, const Vector3 &force)
{
    tick_.wished = wished;
    tick_.force = force;
    tick_.allowance = watchdog_->factor();
    tick_.device_answers = answers_;
    tick_.saturated = answers_ && safety_.report().did(SafetyAction::clamped);
    if (recorder_)
    {
        recorder_(tick_);
    }
}

void Renderer::tell_of_safety()
{
    for (const SafetyAction action : worth_telling)
    {
        if (safety_.report().began(action))
        {
            const auto topic = static_cast<int>(Topic::safety) + static_cast<int>(action);
            tell_once_a_second(static_cast<Topic>(topic), NoticeKind::safety, explanation_of(action));
        }
    }
}

// A device that does not answer has been told of, and who asked for a stop knows.
void Renderer::tell_of_watchdog()
{
    const WatchdogReason reason = watchdog_->reason();
    const bool worth = reason == WatchdogReason::physics_stale || reason == WatchdogReason::servo_late;
    if (worth && reason != last_reason_ && !guard_acted_) // of that, the guard has told
    {
        const auto topic = static_cast<int>(Topic::watchdog) + static_cast<int>(reason);
        tell_once_a_second(static_cast<Topic>(topic), NoticeKind::watchdog, explanation_of(reason));
    }
    last_reason_ = reason;
}

void Renderer::tell_once_a_second(Topic topic, NoticeKind kind, std::string_view sentence)
{
    static_assert(static_cast<std::size_t>(Topic::count) <= most_topics);
    Told &told = told_[static_cast<std::size_t>(topic)];
    if (tick_.time - told.last >= tell_again_after)
    {
        told.last = tick_.time;
        tell(kind, sentence);
        return;
    }
    ++told.times;
    ++held_back_;
    told.notice = Notice(kind, tick_.time, sentence);
}

void Renderer::tell_held_back()
{
    tell_what_was_held_back(0);
}

void Renderer::tell_what_was_held_back(double quiet_for)
{
    for (Told &told : told_)
    {
        if (told.times == 0 || tick_.time - told.last < quiet_for)
        {
            continue;
        }
        std::array<char, std::tuple_size_v<decltype(Notice::text)>> text;
        std::snprintf(text.data(), text.size(), "%s (%d more times, the last at %.3f s)", told.notice.text.data(),
                      told.times, told.notice.time);
        told.times = 0;
        told.last = tick_.time;
        tell(told.notice.kind, text.data());
    }
}

void Renderer::tell(NoticeKind kind, std::string_view sentence) const
{
    if (settings_.notice)
    {
        settings_.notice(Notice(kind, tick_.time, sentence));
    }
}
} // namespace ode_predictive_space::haptics
