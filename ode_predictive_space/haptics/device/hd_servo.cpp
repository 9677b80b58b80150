#include "ode_predictive_space/haptics/device/hd_servo.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double metres_per_millimetre = 1e-3;

Quaternion rotation_of(const double (&transform)[16])
{
    // Column by column, as Eigen keeps it.
    const Eigen::Map<const Eigen::Matrix4d> matrix(transform);
    return Quaternion(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())).normalized();
}
} // namespace

HdServo::HdServo(const HdLibrary &library, hd::Handle device, std::uint32_t longest_age, std::uint32_t pause)
    : library_(library), device_(device), longest_age_(longest_age), pause_(pause), age_(longest_age)
{}

std::uint32_t HdServo::callback(void *servo)
{
    static_cast<HdServo *>(servo)->run_frame();
    return hd::callback_continue;
}

void HdServo::write(const Vector3 &force)
{
    forces_.draft() = force;
    forces_.publish();
}

const HdSample &HdServo::read()
{
    samples_.take();
    return samples_.latest();
}

void HdServo::run_frame()
{
    library_->begin_frame(device_);
    if (calibration() == 0)
        calibrate();
    take_state();
    const Vector3 force = force_of_this_frame();
    library_->set_doublev(hd::current_force, force.data());
    library_->end_frame(device_);

    if (const HdFault fault = library_.take_errors())
        note(fault);
    // What was read in a frame that went wrong may be anything: its reader gets the error, too.
    samples_.publish();
    frames_.fetch_add(1, std::memory_order_acq_rel);
}

void HdServo::calibrate()
{
    hd::Enum calibration = library_->check_calibration();
    if (calibration == hd::calibration_needs_update)
    {
        // The arm lies as it must (in its inkwell, for instance) and the library waits for leave to use that.
        int styles = 0;
        library_->get_integerv(hd::calibration_style, &styles);
        const int first_style = styles & -styles;
        library_->update_calibration(static_cast<hd::Enum>(first_style));
        calibration = library_->check_calibration();
    }
    calibration_.store(calibration, std::memory_order_release);
}

void HdServo::take_state()
{
    double transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    int buttons = 0;
    HdSample &sample = samples_.draft();
    sample.frame = frames() + 1;
    library_->get_doublev(hd::current_position, sample.state.position.data());
    library_->get_doublev(hd::current_velocity, sample.state.linear_velocity.data());
    library_->get_doublev(hd::current_transform, transform);
    library_->get_doublev(hd::current_angular_velocity, sample.state.angular_velocity.data());
    library_->get_integerv(hd::current_buttons, &buttons);
    sample.state.position *= metres_per_millimetre;
    sample.state.linear_velocity *= metres_per_millimetre;
    sample.state.orientation = rotation_of(transform);
    sample.state.buttons = static_cast<std::uint32_t>(buttons);
}

Vector3 HdServo::force_of_this_frame()
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

void HdServo::note(const HdFault &fault)
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
} // namespace ode_predictive_space::haptics
