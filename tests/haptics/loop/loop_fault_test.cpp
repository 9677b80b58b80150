// After any fault of a running loop the force is soon zero, and there is a notice.

#include "tests/haptics/loop/loop_fixture.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
using LoopFaultTest = HapticLoopTest;

INSTANTIATE_TEST_SUITE_P(Kinds, LoopFaultTest, testing::Bool(), name_of_loop);

TEST_P(LoopFaultTest, AStalledStepEndsWithZeroForceAndANoticeWhileItLasts)
{
    make();
    int notices_during_stall = 0;
    Once stall(clock_, pressed_after, [&] {
        clock_.advance(0.5);
        notices_during_stall = notices_.count(NoticeKind::guard) + notices_.count(NoticeKind::watchdog);
    });
    loop_->run(work(std::ref(stall)));
    expect_zero_force_after(stall.at, stall.at + 0.5);
    EXPECT_GE(notices_during_stall, 1);
}

TEST_P(LoopFaultTest, AStalledCollisionEndsWithZeroForceAndItsStaleForceIsNotRendered)
{
    make();
    Once stall(clock_, pressed_after, [&] { clock_.advance(0.5); });
    SceneWork late = work();
    late.collide = [&] {
        world_.collide(*probe_);
        stall();
    };
    loop_->run(late);
    expect_zero_force_after(stall.at, stall.at + 0.5);
    EXPECT_GE(notices_.count(NoticeKind::guard) + notices_.count(NoticeKind::watchdog), 1);
}

TEST_P(LoopFaultTest, AStalledStepIsFoundSoonAfterTheNextOneWasDueAtLowRates)
{
    for (const double rate : {100.0, 200.0, 500.0})
    {
        SCOPED_TRACE(rate);
        LoopSettings slow = settings();
        slow.rate = GetParam() ? 1000 : rate;
        slow.physics_rate = rate;
        make(usual_rendering(), slow);
        Once stall(clock_, clock_.now() + 2.5, [&] { clock_.advance(0.5); });
        loop_->run(work(std::ref(stall)));
        EXPECT_GT(log_.force_at(stall.at).z(), 0.1);
        EXPECT_TRUE(log_.was_quiet(stall.at + 1 / rate + grace, stall.at + 0.5));
        loop_.reset();
        probe_.reset();
    }
}

// The program runs the second probe in the loop's callbacks, hence in the thread that hangs.
class SecondProbe : public testing::TestWithParam<bool>
{};

INSTANTIATE_TEST_SUITE_P(Kinds, SecondProbe, testing::Bool(), name_of_loop);

TEST_P(SecondProbe, IsGuardedByTheLoopOfTheFirst)
{
    const OdeUse ode;
    for (const double rate : {1000.0, 100.0})
    {
        SCOPED_TRACE(rate);
        NoticeList notices;
        SimulatedClock clock;
        ProbeWorld world;
        dCreatePlane(world.space, 0, 0, 1, 0);
        ScriptedDevice first_device(&press_down);
        ScriptedDevice second_device(&press_down);
        WriteLog second_log(second_device, clock);
        HapticProbe first(first_device, world.space, radius, usual_rendering());
        ProbeWorld other;
        dCreatePlane(other.space, 0, 0, 1, 0);
        HapticProbe second(second_log, other.space, radius, usual_rendering());
        second.renderer().set_rates(rate, rate);
        LoopSettings settings = simulated(clock, 3, GetParam(), rate);
        settings.rate = GetParam() ? 1000 : rate;
        settings.notice = notices.sink();
        Once stall(clock, 2.5, [&] { clock.advance(0.06); });
        HapticLoop(first, settings)
            .run({[&] { world.collide(first); },
                  [&](double dt) {
                      second.begin(clock.now(), clock.now());
                      other.collide(second);
                      second.render(dt);
                      stall();
                  }});
        EXPECT_GT(second_log.force_at(stall.at).z(), rate < 1000 ? 0.1 : 3);
        EXPECT_TRUE(second_log.was_quiet(stall.at + 1 / rate + grace, stall.at + 0.06));
        EXPECT_EQ(notices.count(NoticeKind::guard), 1);
    }
}

TEST_P(LoopFaultTest, ALawThatHangsEndsWithZeroForceAndANotice)
{
    Once stall(clock_, pressed_after, [&] { clock_.advance(0.5); });
    make(with_law(std::make_shared<TroubledLaw>(std::ref(stall))));
    loop_->run(work());
    expect_zero_force_after(stall.at, stall.at + 0.501);
    EXPECT_EQ(notices_.count(NoticeKind::guard), 1);
}

TEST_P(LoopFaultTest, EveryWayForADeviceToBreakEndsWithZeroForceAndANotice)
{
    for (const Breakage breakage : {Breakage::lost, Breakage::unreadable, Breakage::unwritable, Breakage::not_a_number,
                                    Breakage::endless_velocity, Breakage::stalled})
    {
        notices_ = NoticeList();
        device_.break_now(Breakage::none);
        make();
        const double begin = clock_.now();
        Once breaking(clock_, begin + pressed_after, [&] { device_.break_now(breakage); });
        loop_->run(work(std::ref(breaking)));
        SCOPED_TRACE(static_cast<int>(breakage));
        expect_zero_force_after(breaking.at, begin + 3);
        EXPECT_EQ(notices_.count(NoticeKind::device), 1);
        EXPECT_NEAR(clock_.now(), begin + 3, 0.002) << "the program goes on";
        loop_.reset();
        probe_.reset();
    }
}

TEST_P(LoopFaultTest, AContactThatIsNotANumberEndsWithZeroForceAndANotice)
{
    make();
    dGeomID broken = nullptr;
    Once breaking(clock_, pressed_after, [&] { broken = add_broken_geom(world_.space); });
    loop_->run(work(std::ref(breaking)));
    expect_zero_force_after(breaking.at, 3);
    EXPECT_GE(notices_.count(NoticeKind::contact), 1);
    dGeomDestroy(broken);
}

TEST_P(LoopFaultTest, ADeviceThatIsLostAfterItsDriverHungGetsItsZero)
{
    make();
    double answered_at = 0;
    scripted_.before_read = Once(clock_, pressed_after, [&] {
        clock_.advance(0.0072); // the guard finds the device busy
        answered_at = clock_.now();
        throw DeviceError(DeviceFault::lost, "the device is gone");
    });
    loop_->run(work());
    expect_zero_force_after(answered_at - grace, answered_at + 0.1);
}

TEST_P(LoopFaultTest, ADriverThatHangsIsToldOf)
{
    make();
    Once stall(clock_, pressed_after, [&] { clock_.advance(0.5); });
    scripted_.before_read = std::ref(stall);
    loop_->run(work());
    EXPECT_GT(stall.at, 0);
    EXPECT_NE(notices_.text(NoticeKind::guard).find("driver"), std::string::npos);
    EXPECT_TRUE(log_.was_quiet(pressed_after + 0.51, pressed_after + 0.51 + grace))
        << "and the force does not come at once";
}

} // namespace
} // namespace ode_predictive_space::haptics
