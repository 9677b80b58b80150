// Control of the stand-in for OpenHaptics' HD library.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_HD_CONTROL_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_HD_CONTROL_H

#include <Eigen/Core>
#include <cstdint>
#include <string>

struct FakeHdPose
{
    double position[3];   ///< mm
    double velocity[3];   ///< mm/s
    double transform[16]; ///< column by column, mm
    double angular_velocity[3];
    int buttons;
};

class __attribute__((visibility("default"))) FakeHdControl
{
public:
    /// Resets the library: 1000 Hz, an arm at rest at the origin, calibrated, no errors. No scheduler may be running.
    FakeHdControl();

    /// Sets the arm's pose at the time of a frame, in s since the scheduler's start. The servo thread calls `motion`.
    void set_motion(void (*motion)(double seconds, FakeHdPose *pose));

    /// Sets the rate that the library reports, in Hz; 0 if it reports no rate.
    void set_told_rate(int rate);

    /// Sets the answers of hdCheckCalibration() before and after hdUpdateCalibration().
    void set_calibration(std::uint32_t answer, std::uint32_t answer_after_update);

    /// Lets the next `times` calls of a function, such as "hdInitDevice", put this error on the stack; -1: all calls.
    void fail(const char *function, std::uint32_t code, int internal_code, int times);

    /// Pauses the servo thread after its current frame, or from the start if no scheduler runs yet.
    void pause();

    /// Runs frames of a paused servo thread, and returns when they are done.
    void step(int frames);

    void resume();

    /// N; the force of the motors: the last one of a frame, even if no more frames follow, while the force output is on.
    Eigen::Vector3d playing() const;

    /// N; of the motors at the scheduler's last stop.
    Eigen::Vector3d playing_at_stop() const;

    /// The number of successive frames with zero force before that.
    std::uint64_t frames_without_force_at_stop() const;

    /// The functions called since the reset, in order, each followed by a blank. Those of frames and errors are left out.
    std::string calls() const;

    bool is_enabled(std::uint32_t option) const;
};

#endif
