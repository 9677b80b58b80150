#include "ode_predictive_space/haptics/renderer.h"

#include "ode_predictive_space/haptics/penalty_law.h"
#include "tests/haptics/allocation_count.h"
#include "tests/haptics/constants.h"
#include "tests/haptics/faulty_device.h"
#include "tests/haptics/scripted_device.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
/// A wall below z = 0, as a scene would tell it.
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

TEST(Renderer, WithTheClutchHeldThereIsNoForceAndTheToolStays)
{
    ScriptedDevice device(&tap);
    device.buttons = 0;
    RenderSettings settings;
    settings.clutch_button = 1;
    Renderer renderer(device, settings);
    int tick = 0;
    const auto run_to = [&](double time) {
        for (; dt * tick < time; ++tick)
            feel_wall(renderer, dt * tick);
    };
    run_to(0.8);
    device.buttons = 2;
    run_to(0.801);
    const Vector3 place = renderer.tool().position;
    run_to(1.4);
    EXPECT_EQ(renderer.tool().position, place);
    EXPECT_TRUE(renderer.last_tick().force.isZero(0));
    device.buttons = 0;
    run_to(2);
    EXPECT_NE(renderer.tool().position, place);
}

/// Drives the hand on in its direction, as no passive thing does.
class DrivingLaw : public ForceLaw
{
public:
    void forces(const ToolState &tool, const std::vector<Touch> &touches, double, TouchForces &forces) override
    {
        forces.assign(touches.size(), 3 * tool.linear_velocity);
    }

    void reset() override {}
    Material material() const override { return {0, 0}; }
};

TEST(Renderer, WithTheClutchHeldNothingBrakesTheHandEither)
{
    ScriptedDevice device([](double seconds) -> Vector3 { return {0, 0, -0.02 + 0.005 * std::cos(20 * seconds)}; });
    RenderSettings settings;
    settings.law = std::make_shared<DrivingLaw>();
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

/// Presses 4 mm into the wall from 1 s to 3 s.
Vector3 press_wall(double seconds)
{
    const double out = std::max(1 - seconds, seconds - 3);
    return {0, 0, std::clamp(0.1 * out, -0.004, 0.01)};
}

TEST(Renderer, AClutchLetGoInsideOfSomethingGivesNoForceUntilItWasLeft)
{
    ScriptedDevice device(&press_wall);
    RenderSettings settings;
    settings.clutch_button = 0;
    Renderer renderer(device, settings);
    double most_after = 0;
    for (int tick = 0; tick < 2900; ++tick)
    {
        const double time = dt * tick;
        device.buttons = time > 1.5 && time < 1.6 ? 1 : 0;
        feel_wall(renderer, time);
        if (time > 1.2 && time < 1.5)
        {
            ASSERT_GT(renderer.last_tick().force.z(), 1);
        }
        if (time > 1.6)
            most_after = std::max(most_after, renderer.last_tick().force.norm());
    }
    EXPECT_EQ(most_after, 0);
    EXPECT_LT(renderer.tool().position.z(), -0.003) << "it is still inside";
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
    SurfaceProperties stiff;
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
    SurfaceProperties nonsense;
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

TEST(Renderer, ASlowProgramSaysSoAndFeelsNothing)
{
    ScriptedDevice device(&tap);
    std::string told;
    RenderSettings settings;
    settings.notice = [&](const Notice &notice) { told = notice.sentence(); };
    Renderer renderer(device, settings);
    for (int tick = 0; tick < 100; ++tick)
    {
        feel_wall(renderer, 0.05 * tick); // 20 Hz, where 1000 Hz were promised
        EXPECT_TRUE(renderer.last_tick().force.isZero(0));
    }
    EXPECT_FALSE(told.empty());
}
} // namespace
} // namespace ode_predictive_space::haptics
