// How tests steer the stand-in for OpenHaptics' HD library. The functions are found in the loaded library by their
// names.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_HD_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_HD_H

#include <cstdint>

/// Where the arm is, in the library's units.
struct FakeHdPose
{
    double position[3];   ///< mm
    double velocity[3];   ///< mm/s
    double transform[16]; ///< column by column, mm
    double angular_velocity[3];
    int buttons;
};

extern "C" {
/// As after loading: 1000 Hz, an arm at rest at the origin, calibrated, no errors. Not while a scheduler runs.
void fake_hd_reset();

/// The arm's pose at the time of a frame, in seconds since the scheduler was started. Called in the servo thread.
void fake_hd_set_motion(void (*motion)(double seconds, FakeHdPose *pose));

/// Of the servo thread, Hz, > 0. Also what the library tells as its rate, unless `told` is given as 0.
void fake_hd_set_rate(double rate, int told);

/// What hdCheckCalibration() answers, and what it answers after hdUpdateCalibration().
void fake_hd_set_calibration(std::uint32_t answer, std::uint32_t answer_after_update);

/// The next `times` calls of a function, "hdInitDevice", put this error on the stack; -1: all of them.
void fake_hd_fail(const char *function, std::uint32_t code, int internal_code, int times);

/// The servo thread stands still after the frame that it is in. From the start, when no scheduler runs yet.
void fake_hd_pause();

/// Runs so many frames of a servo thread that stands still, and returns when they are done.
void fake_hd_step(int frames);

/// Lets the servo thread run on.
void fake_hd_resume();

/// Frames since the scheduler was started.
std::uint64_t fake_hd_frames();

/// The force that the motors play now, N: the last that a frame set, whether frames go on or not, as long as the force
/// output is on.
void fake_hd_playing(double force[3]);

/// The force that they played when the scheduler was stopped last; and how many frames before that had set zero, one
/// after the other.
std::uint64_t fake_hd_playing_at_stop(double force[3]);

/// Names of the functions that were called since the reset, but for those of frames and errors, in their order, each
/// followed by a blank.
const char *fake_hd_calls();

/// Whether an hdEnable() option is on.
int fake_hd_is_enabled(std::uint32_t option);
}

#endif
