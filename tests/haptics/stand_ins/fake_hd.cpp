// A stand-in for OpenHaptics' HD library: a scheduler thread, an arm whose motion the test sets, and errors on demand.

#include "tests/haptics/stand_ins/fake_hd_state.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>

using namespace fake_hd;

namespace
{
std::thread servo_thread;

/// Runs a frame of all scheduled callbacks, without the mutex because they call this library.
void run_callbacks(const std::map<unsigned long, Scheduled> &scheduled)
{
    for (const auto &each : scheduled)
    {
        if (each.second.callback(each.second.data) == 0)
        {
            const std::lock_guard<std::mutex> lock(mutex);
            state.scheduled.erase(each.first);
        }
    }
}

void run_scheduler()
{
    std::unique_lock<std::mutex> lock(mutex);
    while (state.is_running)
    {
        if (state.is_paused && state.steps == 0)
        {
            state.is_still = true;
            changed.notify_all();
            changed.wait(lock, [] { return !state.is_running || !state.is_paused || state.steps > 0; });
            state.is_still = false;
            continue;
        }
        const auto scheduled = state.scheduled;
        lock.unlock();
        run_callbacks(scheduled);
        lock.lock();
        ++state.frames;
        if (state.steps > 0)
            --state.steps;
        changed.notify_all();
        if (!state.is_paused)
            changed.wait_for(lock, std::chrono::duration<double>(1.0 / servo_rate), [] { return !state.is_running; });
    }
}
} // namespace

#pragma GCC visibility push(default)

extern "C" {

std::uint32_t hdInitDevice(const char *configuration)
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (!begin("hdInitDevice") || state.is_initialised ||
        (configuration != nullptr && std::strcmp(configuration, "Left Arm") != 0))
    {
        if (state.errors.empty())
            raise(bad_handle, -1);
        return invalid_handle;
    }
    state.is_initialised = true;
    return device_handle;
}

void hdDisableDevice(std::uint32_t)
{
    const std::lock_guard<std::mutex> lock(mutex);
    begin("hdDisableDevice");
    state.is_initialised = false;
}

void hdMakeCurrentDevice(std::uint32_t device)
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (begin("hdMakeCurrentDevice", false) && device != device_handle)
        raise(bad_handle);
}

void hdBeginFrame(std::uint32_t device)
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (!begin("hdBeginFrame", false))
        return;
    if (device != device_handle || !state.is_initialised)
        raise(bad_handle);
    state.is_in_frame = true;
    state.motion(static_cast<double>(state.frames) / servo_rate, &state.pose);
}

void hdEndFrame(std::uint32_t)
{
    const std::lock_guard<std::mutex> lock(mutex);
    begin("hdEndFrame", false);
    if (!state.is_in_frame)
        raise(frame_error);
    state.is_in_frame = false;
    state.force = state.next_force;
    state.frames_without_force = state.force.isZero(0) ? state.frames_without_force + 1 : 0;
}

ErrorInfo hdGetError()
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (state.errors.empty())
        return {0, 0, invalid_handle};
    const ErrorInfo newest = state.errors.back();
    state.errors.pop_back();
    return newest;
}

const char *hdGetErrorString(std::uint32_t code)
{
    return code == 0x200 ? "The motors are warm." : "The stand-in's words.";
}

const char *hdGetString(std::uint32_t name)
{
    return name == 0x2501 ? "Stand-in Arm" : nullptr;
}

void hdEnable(std::uint32_t option)
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (begin("hdEnable"))
        state.enabled.insert(option);
}

void hdDisable(std::uint32_t option)
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (begin("hdDisable"))
        state.enabled.erase(option);
}

void hdGetDoublev(std::uint32_t name, double *values)
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (!begin("hdGetDoublev", false))
        return;
    static constexpr double workspace[6] = {-80, -60, -40, 80, 120, 50};
    const auto give = [values](const double *from, int count) { std::copy(from, from + count, values); };
    switch (name)
    {
    case 0x2050:
        return give(state.pose.position, 3);
    case 0x2051:
        return give(state.pose.velocity, 3);
    case 0x2052:
        return give(state.pose.transform, 16);
    case 0x2053:
        return give(state.pose.angular_velocity, 3);
    case 0x2551:
        return give(workspace, 6);
    case 0x2602:
        *values = 0.5;
        return;
    case 0x2603:
        *values = 3.3;
        return;
    case 0x2609:
        *values = 0.003;
        return;
    default:
        raise(invalid_enum);
    }
}

void hdGetIntegerv(std::uint32_t name, int *values)
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (!begin("hdGetIntegerv", false))
        return;
    switch (name)
    {
    case 0x2000:
        *values = state.pose.buttons;
        return;
    case 0x2555:
        *values = 4 | 8;
        return;
    case 0x2600:
        *values = state.told_rate;
        return;
    default:
        raise(invalid_enum);
    }
}

void hdSetDoublev(std::uint32_t name, const double *values)
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (!begin("hdSetDoublev", false))
        return;
    if (name != 0x2700)
        raise(invalid_enum);
    else if (!state.is_in_frame)
        raise(frame_error);
    else
        state.next_force = Eigen::Vector3d(values);
}

void hdStartScheduler()
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (!begin("hdStartScheduler"))
        return;
    state.is_running = true;
    state.frames = 0;
    servo_thread = std::thread(run_scheduler);
}

void hdStopScheduler()
{
    {
        const std::lock_guard<std::mutex> lock(mutex);
        begin("hdStopScheduler");
        state.is_running = false;
        changed.notify_all();
    }
    if (servo_thread.joinable())
        servo_thread.join();
    const std::lock_guard<std::mutex> lock(mutex);
    state.force_at_stop = state.playing();
    state.frames_without_force_at_stop = state.frames_without_force;
}

unsigned long hdScheduleAsynchronous(std::uint32_t (*callback)(void *), void *data, std::uint16_t)
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (!begin("hdScheduleAsynchronous"))
        return 0;
    state.scheduled[state.next_schedule] = {callback, data};
    return state.next_schedule++;
}

#ifndef FAKE_HD_LACKS_UNSCHEDULE
void hdUnschedule(unsigned long handle)
{
    const std::lock_guard<std::mutex> lock(mutex);
    begin("hdUnschedule");
    if (state.scheduled.erase(handle) == 0)
        raise(invalid_operation);
}
#endif

std::uint32_t hdCheckCalibration()
{
    const std::lock_guard<std::mutex> lock(mutex);
    begin("hdCheckCalibration");
    return state.calibration;
}

void hdUpdateCalibration(std::uint32_t style)
{
    const std::lock_guard<std::mutex> lock(mutex);
    if (begin("hdUpdateCalibration") && style == 4)
        state.calibration = state.calibration_after_update;
}
}

#pragma GCC visibility pop
