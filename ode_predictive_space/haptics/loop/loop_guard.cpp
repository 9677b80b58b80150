#include "ode_predictive_space/haptics/loop/loop_guard.h"

#include "ode_predictive_space/haptics/safety/notice_desk.h"
#include "ode_predictive_space/haptics/safety/open_gates.h"

#include <typeinfo>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double watch_period = 0.001;  // s
constexpr double speaker_period = 0.01; // s
} // namespace

LoopGuard::LoopGuard(LoopClock &clock, DeviceGate &gate, GuardDuties duties)
    : clock_(clock), gate_(gate), duties_(std::move(duties)), notices_(std::move(duties_.sink)),
      watch_(clock.start({watch_period, duties_.prepare, [this](double) { look(); }})),
      speaker_(clock.start({speaker_period, {}, [this](double) { notices_.deliver_all(); }}))
{
    gate_.set_guarded(true);
    if (typeid(clock) != typeid(MonotonicClock) && typeid(clock) != typeid(SimulatedClock))
        clock_watch_ = machine_clock_.start({watch_period, duties_.prepare, [this](double) { look_at_clock(); }});
}

LoopGuard::~LoopGuard()
{
    end();
}

void LoopGuard::end()
{
    if (watch_) // afterwards the device's gate may be gone
        gate_.set_guarded(false);
    watch_.reset();
    speaker_.reset();
    clock_watch_.reset();
    notices_.deliver_all();
}

void LoopGuard::look()
{
    const double beat = last_beat_.load(std::memory_order_relaxed);
    const double step = scene_.last.load(std::memory_order_relaxed);
    const double now = clock_.now();
    if (beat != stopped_beat_ && now - beat >= duties_.stall_after)
        stop_force(now, beat);
    if (step != scene_.stopped && now - step >= duties_.scene_stall_after)
    {
        scene_.stopped = step;
        if (open_gates::close_unguarded(scene_.thread, now))
            notify("No force: the scene of another probe of this program has hung for too long.");
    }
    // The loop itself may be asleep, or wait for the scene.
    if (!ended_ && duties_.must_end && duties_.must_end())
        ended_ = take_force(now);
}

void LoopGuard::look_at_clock()
{
    const double now = clock_.now();
    if (now < newest_ - watch_period)
    {
        has_gone_back_ = true;
        notify("No force: the loop's clock went backwards.", Side::clock);
    }
    newest_ = now;
    if (has_gone_back_)
        has_gone_back_ = !take_force(now);
}

void LoopGuard::stop_force(double now, double beat)
{
    const bool taken = take_force(now);
    if (taken)
        stopped_beat_ = beat;
    else if (std::exchange(busy_beat_, beat) == beat)
        return; // already reported
    open_gates::close_unguarded(gate_.reader(), now);
    notify(taken ? "No force: a step of the program (collide, advance or a force law) has taken too long."
                 : "The loop hangs in the device's driver. The device may keep its last force: switch it off.");
}

void LoopGuard::notify(std::string_view sentence, Side side)
{
    const double time = duties_.time ? duties_.time() : clock_.now();
    post(Notice(NoticeKind::guard, time, sentence), side);
}

/// @return false when the device is busy, so that it has to be tried again.
bool LoopGuard::take_force(double now)
{
    try
    {
        return gate_.close_with_zero(now);
    }
    catch (...)
    {
        notify(with_reason("The device did not take a zero force and was closed"));
    }
    return true;
}
} // namespace ode_predictive_space::haptics
