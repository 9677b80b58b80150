#include "ode_predictive_space/haptics/loop_guard.h"

#include <limits>
#include <string>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double period = 0.001; // s
constexpr double none = -1;      // no such beat
} // namespace

LoopGuard::LoopGuard(LoopClock &clock, DeviceGate &gate, double stall_after, NoticeSink sink,
                     std::function<void()> prepare)
    : clock_(clock), gate_(gate), stall_after_(stall_after), sink_(std::move(sink)), last_beat_(none),
      stopped_beat_(none), busy_beat_(none),
      task_(clock.start({period, std::move(prepare), [this](double) { look(); }}))
{}

LoopGuard::~LoopGuard()
{
    end();
}

void LoopGuard::end()
{
    task_.reset();
    deliver_posted();
}

void LoopGuard::post(const Notice &notice)
{
    posted_.give(notice);
}

void LoopGuard::deliver(const Notice &notice) const
{
    if (sink_)
    {
        sink_(notice);
    }
}

void LoopGuard::deliver_posted()
{
    Notice notice;
    while (posted_.receive(notice))
    {
        deliver(notice);
    }
}

void LoopGuard::look()
{
    const double beat = last_beat_.load(std::memory_order_relaxed);
    const double now = clock_.now();
    if (beat != none && beat != stopped_beat_ && now - beat >= stall_after_)
    {
        stop_force(now, beat);
    }
    deliver_posted();
}

void LoopGuard::stop_force(double now, double beat)
{
    try
    {
        if (gate_.close_with_zero() == DeviceGate::Outcome::zero)
        {
            stopped_beat_ = beat;
            deliver(Notice(NoticeKind::guard, now,
                           "No force: the loop has hung for too long in the program's part of it."));
        }
        else if (busy_beat_ != beat)
        {
            busy_beat_ = beat;
            deliver(
                Notice(NoticeKind::guard, now,
                       "The loop hangs in the device's driver: nobody but the device itself can take its force away."));
        }
    }
    catch (const std::exception &error)
    {
        stopped_beat_ = beat;
        deliver(Notice(NoticeKind::guard, now,
                       "The loop hangs, and the device takes no zero force: " + std::string(error.what())));
    }
}
} // namespace ode_predictive_space::haptics
