// What we do in the servo thread of OpenHaptics' HD library, and the exchange with the thread that reads and writes the
// device.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_HD_SERVO_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_DEVICES_HD_SERVO_H

#include "ode_predictive_space/haptics/device/hd_library.h"
#include "ode_predictive_space/haptics/exchange.h"

#include <atomic>
#include <cstdint>

namespace ode_predictive_space::haptics
{
/// One frame of the arm, SI units; its time is not set.
struct HdSample
{
    std::uint64_t frame = 0; ///< counted from 1; 0: no frame yet
    DeviceState state;
};

/// The callback in the servo thread. It never waits, never allocates, never throws.
///
/// Invariant: a frame sets zero unless the last write is younger than the longest age, no pause is on, nothing has
/// ended the servo, and it was not asked to rest.
class HdServo
{
public:
    /// @param longest_age frames for which a written force is rendered, >= 1
    /// @param pause frames without force after an error that passes, >= 1
    HdServo(const HdLibrary &library, hd::Handle device, std::uint32_t longest_age, std::uint32_t pause);

    /// For the library to call; @param servo an HdServo.
    static std::uint32_t callback(void *servo);

    // --- Of the thread that reads and writes the device

    void write(const Vector3 &force);

    /// The latest frame. What it tells is good if there is no end() after this call.
    const HdSample &read();

    /// From now on no force.
    void rest() { resting_.store(true, std::memory_order_release); }

    // --- Of any thread

    std::uint64_t frames() const { return frames_.load(std::memory_order_acquire); }

    /// Frames since rest() in which zero was set.
    std::uint64_t frames_at_rest() const { return frames_at_rest_.load(std::memory_order_acquire); }

    /// What the library said in the first frame, 0 before that.
    hd::Enum calibration() const { return calibration_.load(std::memory_order_acquire); }

    /// The error that a pause began with, told once.
    HdFault take_pause() { return begun_pause_.exchange({}, std::memory_order_acq_rel); }

    /// The error for which no force is rendered at the moment.
    HdFault pause() const { return pause_fault_.load(std::memory_order_acquire); }

    /// The error that ended it all.
    HdFault end() const { return end_.load(std::memory_order_acquire); }

private:
    void run_frame();
    void calibrate();
    void take_state();
    Vector3 force_of_this_frame();
    void note(const HdFault &fault);

    static_assert(std::atomic<HdFault>::is_always_lock_free, "nothing may lock in a servo");

    const HdLibrary &library_;
    const hd::Handle device_;
    const std::uint32_t longest_age_;
    const std::uint32_t pause_;

    // Of the servo thread alone.
    std::uint32_t age_;
    std::uint32_t pause_left_ = 0;

    Snapshot<HdSample> samples_;
    Snapshot<Vector3> forces_;
    std::atomic<bool> resting_{false};
    std::atomic<std::uint64_t> frames_{0};
    std::atomic<std::uint64_t> frames_at_rest_{0};
    std::atomic<hd::Enum> calibration_{0};
    std::atomic<HdFault> begun_pause_{HdFault()};
    std::atomic<HdFault> pause_fault_{HdFault()};
    std::atomic<HdFault> end_{HdFault()};
};
} // namespace ode_predictive_space::haptics

#endif
