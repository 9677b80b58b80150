#include "tests/haptics/stand_ins/fake_hd_state.h"

#include <algorithm>

namespace fake_hd
{
namespace
{
void reset()
{
    const std::lock_guard<std::mutex> lock(mutex);
    state = State();
}

void set_motion(void (*motion)(double, FakeHdPose *))
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.motion = motion;
}

void set_rate(double rate, int told)
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.rate = rate;
    state.told_rate = told;
}

void set_calibration(std::uint32_t answer, std::uint32_t answer_after_update)
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.calibration = answer;
    state.calibration_after_update = answer_after_update;
}

void fail(const char *function, std::uint32_t code, int internal_code, int times)
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.failures[function] = {{code, internal_code, device_handle}, times};
}

void pause()
{
    std::unique_lock<std::mutex> lock(mutex);
    state.is_paused = true;
    changed.wait(lock, [] { return !state.is_running || state.is_still; });
}

void step(int frames)
{
    std::unique_lock<std::mutex> lock(mutex);
    state.steps = frames;
    changed.notify_all();
    changed.wait(lock, [] { return state.steps == 0; });
}

void resume()
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.is_paused = false;
    changed.notify_all();
}

std::uint64_t frames()
{
    const std::lock_guard<std::mutex> lock(mutex);
    return state.frames;
}

void get_playing(double force[3])
{
    const std::lock_guard<std::mutex> lock(mutex);
    const Force playing = state.playing();
    std::copy(playing.begin(), playing.end(), force);
}

std::uint64_t get_playing_at_stop(double force[3])
{
    const std::lock_guard<std::mutex> lock(mutex);
    std::copy(state.force_at_stop.begin(), state.force_at_stop.end(), force);
    return state.frames_without_force_at_stop;
}

const char *get_calls()
{
    static std::string calls;
    const std::lock_guard<std::mutex> lock(mutex);
    calls = state.calls;
    return calls.c_str();
}

bool is_enabled(std::uint32_t option)
{
    const std::lock_guard<std::mutex> lock(mutex);
    return state.enabled.count(option) != 0;
}

const FakeHd control = {reset,  set_motion, set_rate,    set_calibration,     fail,      pause,     step,
                        resume, frames,     get_playing, get_playing_at_stop, get_calls, is_enabled};
} // namespace
} // namespace fake_hd

extern "C" __attribute__((visibility("default"))) const FakeHd *fake_hd_control()
{
    return &fake_hd::control;
}
