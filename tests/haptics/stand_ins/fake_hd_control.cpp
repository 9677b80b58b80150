#include "tests/haptics/stand_ins/fake_hd_state.h"

using namespace fake_hd;

FakeHdControl::FakeHdControl()
{
    const std::lock_guard<std::mutex> lock(mutex);
    state = State();
}

void FakeHdControl::set_motion(void (*motion)(double, FakeHdPose *))
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.motion = motion;
}

void FakeHdControl::set_told_rate(int rate)
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.told_rate = rate;
}

void FakeHdControl::set_calibration(std::uint32_t answer, std::uint32_t answer_after_update)
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.calibration = answer;
    state.calibration_after_update = answer_after_update;
}

void FakeHdControl::fail(const char *function, std::uint32_t code, int internal_code, int times)
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.failures[function] = {{code, internal_code, device_handle}, times};
}

void FakeHdControl::pause()
{
    std::unique_lock<std::mutex> lock(mutex);
    state.is_paused = true;
    changed.wait(lock, [] { return !state.is_running || state.is_still; });
}

void FakeHdControl::step(int frames)
{
    std::unique_lock<std::mutex> lock(mutex);
    state.steps = frames;
    changed.notify_all();
    changed.wait(lock, [] { return state.steps == 0; });
}

void FakeHdControl::resume()
{
    const std::lock_guard<std::mutex> lock(mutex);
    state.is_paused = false;
    changed.notify_all();
}

Eigen::Vector3d FakeHdControl::playing() const
{
    const std::lock_guard<std::mutex> lock(mutex);
    return state.playing();
}

Eigen::Vector3d FakeHdControl::playing_at_stop() const
{
    const std::lock_guard<std::mutex> lock(mutex);
    return state.force_at_stop;
}

std::uint64_t FakeHdControl::frames_without_force_at_stop() const
{
    const std::lock_guard<std::mutex> lock(mutex);
    return state.frames_without_force_at_stop;
}

std::string FakeHdControl::calls() const
{
    const std::lock_guard<std::mutex> lock(mutex);
    return state.calls;
}

bool FakeHdControl::is_enabled(std::uint32_t option) const
{
    const std::lock_guard<std::mutex> lock(mutex);
    return state.enabled.count(option) != 0;
}
