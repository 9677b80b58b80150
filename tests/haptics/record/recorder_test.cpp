#include "ode_predictive_space/haptics/device/random.h"
#include "ode_predictive_space/haptics/recording.h"
#include "tests/haptics/support/allocation_count.h"
#include "tests/haptics/support/child_program.h"
#include "tests/support/error_of.h"
#include "tests/support/scratch.h"

#include <cmath>
#include <exception>
#include <thread>

namespace ode_predictive_space::haptics
{
namespace
{
using Flush = Recorder::Flush;

Capabilities any_device()
{
    Capabilities device;
    device.name = "a device";
    return device;
}

RecordedTick random_tick(Random &random, double time)
{
    RecordedTick tick;
    tick.state.time = time;
    tick.state.position = random.in_box(Vector3::Ones());
    tick.state.orientation = random.orientation();
    tick.state.linear_velocity = random.in_box(Vector3::Ones());
    tick.state.angular_velocity = random.in_box(Vector3::Ones());
    tick.state.buttons = static_cast<std::uint32_t>(random.bits());
    tick.force = random.in_box(Vector3::Ones());
    return tick;
}

void expect_equal(const RecordedTick &a, const RecordedTick &b)
{
    EXPECT_EQ(a.state.time, b.state.time);
    EXPECT_EQ(a.state.position, b.state.position);
    EXPECT_EQ(a.state.orientation.coeffs(), b.state.orientation.coeffs());
    EXPECT_EQ(a.state.linear_velocity, b.state.linear_velocity);
    EXPECT_EQ(a.state.angular_velocity, b.state.angular_velocity);
    EXPECT_EQ(a.state.buttons, b.state.buttons);
    EXPECT_EQ(a.force, b.force);
}

bool add(Recorder &recorder, double time)
{
    return recorder.add(time, DeviceState(), Vector3(time, 0, 0));
}

Recording recording_of_one_tick(const Capabilities &device, const std::string &law = {})
{
    const ScratchFile file;
    Recorder recorder(file.path(), device, law, Flush::by_caller);
    add(recorder, 0);
    recorder.close();
    return read_recording(file.path());
}

TEST(Recorder, WhatIsReadIsWhatWasRecordedBitByBit)
{
    const ScratchFile file;
    Random random(1);
    std::vector<RecordedTick> ticks;
    {
        Recorder recorder(file.path(), any_device(), Flush::by_caller, 1000);
        for (int i = 0; i < 1000; ++i)
        {
            ticks.push_back(random_tick(random, 1e5 + i / 3.0));
            ticks.back().force *= std::pow(10.0, i % 600 - 300);
            ASSERT_TRUE(recorder.add(ticks.back().state.time, ticks.back().state, ticks.back().force));
        }
        recorder.close();
        EXPECT_NO_THROW(recorder.close()) << "again";
        EXPECT_EQ(recorder.lost(), 0u);
        EXPECT_EQ(recorder.recorded(), 1000u);
    }
    const Recording recording = read_recording(file.path());
    EXPECT_TRUE(recording.has_forces);
    EXPECT_TRUE(recording.has_velocities);
    ASSERT_EQ(recording.ticks.size(), ticks.size());
    for (std::size_t i = 0; i < ticks.size(); ++i)
        expect_equal(recording.ticks[i], ticks[i]);
}

/// Each write to /dev/full fails as on a full disk.
TEST(Recorder, OnAFullDiskSaysSoFromTheNextTickOn)
{
    for (const Flush flush : {Flush::by_caller, Flush::by_itself})
    {
        Recorder recorder("/dev/full", any_device(), flush);
        int tick = 0;
        int taken = 0;
        for (; tick < 10; ++tick)
            taken += add(recorder, tick) ? 1 : 0;
        if (flush == Flush::by_caller)
        {
            EXPECT_EQ(taken, 10);
            EXPECT_THROW(recorder.flush(), DeviceError);
            EXPECT_FALSE(add(recorder, tick++));
        }
        else
        {
            for (; add(recorder, tick); ++tick) // slower than the thread writes, so that the buffer never is full
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            ++tick;
        }
        EXPECT_EQ(recorder.lost(), static_cast<std::size_t>(tick)) << "also those that were waiting";
        EXPECT_EQ(recorder.recorded(), 0U);
        EXPECT_FALSE(add(recorder, tick));
        EXPECT_THROW(recorder.close(), DeviceError);
    }
}

TEST(Recorder, CutsANameThatTheReaderWouldNotTake)
{
    Capabilities device;
    device.name = std::string(2 * longest_recorded_line, 'n');
    const std::string name = recording_of_one_tick(device).device->name;
    EXPECT_EQ(name, device.name.substr(0, name.size()));
    EXPECT_GT(name.size(), longest_recorded_line / 2);
}

TEST(Recorder, KeepsWhatTheDeviceCanDo)
{
    Capabilities device;
    device.name = "two\nlines of name";
    device.input_axes = 6;
    device.max_force = 1 / 3.0;
    device.max_stiffness = 700;
    device.max_damping = 0.1;
    device.rate = 4000;
    device.delay = 1 / 300.0;
    device.workspace = {Vector3(-0.1, -0.2, -0.3), Vector3(0.1, 0.2, 1 / 7.0)};
    const Recording recording = recording_of_one_tick(device);
    ASSERT_TRUE(recording.device);
    EXPECT_EQ(recording.device->name, "two lines of name");
    EXPECT_EQ(recording.device->input_axes, 6);
    EXPECT_EQ(recording.device->force_axes, 3);
    EXPECT_EQ(recording.device->max_force, 1 / 3.0);
    EXPECT_EQ(recording.device->max_stiffness, 700);
    EXPECT_EQ(recording.device->max_damping, 0.1);
    EXPECT_EQ(recording.device->rate, 4000);
    EXPECT_EQ(recording.device->delay, 1 / 300.0);
    EXPECT_EQ(recording.device->workspace.min(), Vector3(-0.1, -0.2, -0.3));
    EXPECT_EQ(recording.device->workspace.max(), Vector3(0.1, 0.2, 1 / 7.0));
}

TEST(Recorder, KeepsTheNameOfTheLaw)
{
    for (const std::string law : {"proxy", "penalty", ""})
    {
        const Recording recording = recording_of_one_tick(any_device(), law);
        EXPECT_EQ(recording.law, law);
        EXPECT_EQ(recording.ticks.size(), 1U);
    }
}

TEST(Recorder, AFullBufferLosesTicksAndSaysHowManyAndWhere)
{
    const ScratchFile file;
    Recorder recorder(file.path(), any_device(), Flush::by_caller, 10);
    for (int i = 0; i < 13; ++i)
        EXPECT_EQ(add(recorder, i), i < 10);
    EXPECT_EQ(recorder.lost(), 3u);
    recorder.flush();
    for (int i = 13; i < 25; ++i)
        EXPECT_EQ(add(recorder, i), i < 23) << "there was room again";
    recorder.close();
    EXPECT_EQ(recorder.lost(), 5u);
    const std::string content = file.text();
    const std::size_t first = content.find("# 3 ticks are missing here");
    const std::size_t second = content.find("# 2 ticks are missing here");
    ASSERT_NE(first, std::string::npos);
    ASSERT_NE(second, std::string::npos);
    EXPECT_LT(content.find("\n9 "), first);
    EXPECT_GT(content.find("\n13 "), first);
    EXPECT_LT(content.find("\n22 "), second);
    EXPECT_EQ(read_recording(file.path()).ticks.size(), 20u);
}

TEST(Recorder, LosesWhatCouldNotBeReadBack)
{
    const ScratchFile file;
    Recorder recorder(file.path(), any_device(), Flush::by_caller);
    const double nan = std::nan("");
    EXPECT_TRUE(add(recorder, 1));
    EXPECT_FALSE(add(recorder, 1)) << "not later";
    EXPECT_FALSE(add(recorder, nan));
    EXPECT_FALSE(recorder.add(2, DeviceState(), Vector3(0, nan, 0)));
    DeviceState state;
    state.position.x() = nan;
    EXPECT_FALSE(recorder.add(3, state, Vector3::Zero()));
    state.position.x() = 0;
    state.orientation.coeffs().setZero();
    EXPECT_FALSE(recorder.add(4, state, Vector3::Zero()));
    for (Vector3 DeviceState::*velocity : {&DeviceState::linear_velocity, &DeviceState::angular_velocity})
    {
        DeviceState fast;
        (fast.*velocity).z() = nan;
        EXPECT_FALSE(recorder.add(4, fast, Vector3::Zero()));
    }
    EXPECT_FALSE(recorder.add(std::numeric_limits<double>::infinity(), DeviceState(), Vector3::Zero()));
    EXPECT_TRUE(add(recorder, 5));
    recorder.close();
    EXPECT_EQ(recorder.lost(), 8u);
    EXPECT_EQ(read_recording(file.path()).ticks.size(), 2u);
}

TEST(Recorder, WritesByItselfWhileTheLoopRuns)
{
    const ScratchFile file;
    Recorder recorder(file.path(), any_device(), Flush::by_itself, 1000);
    int time = 0;
    for (int added = 0; added < 5000;)
    {
        ++time;
        if (add(recorder, time))
            ++added;
        else
            std::this_thread::yield();
    }
    recorder.close();
    const Recording recording = read_recording(file.path());
    ASSERT_EQ(recording.ticks.size(), 5000u);
    EXPECT_EQ(recorder.lost(), static_cast<std::size_t>(time) - 5000);
    for (const RecordedTick &tick : recording.ticks)
        ASSERT_EQ(tick.force.x(), tick.state.time) << "no tick is mixed with another";
}

TEST(Recorder, AddingNeedsNoMemory)
{
    const ScratchFile file;
    Recorder recorder(file.path(), any_device(), Flush::by_caller, 1000);
    const std::uint64_t before = allocation_count();
    for (int i = 0; i < 1100; ++i)
        add(recorder, i);
    EXPECT_EQ(allocation_count(), before);
    EXPECT_EQ(recorder.lost(), 100u);
}

TEST(Recorder, TheRestIsWrittenWhenItEnds)
{
    const ScratchFile file;
    {
        Recorder recorder(file.path(), any_device());
        add(recorder, 1);
    }
    EXPECT_EQ(read_recording(file.path()).ticks.size(), 1u);
}

Recorder *recorder_of_handler = nullptr;

TEST(Recorder, ATerminateHandlerMayUseTheOneThatHasThrown)
{
    const ProgramEnd end = end_of([] {
        Recorder recorder("/dev/full", any_device(), Flush::by_caller);
        recorder_of_handler = &recorder;
        std::set_terminate([] {
            try
            {
                recorder_of_handler->flush();
            }
            catch (const DeviceError &)
            {
                std::_Exit(3);
            }
        });
        add(recorder, 1);
        recorder.flush();
    });
    EXPECT_TRUE(end.exited_with(3)) << (end.hung ? "hung" : "");
}

TEST(Recorder, SaysWhyItCannotMakeTheFile)
{
    const auto error = error_of<DeviceError>([] { Recorder("/no/such/folder/run.txt", any_device()); });
    EXPECT_EQ(error.fault(), DeviceFault::missing_file);
    EXPECT_NE(std::string(error.what()).find("/no/such/folder/run.txt"), std::string::npos);
    const ScratchFile file;
    EXPECT_THROW(Recorder(file.path(), any_device(), Flush::by_caller, 0), std::invalid_argument);
}
} // namespace
} // namespace ode_predictive_space::haptics
