#include "demos/haptic/servo_log.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::demo
{
ServoLog::ServoLog(double rate, const std::string &record_file, const haptics::Capabilities &device,
                   const std::string &law, bool keep_forces)
    : ticks_per_column_(std::max(1, static_cast<int>(std::lround(rate * column_seconds)))), keep_forces_(keep_forces)
{
    if (!record_file.empty())
        recorder_ = std::make_unique<haptics::Recorder>(record_file, device, law);
}

void ServoLog::add(const haptics::RenderedTick &tick)
{
    const double force = tick.wrench.force.norm();
    ++totals_.ticks;
    totals_.force_sum += force;
    totals_.max_force = std::max(totals_.max_force, force);
    if (force > 0)
        ++totals_.ticks_with_force;
    if (recorder_)
        recorder_->add(tick.time, tick.state, tick.wrench.force);
    if (keep_forces_)
        forces_.push_back(tick.wrench.force);
    add_to_chart(force);
}

void ServoLog::add_to_chart(double force)
{
    const double now = clock_.now();
    column_.force = std::max(column_.force, force);
    totals_.forces.add(force);
    if (totals_.ticks > 1)
    {
        const double period = now - last_tick_;
        column_.period = std::max(column_.period, period);
        totals_.periods.add(period);
    }
    last_tick_ = now;
    if (totals_.ticks % static_cast<std::uint64_t>(ticks_per_column_) != 0)
        return;
    column_.compute = longest_step_.exchange(0, std::memory_order_relaxed);
    ring_.ring[ring_.made % ServoChart::columns] = column_;
    ++ring_.made;
    column_ = {};
    chart_.draft() = ring_;
    chart_.publish();
}

void ServoLog::step_took(double seconds)
{
    double longest = longest_step_.load(std::memory_order_relaxed);
    while (longest < seconds && !longest_step_.compare_exchange_weak(longest, seconds, std::memory_order_relaxed))
    {}
}

const ServoChart &ServoLog::chart()
{
    chart_.take();
    return chart_.latest();
}

void ServoLog::close()
{
    if (recorder_)
        recorder_->close();
}
} // namespace ode_predictive_space::demo
