// The state of the stand-in for OpenHaptics' HD library. It is hidden in each variant, so that they share nothing.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_HD_STATE_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_HD_STATE_H

#include "tests/haptics/stand_ins/fake_hd_control.h"

#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <vector>

namespace fake_hd
{
struct ErrorInfo
{
    std::uint32_t code;
    int internal_code;
    std::uint32_t device;
};

struct Failure
{
    ErrorInfo error;
    int times;
};

struct Scheduled
{
    std::uint32_t (*callback)(void *);
    void *data;
};

constexpr int servo_rate = 1000; // Hz
constexpr std::uint32_t device_handle = 7;
constexpr std::uint32_t invalid_handle = 0xFFFFFFFF;
constexpr std::uint32_t force_output = 0x4000;
constexpr std::uint32_t invalid_enum = 0x100;
constexpr std::uint32_t invalid_operation = 0x102;
constexpr std::uint32_t bad_handle = 0x104;
constexpr std::uint32_t frame_error = 0x402;

inline void stay_at_the_origin(double, FakeHdPose *pose)
{
    *pose = FakeHdPose{};
    for (int i = 0; i < 16; i += 5)
        pose->transform[i] = 1;
}

/// The mutex guards all of it.
struct State
{
    void (*motion)(double, FakeHdPose *) = stay_at_the_origin;
    int told_rate = servo_rate;
    std::uint32_t calibration = 0x5000;
    std::uint32_t calibration_after_update = 0x5000;
    std::map<std::string, Failure> failures;
    std::vector<ErrorInfo> errors;
    std::string calls;

    bool is_initialised = false;
    bool is_in_frame = false;
    std::set<std::uint32_t> enabled;
    FakeHdPose pose{};
    Eigen::Vector3d next_force = Eigen::Vector3d::Zero();
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    std::uint64_t frames_without_force = 0;
    Eigen::Vector3d force_at_stop = Eigen::Vector3d::Zero();
    std::uint64_t frames_without_force_at_stop = 0;

    bool is_running = false;
    bool is_paused = false;
    bool is_still = false; ///< the servo thread waits for a step or the end of the pause
    int steps = 0;
    std::uint64_t frames = 0;
    std::map<unsigned long, Scheduled> scheduled;
    unsigned long next_schedule = 1;

    Eigen::Vector3d playing() const
    {
        const bool is_on = is_initialised && enabled.count(force_output) != 0;
        return is_on ? force : Eigen::Vector3d(Eigen::Vector3d::Zero());
    }
};

inline std::mutex mutex;
inline std::condition_variable changed;
inline State state;

inline void raise(std::uint32_t code, int internal_code = 0)
{
    state.errors.push_back({code, internal_code, device_handle});
}

/// Notes a call. @return false if the test wants it to fail.
inline bool begin(const char *function, bool is_worth_a_note = true)
{
    if (is_worth_a_note)
        state.calls += std::string(function) + " ";
    const auto failure = state.failures.find(function);
    if (failure == state.failures.end() || failure->second.times == 0)
        return true;
    --failure->second.times;
    state.errors.push_back(failure->second.error);
    return false;
}
} // namespace fake_hd

#endif
