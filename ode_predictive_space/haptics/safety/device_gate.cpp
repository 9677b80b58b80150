#include "ode_predictive_space/haptics/safety/device_gate.h"

#include "ode_predictive_space/haptics/device/at_end.h"

#include <chrono>
#include <thread>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int most_attempts = 200;
constexpr std::chrono::microseconds between_attempts(100);

thread_local const DeviceGate *visited = nullptr; ///< the gate whose device this thread is in
} // namespace

/// @return false, without calling work, when a thread is in the device.
template <typename Work> bool DeviceGate::visit(const Work &work)
{
    if (!enter())
        return false;
    const AtEnd leaving([this, before = std::exchange(visited, this)] {
        visited = before;
        leave();
    });
    work();
    return true;
}

/// Waits for another thread, but not for this thread, which may be in the device.
bool DeviceGate::enter_soon()
{
    for (int attempt = 0; attempt < most_attempts && visited != this; ++attempt)
    {
        if (enter())
            return true;
        std::this_thread::sleep_for(between_attempts);
    }
    return false;
}

bool DeviceGate::read(double time, DeviceState &state)
{
    reader_.store(std::this_thread::get_id(), std::memory_order_relaxed);
    return visit([&] { state = device_.read(time); });
}

bool DeviceGate::write(const Wrench &wrench)
{
    bool written = false;
    visit([&] {
        // Checked inside, because the guard closes the gate inside, too.
        const bool closed = closed_.load(std::memory_order_relaxed) || shut_.load(std::memory_order_relaxed);
        if (closed && !(wrench.force.isZero(0) && wrench.torque.isZero(0)))
            return;
        device_.write(wrench);
        if (shut_.load(std::memory_order_relaxed)) // by a thread that did not wait for this one
            device_.write(Wrench());
        written = true;
    });
    return written;
}

/// @return the exception of a device that refused zero and was closed.
std::exception_ptr DeviceGate::zero_or_close() noexcept
{
    try
    {
        device_.write(Wrench());
        return nullptr;
    }
    catch (...)
    {
        device_.close();
        return std::current_exception();
    }
}

void DeviceGate::release() noexcept
{
    visit([this] { zero_or_close(); });
}

bool DeviceGate::notice_closing()
{
    return closed_.exchange(false, std::memory_order_relaxed);
}

void DeviceGate::shut() noexcept
{
    shut_.store(true, std::memory_order_relaxed);
    const bool entered = enter_soon();
    zero_or_close();
    if (entered)
        leave();
}

bool DeviceGate::close_with_zero(double now)
{
    std::exception_ptr error;
    const bool entered = visit([&] {
        closed_.store(true, std::memory_order_relaxed);
        last_zero_.store(now, std::memory_order_relaxed);
        error = zero_or_close();
    });
    if (!entered)
        closed_.store(true, std::memory_order_relaxed);
    if (error)
        std::rethrow_exception(error);
    return entered;
}
} // namespace ode_predictive_space::haptics
