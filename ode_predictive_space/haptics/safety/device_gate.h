// Mutual exclusion of the servo and its guard in a device.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_GATE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_GATE_H

#include "ode_predictive_space/haptics/device.h"

#include <atomic>
#include <exception>
#include <limits>
#include <thread>

namespace ode_predictive_space::haptics
{
/// Ensures that two threads are never in a device at once, without waiting: a call that finds the device busy is skipped. A
/// servo that hangs in the program's part is not in the device, so the guard can set its force to zero. Then the gate blocks
/// the servo's forces until notice_closing(), because a force from before the hang must not be rendered.
class DeviceGate
{
public:
    explicit DeviceGate(Device &device) : device_(device) {}

    /// The device, for calls that need no gate.
    Device &device() const { return device_; }

    /// For the servo. @return false, with the state unchanged, when the guard is in the device. @throws DeviceError
    bool read(double time, DeviceState &state);

    /// For the servo. @return false, without writing, when the guard is in the device or has closed the gate since
    /// notice_closing(). Zero passes a closed gate, because the guard may have found the device busy. @throws DeviceError
    bool write(const Wrench &wrench);

    /// For the servo: sets zero force; closes a device that refuses. Does nothing when the guard is in the device.
    void release() noexcept;

    /// For the servo: opens the gate. @return whether the guard had closed it.
    bool notice_closing();

    /// For the guard: sets zero force, and closes the gate until notice_closing().
    /// @return false when the servo is in the device; if that persists, the driver hangs.
    /// @throws DeviceError of a device that refused and was closed.
    bool close_with_zero(double now);

    /// At the end of the program: sets zero force for good, from any thread. Waits at most 20 ms for another thread in
    /// the device, and not for this thread; then writes zero in any case.
    void shut() noexcept;

    void set_guarded(bool guarded) { guarded_.store(guarded, std::memory_order_relaxed); }
    bool is_guarded() const { return guarded_.load(std::memory_order_relaxed); }

    /// The thread that read last: the servo's.
    std::thread::id reader() const { return reader_.load(std::memory_order_relaxed); }

    /// s, on the guard's clock; when the guard set zero force last, -infinity before.
    double last_zero() const { return last_zero_.load(std::memory_order_relaxed); }

private:
    bool enter() { return !taken_.exchange(true, std::memory_order_acquire); }
    bool enter_soon();
    std::exception_ptr zero_or_close() noexcept;
    void leave() { taken_.store(false, std::memory_order_release); }
    template <typename Work> bool visit(const Work &work);

    Device &device_;
    std::atomic<bool> taken_{false}; ///< a thread is in the device
    std::atomic<bool> closed_{false};
    std::atomic<bool> shut_{false}; ///< for good
    std::atomic<bool> guarded_{false};
    std::atomic<std::thread::id> reader_{};
    std::atomic<double> last_zero_{-std::numeric_limits<double>::infinity()};
};
} // namespace ode_predictive_space::haptics

#endif
