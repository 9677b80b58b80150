#include "tests/haptics/stand_ins/fake_hd_state.h"

#include <algorithm>

using namespace fake_hd;

#pragma GCC visibility push(default)

extern "C" {
void fake_hd_reset()
{
    const std::lock_guard<std::mutex> lock(mutex);
    state = State();
}

void fake_hd_set_motion(void (*motion)(double, FakeHdPose *))
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.motion = motion;
}

void fake_hd_set_rate(double rate, int told)
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.rate = rate;
    state.told_rate = told;
}

void fake_hd_set_calibration(std::uint32_t answer, std::uint32_t answer_after_update)
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.calibration = answer;
    state.calibration_after_update = answer_after_update;
}

void fake_hd_fail(const char *function, std::uint32_t code, int internal_code, int times)
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.failures[function] = {{code, internal_code, device_handle}, times};
}

void fake_hd_pause()
{
    std::unique_lock<std::mutex> lock(mutex);
    state.is_paused = true;
    changed.wait(lock, [] { return !state.is_running || state.is_still; });
}

void fake_hd_step(int frames)
{
    std::unique_lock<std::mutex> lock(mutex);
    state.steps = frames;
    changed.notify_all();
    changed.wait(lock, [] { return state.steps == 0; });
}

void fake_hd_resume()
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.is_paused = false;
    changed.notify_all();
}

std::uint64_t fake_hd_frames()
{
    const std::lock_guard<std::mutex> lock(mutex);
    return state.frames;
}

void fake_hd_playing(double force[3])
{
    const std::lock_guard<std::mutex> lock(mutex);
    const Force playing = state.playing();
    std::copy(playing.begin(), playing.end(), force);
}

std::uint64_t fake_hd_playing_at_stop(double force[3])
{
    const std::lock_guard<std::mutex> lock(mutex);
    std::copy(state.force_at_stop.begin(), state.force_at_stop.end(), force);
    return state.frames_without_force_at_stop;
}

const char *fake_hd_calls()
{
    static std::string calls;
    const std::lock_guard<std::mutex> lock(mutex);
    calls = state.calls;
    return calls.c_str();
}

int fake_hd_is_enabled(std::uint32_t option)
{
    const std::lock_guard<std::mutex> lock(mutex);
    return state.enabled.count(option) != 0 ? 1 : 0;
}
}

#pragma GCC visibility pop
