#include "ode_predictive_space/haptics/loop/loop_guard.h"

#include "ode_predictive_space/haptics/safety/open_gates.h"
#include "tests/haptics/support/faulty_device.h"
#include "tests/haptics/support/probe_world.h"
#include "tests/haptics/support/scripted_device.h"

#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
class LoopGuardTest : public testing::Test
{
protected:
    LoopGuardTest()
        : device_([](double) { return Vector3(Vector3::Zero()); }), faulty_(device_), log_(faulty_, clock_), gate_(log_)
    {
        log_.open();
        log_.read(0);
        push();
    }

    void push()
    {
        Wrench wrench;
        wrench.force.z() = 1;
        gate_.write(wrench);
    }

    GuardDuties duties()
    {
        GuardDuties duties;
        duties.sink = notices_.sink();
        return duties;
    }

    double force() const { return log_.force_at(clock_.now()).z(); }

    SimulatedClock clock_;
    NoticeList notices_;
    ScriptedDevice device_;
    FaultyDevice faulty_;
    WriteLog log_;
    DeviceGate gate_;
};

TEST_F(LoopGuardTest, ADeviceThatTakesNoZeroIsClosedAndToldOf)
{
    LoopGuard guard(clock_, gate_, duties());
    guard.beat(clock_.now());
    faulty_.break_now(Breakage::lost);
    clock_.advance(0.1);
    EXPECT_FALSE(device_.status().open);
    EXPECT_NE(notices_.text(NoticeKind::guard).find("the plug has been pulled"), std::string::npos);
}

TEST_F(LoopGuardTest, ADeviceIsUnguardedAfterTheEnd)
{
    LoopGuard guard(clock_, gate_, duties());
    EXPECT_TRUE(gate_.is_guarded());
    guard.end();
    EXPECT_FALSE(gate_.is_guarded());
}

TEST_F(LoopGuardTest, EachHangOfTheSceneTakesTheForceOfAnotherProbeInItsThread)
{
    ScriptedDevice device([](double) { return Vector3(Vector3::Zero()); });
    DeviceGate gate(device);
    open_gates::add(gate);
    device.open();
    DeviceState state;
    gate.read(0, state);
    GuardDuties duties = this->duties();
    duties.scene_stall_after = 0.005;
    LoopGuard guard(clock_, gate_, std::move(duties));
    for (const int hang : {1, 2})
    {
        gate.notice_closing();
        EXPECT_TRUE(gate.write(haptics::push(1)));
        guard.begin_step(clock_.now());
        clock_.advance(0.1);
        EXPECT_TRUE(device.last_wrench().force.isZero(0));
        EXPECT_EQ(notices_.count(NoticeKind::guard), hang);
    }
    open_gates::remove(gate);
}

TEST_F(LoopGuardTest, ASinkThatHasThrownIsNotCalledAgain)
{
    GuardDuties duties;
    int calls = 0;
    duties.sink = [&](const Notice &) {
        ++calls;
        throw std::runtime_error("the terminal is gone");
    };
    LoopGuard guard(clock_, gate_, std::move(duties));
    for (int i = 0; i < 2; ++i)
        guard.post(Notice(NoticeKind::safety, 0, "something"));
    clock_.advance(0.02);
    EXPECT_TRUE(guard.sink_failed());
    EXPECT_EQ(calls, 1);
}

class HangingDriver : public FaultyDevice
{
public:
    HangingDriver(Device &device, SimulatedClock &clock) : FaultyDevice(device), clock_(clock) {}

    void write(const Wrench &wrench) override
    {
        clock_.advance(std::exchange(hang_, 0));
        FaultyDevice::write(wrench);
    }

private:
    SimulatedClock &clock_;
    double hang_ = 0.5; // s
};

TEST_F(LoopGuardTest, ADriverThatHangsIsToldOfOnce)
{
    HangingDriver driver(device_, clock_);
    DeviceGate gate(driver);
    LoopGuard guard(clock_, gate, duties());
    guard.beat(clock_.now());
    gate.write(Wrench());
    EXPECT_EQ(notices_.count(NoticeKind::guard), 1);
    EXPECT_NE(notices_.text(NoticeKind::guard).find("hangs in the device's driver"), std::string::npos);
}

TEST_F(LoopGuardTest, ASinkThatWaitsDoesNotKeepItFromWatching)
{
    GuardDuties duties;
    double force_meanwhile = 1;
    duties.sink = [&](const Notice &notice) {
        if (notice.kind == NoticeKind::safety)
        {
            clock_.advance(0.5); // a terminal that somebody has stopped
            force_meanwhile = force();
        }
    };
    LoopGuard guard(clock_, gate_, std::move(duties));
    guard.beat(clock_.now());
    guard.post(Notice(NoticeKind::safety, 0, "something"));
    clock_.advance(0.02);
    EXPECT_EQ(force_meanwhile, 0);
}

/// A clock that the program may set, such as the time of day. Sleeps last until its time.
class ResetClock : public MonotonicClock
{
public:
    double now() const override { return MonotonicClock::now() + offset; }

    void sleep_until(double time) override
    {
        while (now() < time)
            MonotonicClock::sleep_until(MonotonicClock::now() + 1e-4);
    }

    std::atomic<double> offset{0}; ///< s
};

TEST_F(LoopGuardTest, TakesTheForceWhenTheClockGoesBack)
{
    ResetClock clock;
    GuardDuties duties = this->duties();
    duties.stall_after = 1e6; // on a busy machine, the test itself stalls
    LoopGuard guard(clock, gate_, duties);
    guard.beat(clock.now());
    const MonotonicClock machine;
    const double begin = machine.now();
    bool taken = false;
    while (!taken && machine.now() < begin + 10) // some 20 ms on an idle machine
    {
        MonotonicClock().sleep_until(machine.now() + 0.01);
        clock.offset = clock.offset - 3600; // repeatedly: the guard's thread may not have started
        taken = gate_.notice_closing();
    }
    clock.offset = 0;
    EXPECT_TRUE(taken);
    guard.end(); // its thread has written the force
    EXPECT_TRUE(device_.last_wrench().force.isZero(0));
    EXPECT_NE(notices_.text(NoticeKind::guard).find("went backwards"), std::string::npos);
}
} // namespace
} // namespace ode_predictive_space::haptics
