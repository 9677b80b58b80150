#include "ode_predictive_space/haptics/safety/device_link.h"

#include "ode_predictive_space/haptics/safety/open_gates.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double usual_rate = 1000;        // Hz
constexpr double try_again_after = 0.1;    // s
constexpr double shortest_silence = 0.004; // s
constexpr double periods_of_silence = 4;
constexpr double longest_gap = 0.5;    // s; after that, a device can be anywhere
constexpr double longest_doubt = 0.01; // s; after that, nonsense counts as no answer

double rate_of(const Capabilities &capabilities)
{
    return capabilities.rate > 0 ? capabilities.rate : usual_rate;
}

AtEnd opened(Device &device)
{
    if (device.status().open)
        return AtEnd();
    device.open();
    return AtEnd([&device] { device.close(); });
}

/// The reason why a state is impossible, or 0. A device may leave its workspace by up to a metre or twice its size.
const char *nonsense_in(const DeviceState &state, const Eigen::AlignedBox3d &workspace)
{
    const bool is_finite = std::isfinite(state.time) && state.position.allFinite() &&
                           state.orientation.coeffs().allFinite() && state.linear_velocity.allFinite() &&
                           state.angular_velocity.allFinite();
    if (!is_finite)
        return "The device gives a position, a velocity or a time that is not finite.";
    const bool is_far_off = !workspace.isEmpty() &&
                            workspace.exteriorDistance(state.position) > std::max(1.0, 2 * workspace.diagonal().norm());
    return is_far_off ? "The device gives a position far outside of its workspace." : nullptr;
}
} // namespace

DeviceLink::DeviceLink(Device &device, const NoticeDesk &notices)
    : gate_(device), opening_(opened(device)), notices_(notices), motion_(rate_of(device.capabilities()))
{
    open_gates::add(gate_);
}

DeviceLink::~DeviceLink()
{
    open_gates::remove(gate_);
}

bool DeviceLink::notice_guard()
{
    guard_acted_ = gate_.notice_closing();
    return guard_acted_;
}

DeviceLink::News DeviceLink::read(double time, double rate, double top_speed)
{
    time_ = time;
    const bool answered = answers_;
    answers_ = time >= next_try_ && attempt([&] {
                   DeviceState state = state_;
                   // While the guard is in the device, the former state is used.
                   return gate_.read(time_, state) ? follow(state, rate) : answered;
               });
    News news;
    if (answers_)
    {
        news.came_back = !answered;
        news.only_doubted = time - doubted_since_ <= longest_doubt;
        news.had_failed = std::exchange(failed_, false);
        news.was_away = !(time - last_answer_ <= longest_gap);
        news.has_jumped = motion_.speed() > top_speed;
        last_answer_ = time;
    }
    return news;
}

/// @return the result of the call; false after an exception, which counts as a failure.
template <typename Call> bool DeviceLink::attempt(const Call &call)
{
    try
    {
        return call();
    }
    catch (const std::exception &error)
    {
        fail(error.what());
    }
    catch (...)
    {
        fail("The device's driver has thrown an exception of an unknown type.");
    }
    return false;
}

bool DeviceLink::follow(const DeviceState &state, double rate)
{
    if (const char *const nonsense = nonsense_in(state, capabilities().workspace))
    {
        doubt(nonsense);
        return false;
    }
    if (is_silent(state, std::min(capabilities().rate, rate)))
    {
        fail("The device has given no new state for too long.");
        return false;
    }
    state_ = state;
    motion_.follow(state_);
    return true;
}

bool DeviceLink::is_silent(const DeviceState &state, double rate)
{
    if (state.time != last_state_time_)
    {
        last_state_time_ = state.time;
        last_news_ = time_;
    }
    return time_ - last_news_ > std::max(shortest_silence, periods_of_silence / rate);
}

void DeviceLink::fail(std::string_view why)
{
    answers_ = false;
    next_try_ = time_ + try_again_after;
    gate_.release(); // before anything else can fail
    if (!failed_)
    {
        failed_ = true;
        notices_.notify(NoticeKind::device, "No force: " + std::string(why));
    }
}

/// The next state may be valid again, with the hand in the same contact.
void DeviceLink::doubt(std::string_view why)
{
    if (!failed_)
        doubted_since_ = time_;
    fail(why);
    if (time_ - doubted_since_ < longest_doubt)
        next_try_ = time_;
}

Wrench DeviceLink::write(const Wrench &wrench)
{
    const bool written = capabilities().force_axes == 0 || attempt([&] { return gate_.write(wrench); });
    return written ? wrench : Wrench();
}
} // namespace ode_predictive_space::haptics
