// One device, two threads: the servo's, and the guard that takes the force away when the servo hangs.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_GATE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICE_GATE_H

#include "ode_predictive_space/haptics/device.h"

#include <atomic>
#include <exception>
#include <thread>

namespace ode_predictive_space::haptics
{
/// Ensures that two threads are never in a device at once. Neither of them ever waits: a call that finds the device taken is
/// skipped. A servo loop of which the program's part hangs is not in the device; then the guard can set its force to zero.
///
/// From then on the gate is closed to the servo's forces until it has noticed: what it computed before it hung must not be
/// rendered after it.
class DeviceGate
{
public:
    /// @param device must outlive the gate.
    explicit DeviceGate(Device &device) : device_(device) {}

    /// The device behind the gate: for calls that need no gate.
    Device &device() const { return device_; }

    /// Of the servo. @return false when the guard is in the device: then state is left alone. @throws DeviceError
    bool read(double time, DeviceState &state);

    /// Of the servo. @return false when the guard is in the device, or has closed the gate since notice_closing(): then
    /// nothing is written, except that zero is always let through, as the guard may have found the device taken.
    /// @throws DeviceError
    bool write(const Wrench &wrench);

    /// Of the servo: no force; the device is closed when it refuses. Left to the guard when that is in the device.
    void release() noexcept;

    /// Of the servo: opens the gate again. @return whether the guard had closed it.
    bool notice_closing();

    /// Of the guard: no force, and the gate is closed: the force is zero until the servo has noticed.
    ///
    /// @param now s; on any clock.
    /// @return false when the servo is in the device: it does not hang in the program, or else the device's driver hangs.
    /// @throws DeviceError when the device refuses; it has been closed then.
    bool close_with_zero(double now);

    /// When the program ends: no force, and none ever again. From any thread. Another thread that is in the device is waited for,
    /// 20 ms at most; then zero is written all the same, and at once where this thread itself is in the device.
    void shut() noexcept;

    /// Whether a guard looks after this device.
    void set_guarded(bool guarded) { guarded_.store(guarded, std::memory_order_relaxed); }
    bool is_guarded() const { return guarded_.load(std::memory_order_relaxed); }

    /// The thread that read last: the servo's.
    std::thread::id reader() const { return reader_.load(std::memory_order_relaxed); }

    /// How often the guard took the force away.
    std::uint64_t zeros() const { return zeros_.load(std::memory_order_acquire); }

    /// s; when it did so last, as close_with_zero() was told.
    double last_zero() const { return last_zero_.load(std::memory_order_relaxed); }

private:
    bool enter() { return !taken_.exchange(true, std::memory_order_acquire); }
    bool enter_soon();
    std::exception_ptr zero_or_close() noexcept;
    void leave() { taken_.store(false, std::memory_order_release); }
    template <typename Work> bool visit(const Work &work);

    Device &device_;
    std::atomic<bool> taken_{false}; ///< by a thread that is in the device
    std::atomic<bool> closed_{false};
    std::atomic<bool> shut_{false}; ///< for ever
    std::atomic<bool> guarded_{false};
    std::atomic<std::thread::id> reader_{};
    std::atomic<std::uint64_t> zeros_{0};
    std::atomic<double> last_zero_{0}; ///< s
};
} // namespace ode_predictive_space::haptics

#endif
