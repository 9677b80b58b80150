#include "ode_predictive_space/haptics/safety/device_gate.h"

#include <chrono>
#include <thread>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int most_attempts = 200;
constexpr std::chrono::microseconds between_attempts(100);

thread_local const DeviceGate *visited = nullptr; ///< by this thread, which is in its device
} // namespace

class DeviceGate::Visit
{
public:
    Visit(DeviceGate &gate, User user) : gate_(gate), entered_(gate.enter(user)), visited_before_(visited)
    {
        if (entered_)
            visited = &gate;
    }
    ~Visit()
    {
        if (entered_)
        {
            visited = visited_before_;
            gate_.leave();
        }
    }
    Visit(const Visit &) = delete;
    Visit &operator=(const Visit &) = delete;

    bool entered() const { return entered_; }

private:
    DeviceGate &gate_;
    bool entered_;
    const DeviceGate *visited_before_;
};

bool DeviceGate::enter(User user)
{
    User nobody = User::none;
    return user_.compare_exchange_strong(nobody, user, std::memory_order_acquire, std::memory_order_relaxed);
}

/// Waits for another thread, but not for this one, which may be in the device itself.
bool DeviceGate::enter_soon()
{
    for (int attempt = 0; attempt < most_attempts && visited != this; ++attempt)
    {
        if (enter(User::guard))
            return true;
        std::this_thread::sleep_for(between_attempts);
    }
    return false;
}

bool DeviceGate::read(double time, DeviceState &state)
{
    reader_.store(std::this_thread::get_id(), std::memory_order_relaxed);
    const Visit visit(*this, User::servo);
    if (visit.entered())
        state = device_.read(time);
    return visit.entered();
}

bool DeviceGate::write(const Wrench &wrench)
{
    const Visit visit(*this, User::servo);
    // Looked at inside: the guard closes the gate from inside, too.
    const bool is_zero = wrench.force.isZero(0) && wrench.torque.isZero(0);
    const bool closed = closed_.load(std::memory_order_relaxed) || shut_.load(std::memory_order_relaxed);
    if (!visit.entered() || (closed && !is_zero))
        return false;
    device_.write(wrench);
    if (shut_.load(std::memory_order_relaxed)) // meanwhile, without waiting for this any longer
        device_.write(Wrench());
    return true;
}

void DeviceGate::close_device() noexcept
{
    const Visit visit(*this, User::servo);
    if (visit.entered())
        device_.close();
}

bool DeviceGate::notice_closing()
{
    return closed_.exchange(false, std::memory_order_relaxed);
}

void DeviceGate::shut() noexcept
{
    shut_.store(true, std::memory_order_relaxed);
    const bool entered = enter_soon();
    try
    {
        device_.write(Wrench());
    }
    catch (...)
    {
        device_.close();
    }
    if (entered)
        leave();
}

DeviceGate::Outcome DeviceGate::close_with_zero(double now)
{
    const Visit visit(*this, User::guard);
    closed_.store(true, std::memory_order_relaxed);
    if (!visit.entered())
        return Outcome::busy;
    last_zero_.store(now, std::memory_order_relaxed);
    zeros_.fetch_add(1, std::memory_order_release);
    try
    {
        device_.write(Wrench());
    }
    catch (...)
    {
        device_.close();
        throw;
    }
    return Outcome::zero;
}
} // namespace ode_predictive_space::haptics
