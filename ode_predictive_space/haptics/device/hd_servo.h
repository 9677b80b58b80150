// The callback in the servo thread of OpenHaptics' HD library, and its exchange with the thread that reads and writes.

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
    std::uint64_t frame = 0;  ///< counted from 1; 0: no frame yet
    hd::Enum calibration = 0; ///< result of the first frame
    DeviceState state;
};

/// Neither waits, allocates nor throws.
/// Invariant: a frame sets zero unless the last write is recent, no pause is active, no fault has ended the servo, and rest()
/// was not called.
class HdServo
{
public:
    /// @param longest_age frames for which a written force is rendered, >= 1
    /// @param pause frames without force after an error that passes, >= 1
    HdServo(const HdLibrary &library, hd::Handle device, std::uint32_t longest_age, std::uint32_t pause)
        : library_(library), device_(device), longest_age_(longest_age), pause_(pause), age_(longest_age)
    {}

    static std::uint32_t callback(void *servo)
    {
        static_cast<HdServo *>(servo)->run_frame();
        return hd::callback_continue;
    }

    // --- For the thread that reads and writes the device

    void write(const Vector3 &force)
    {
        forces_.draft() = force;
        forces_.publish();
    }

    /// The latest frame; valid if end() has no fault after this call.
    const HdSample &read()
    {
        samples_.take();
        return samples_.latest();
    }

    void rest() { resting_.store(true, std::memory_order_release); }

    // --- For any thread

    std::uint64_t frames_at_rest() const { return frames_at_rest_.load(std::memory_order_acquire); }

    /// The error that began a pause, reported once.
    HdFault take_pause() { return begun_pause_.exchange({}, std::memory_order_acq_rel); }

    HdFault pause() const { return pause_fault_.load(std::memory_order_acquire); }

    HdFault end() const { return end_.load(std::memory_order_acquire); }

private:
    void run_frame()
    {
        library_->begin_frame(device_);
        if (calibration_ == 0)
            calibrate();
        take_state();
        const Vector3 force = force_of_this_frame();
        library_->set_doublev(hd::current_force, force.data());
        library_->end_frame(device_);

        if (const HdFault fault = library_.take_errors())
            note(fault);
        // The state of a failed frame may be invalid, so its reader gets the error, too.
        samples_.publish();
    }

    void calibrate()
    {
        calibration_ = library_->check_calibration();
        if (calibration_ == hd::calibration_needs_update)
        {
            // The arm is in place (in its inkwell, for instance), and the library waits for permission to calibrate.
            int styles = 0;
            library_->get_integerv(hd::calibration_style, &styles);
            const int first_style = styles & -styles;
            library_->update_calibration(static_cast<hd::Enum>(first_style));
            calibration_ = library_->check_calibration();
        }
    }

    void take_state()
    {
        double transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        int buttons = 0;
        HdSample &sample = samples_.draft();
        sample.frame = ++frame_;
        sample.calibration = calibration_;
        library_->get_doublev(hd::current_position, sample.state.position.data());
        library_->get_doublev(hd::current_velocity, sample.state.linear_velocity.data());
        library_->get_doublev(hd::current_transform, transform);
        library_->get_doublev(hd::current_angular_velocity, sample.state.angular_velocity.data());
        library_->get_integerv(hd::current_buttons, &buttons);
        sample.state.position *= metres_per_millimetre;
        sample.state.linear_velocity *= metres_per_millimetre;
        const Eigen::Map<const Eigen::Matrix4d> matrix(transform); // column by column, as Eigen keeps it
        sample.state.orientation = Quaternion(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())).normalized();
        sample.state.buttons = static_cast<std::uint32_t>(buttons);
    }

    Vector3 force_of_this_frame()
    {
        if (forces_.take())
            age_ = 0;
        const bool is_stale = age_ >= longest_age_;
        if (!is_stale)
            ++age_;
        const bool is_paused = pause_left_ > 0;
        if (is_paused && --pause_left_ == 0)
            pause_fault_.store({}, std::memory_order_release);
        if (resting_.load(std::memory_order_acquire))
        {
            frames_at_rest_.fetch_add(1, std::memory_order_acq_rel);
            return Vector3::Zero();
        }
        return is_stale || is_paused || end() ? Vector3(Vector3::Zero()) : forces_.latest();
    }

    void note(const HdFault &fault)
    {
        if (consequence_of(fault.code) != HdConsequence::pause)
        {
            if (!end())
                end_.store(fault, std::memory_order_release);
            return;
        }
        if (pause_left_ == 0)
            begun_pause_.store(fault, std::memory_order_release);
        pause_fault_.store(fault, std::memory_order_release);
        pause_left_ = pause_;
    }

    static constexpr double metres_per_millimetre = 1e-3;

    static_assert(std::atomic<HdFault>::is_always_lock_free, "nothing may lock in a servo");

    const HdLibrary &library_;
    const hd::Handle device_;
    const std::uint32_t longest_age_;
    const std::uint32_t pause_;

    // For the servo thread only.
    std::uint32_t age_;
    std::uint32_t pause_left_ = 0;
    std::uint64_t frame_ = 0;
    hd::Enum calibration_ = 0;

    Snapshot<HdSample> samples_;
    Snapshot<Vector3> forces_;
    std::atomic<bool> resting_{false};
    std::atomic<std::uint64_t> frames_at_rest_{0};
    std::atomic<HdFault> begun_pause_{HdFault()};
    std::atomic<HdFault> pause_fault_{HdFault()};
    std::atomic<HdFault> end_{HdFault()};
};
} // namespace ode_predictive_space::haptics

#endif
