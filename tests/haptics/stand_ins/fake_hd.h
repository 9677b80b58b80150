// Control of the stand-in for OpenHaptics' HD library.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_HD_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_HD_H

#include <cstdint>

struct FakeHdPose
{
    double position[3];   ///< mm
    double velocity[3];   ///< mm/s
    double transform[16]; ///< column by column, mm
    double angular_velocity[3];
    int buttons;
};

struct FakeHd
{
    /// Restores the state after loading: 1000 Hz, an arm at rest at the origin, calibrated, no errors. No scheduler may be
    /// running.
    void (*reset)();

    /// Sets the arm's pose at the time of a frame, in s since the scheduler's start. The servo thread calls `motion`.
    void (*set_motion)(void (*motion)(double seconds, FakeHdPose *pose));

    /// @param rate the rate of the servo thread in Hz, > 0.
    /// @param told the rate that the library reports, in Hz; 0 if it reports no rate.
    void (*set_rate)(double rate, int told);

    /// Sets the answers of hdCheckCalibration() before and after hdUpdateCalibration().
    void (*set_calibration)(std::uint32_t answer, std::uint32_t answer_after_update);

    /// Lets the next `times` calls of a function, such as "hdInitDevice", put this error on the stack; -1: all calls.
    void (*fail)(const char *function, std::uint32_t code, int internal_code, int times);

    /// Pauses the servo thread after its current frame, or from the start if no scheduler runs yet.
    void (*pause)();

    /// Runs frames of a paused servo thread, and returns when they are done.
    void (*step)(int frames);

    void (*resume)();

    std::uint64_t (*frames)();

    /// N; the force of the motors: the last one of a frame, even if no more frames follow, while the force output is on.
    void (*get_playing)(double force[3]);

    /// N; of the motors at the scheduler's last stop. @return the number of successive frames with zero force before that.
    std::uint64_t (*get_playing_at_stop)(double force[3]);

    /// The functions called since the reset, in order, each followed by a blank. Those of frames and errors are left out.
    const char *(*get_calls)();

    bool (*is_enabled)(std::uint32_t option);
};

/// Tests find this function in the loaded library by name.
extern "C" const FakeHd *fake_hd_control();

#endif
