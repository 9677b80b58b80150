#include "ode_predictive_space/haptics/renderer.h"

#include "ode_predictive_space/haptics/penalty_law.h"
#include "tests/haptics/support/allocation_count.h"
#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/faulty_device.h"
#include "tests/haptics/support/scripted_device.h"

#include <functional>
#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
void feel_wall(Renderer &renderer, double time)
{
    renderer.read(time, time);
    renderer.note_fresh_physics();
    static thread_local std::vector<Touch> touches;
    touches.clear();
    if (renderer.tool().position.z() < 0)
    {
        Touch touch;
        touch.depth = -renderer.tool().position.z();
        touch.object = 1;
        touches.push_back(touch);
    }
    renderer.render(touches, true, dt);
}

Vector3 tap(double seconds)
{
    return {0, 0, 0.005 * std::cos(20 * seconds)};
}

TEST(Renderer, AllocatesNothingWhileTheDeviceAnswers)
{
    ScriptedDevice device(&tap);
    RenderSettings settings;
    settings.passivity_control = true;
    Renderer renderer(device, settings);
    int tick = 0;
    for (; tick < 1000; ++tick)
        feel_wall(renderer, dt * tick);
    const std::uint64_t before = allocation_count();
    double most = 0;
    for (; tick < 3000; ++tick)
    {
        feel_wall(renderer, dt * tick);
        most = std::max(most, renderer.last_tick().force.z());
    }
    EXPECT_EQ(allocation_count(), before);
    EXPECT_GT(most, 1);
}

/// A law of a program. @param forces for a tool and a number of touches.
class FunctionLaw : public ForceLaw
{
public:
    explicit FunctionLaw(std::function<TouchForces(const ToolState &, std::size_t)> forces) : forces_(std::move(forces))
    {}

    void forces(const ToolState &tool, const std::vector<Touch> &touches, double, TouchForces &forces) override
    {
        forces = forces_(tool, touches.size());
    }

    void reset() override {}
    Material material() const override { return {0, 0}; }

private:
    std::function<TouchForces(const ToolState &, std::size_t)> forces_;
};

TEST(Renderer, WithTheClutchHeldNothingBrakesTheHandEither)
{
    ScriptedDevice device([](double seconds) -> Vector3 { return {0, 0, -0.02 + 0.005 * std::cos(20 * seconds)}; });
    RenderSettings settings;
    settings.law = std::make_shared<FunctionLaw>([](const ToolState &tool, std::size_t touches) {
        return TouchForces(touches, Vector3(3 * tool.linear_velocity));
    });
    settings.passivity_control = true;
    settings.clutch_button = 0;
    Renderer renderer(device, settings);
    for (int tick = 0; tick < 2000; ++tick)
    {
        device.buttons = tick >= 1500 ? 1 : 0;
        feel_wall(renderer, dt * tick);
        if (tick >= 1510)
        {
            ASSERT_TRUE(device.last_wrench().force.isZero(0)) << tick;
        }
    }
}

/// Pushing in, the hand works against the rendered force, a tenth of the requested one: a softer force gives back no more.
TEST(Renderer, ThePassivityObserverCountsTheForceThatLimitsLeave)
{
    constexpr int start = 300; // until then the watchdog lets the force rise
    ScriptedDevice device([](double seconds) -> Vector3 {
        const double time = std::max(0.0, seconds - dt * start);
        return {0, 0, time < 0.1 ? -0.1 * time : -0.01 + 0.1 * (time - 0.1)};
    });
    Vector3 pushed = Vector3::Zero();
    RenderSettings settings;
    settings.law =
        std::make_shared<FunctionLaw>([&](const ToolState &, std::size_t) { return TouchForces(1, pushed); });
    settings.passivity_control = true;
    settings.safety = SafetyLimits::of(device.capabilities());
    settings.safety->max_force = 0.5;
    settings.safety->max_force_rate = 1e9;
    settings.safety->ramp_time = 0;
    settings.safety->engage_force = 100;
    Renderer renderer(device, settings);
    double least = infinity; // N; in the last part of the retreat
    for (int tick = -start; tick < 290; ++tick)
    {
        const double time = dt * (tick + start);
        pushed.z() = tick < 0 ? 0 : tick < 100 ? 5 : 0.4;
        renderer.read(time, time);
        renderer.note_fresh_physics();
        renderer.render({}, true, dt);
        const double force = renderer.last_tick().wrench.force.z();
        if (tick > 10 && tick < 100)
        {
            ASSERT_NEAR(force, 0.5, 1e-12) << tick;
            ASSERT_TRUE(renderer.last_tick().saturated) << tick;
        }
        if (tick > 110 && tick < 210) // 5 mJ went in, and up to 4.4 mJ come out
        {
            ASSERT_NEAR(force, 0.4, 1e-12) << tick;
            ASSERT_FALSE(renderer.last_tick().saturated) << tick;
        }
        if (tick > 240)
            least = std::min(least, force);
    }
    EXPECT_LT(least, 0.3) << "more would come out than went in";
}

/// Presses 4 mm into the wall from 1 s to 3 s.
Vector3 press_wall(double seconds)
{
    const double out = std::max(1 - seconds, seconds - 3);
    return {0, 0, std::clamp(0.1 * out, -0.004, 0.01)};
}

TEST(Renderer, AClutchReleasedInsideOfSomethingLetsItsForceRiseWithinHalfASecond)
{
    ScriptedDevice device(&press_wall);
    RenderSettings settings;
    settings.clutch_button = 4;
    Renderer renderer(device, settings);
    double before = 0;
    double pressing = 0;
    for (int tick = 0; tick < 2900; ++tick)
    {
        const double time = dt * tick;
        device.buttons = time > 1.5 && time < 1.6 ? 1 << 4 : 15; // the other buttons are no clutch
        feel_wall(renderer, time);
        const double force = renderer.last_tick().force.z();
        if (time > 1.2 && time < 1.5)
        {
            ASSERT_GT(force, 1);
            pressing = force;
        }
        if (time > 1.52)
        {
            ASSERT_LE(force - before, 1.01 * pressing * dt / 0.5 + 1e-12) << time;
        }
        if (time > 1.85 && time < 2.05)
        {
            EXPECT_NEAR(force, pressing * (time - 1.6) / 0.5, 0.02 * pressing) << time;
        }
        if (time > 2.11)
        {
            ASSERT_NEAR(force, pressing, 1e-9) << time;
        }
        before = force;
    }
}

/// A loop hangs, its guard takes the force away, and the hand leaves the wall before the loop continues.
TEST(Renderer, NothingIsLeftOfAForceThatWasTakenAway)
{
    ScriptedDevice device([](double seconds) -> Vector3 {
        return {0, 0, seconds < 1 ? 0.01 - 0.014 * seconds : std::min(-0.004 + 1.7 * (seconds - 1), 0.01)};
    });
    Renderer renderer(device, {});
    int tick = 0;
    for (; tick < 1000; ++tick)
        feel_wall(renderer, dt * tick);
    ASSERT_GT(renderer.last_tick().force.z(), 1.5);
    renderer.relax();
    for (tick += 3; tick < 1500; ++tick)
    {
        feel_wall(renderer, dt * tick);
        ASSERT_TRUE(renderer.last_tick().force.isZero(0)) << tick;
    }
}

/// The loop hung for a while, in which simulated time stood still.
TEST(Renderer, AHandThatHasMovedWhileNobodyReadItHasNotJumped)
{
    Vector3 hand(0, 0, 0.05);
    ScriptedDevice device([&](double) { return hand; });
    int notices = 0;
    RenderSettings settings;
    settings.notice = [&](const Notice &notice) { notices += notice.kind == NoticeKind::device ? 1 : 0; };
    Renderer renderer(device, settings);
    for (int tick = 0; tick < 10; ++tick)
        feel_wall(renderer, dt * tick);
    renderer.relax();
    hand.x() = 0.1;
    feel_wall(renderer, dt * 10);
    EXPECT_EQ(notices, 0);
}

TEST(Renderer, APlacementThatPutsTheToolIntoSomethingGivesNoForceUntilItWasLeft)
{
    ScriptedDevice device([](double seconds) -> Vector3 { return {0, 0, 0.01 + 0.01 * std::cos(seconds)}; });
    Renderer renderer(device, {});
    int tick = 0;
    for (; tick < 1000; ++tick)
        feel_wall(renderer, dt * tick);
    WorkspacePlacement deeper;
    deeper.offset = {0, 0, -0.03};
    renderer.set_placement(deeper);
    for (; tick < 2000; ++tick)
    {
        feel_wall(renderer, dt * tick);
        ASSERT_LT(renderer.tool().position.z(), -0.005);
        ASSERT_TRUE(renderer.last_tick().force.isZero(0));
    }
}

TEST(Renderer, ADeviceThatFailsGetsItsZeroBeforeAnybodyIsTold)
{
    ScriptedDevice device(&press_wall);
    FaultyDevice faulty(device);
    RenderSettings settings;
    settings.notice = [](const Notice &notice) {
        if (notice.kind == NoticeKind::device)
            throw std::runtime_error("the terminal is gone");
    };
    Renderer renderer(faulty, settings);
    int tick = 0;
    for (; tick < 2000; ++tick)
        feel_wall(renderer, dt * tick);
    EXPECT_GT(faulty.last_wrench().force.z(), 1);
    faulty.break_now(Breakage::unreadable);
    try
    {
        feel_wall(renderer, dt * tick);
    }
    catch (const std::runtime_error &)
    {}
    EXPECT_TRUE(faulty.last_wrench().force.isZero(0));
}

TEST(Renderer, ALawMayBeChangedBetweenTwoTicks)
{
    ScriptedDevice device([](double seconds) -> Vector3 {
        return {0, 0, std::clamp(0.01 - 0.5 * (seconds - 1), -0.001, 0.01)};
    });
    Renderer renderer(device, {});
    int tick = 0;
    for (; tick < 1200; ++tick)
        feel_wall(renderer, dt * tick);
    EXPECT_NEAR(renderer.last_tick().force.z(), 500 * 0.001, 1e-12) << "half of what the device can do";
    Material stiff;
    stiff.stiffness = 3000;
    renderer.set_law(std::make_shared<PenaltyLaw>(stiff));
    EXPECT_EQ(renderer.rendered(stiff).stiffness, 1000) << "all that the device can do";
    for (; tick < 1400; ++tick)
        feel_wall(renderer, dt * tick);
    EXPECT_NEAR(renderer.last_tick().force.z(), 1, 1e-12);

    WorkspacePlacement large;
    large.scale = 4;
    renderer.set_placement(large);
    EXPECT_EQ(renderer.rendered(stiff).stiffness, 250) << "the hand goes a quarter as far";
    EXPECT_EQ(renderer.law().material().stiffness, 3000) << "the law stays";
    Material nonsense;
    nonsense.damping = 100;
    EXPECT_THROW(renderer.set_law(std::make_shared<PenaltyLaw>(nonsense)), std::invalid_argument);
}

TEST(Renderer, RatesMustBeAboveZero)
{
    ScriptedDevice device(&tap);
    RenderSettings settings;
    settings.rate = 0;
    EXPECT_THROW(Renderer(device, settings), std::invalid_argument);
    EXPECT_FALSE(device.status().open);
}
} // namespace
} // namespace ode_predictive_space::haptics
