// The delay of a device reduces the rendered stiffness, so that the hand does not shake.

#include "ode_predictive_space/haptics/device/device_motion.h"
#include "ode_predictive_space/haptics/proxy_law.h"
#include "ode_predictive_space/haptics/virtual_device.h"
#include "tests/haptics/safety/simulated_hand.h"
#include "tests/haptics/support/probe_fixture.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double target_depth = 0.01; // m; of the hand's target, below the floor

class DelayTest : public testing::TestWithParam<bool>
{
protected:
    /// @return m; swing of the hand in the last of ten seconds on a floor.
    double swing(int position_delay, int force_delay, const RenderSettings &wanted)
    {
        VirtualDeviceSettings hand;
        hand.position_delay = position_delay;
        hand.force_delay = force_delay;
        VirtualDevice device(hand, [](double t) -> Vector3 {
            return {0, 0, radius + 0.01 - std::min(1.0, t / 0.5) * (0.01 + target_depth)};
        });
        ProbeWorld world;
        dCreatePlane(world.space, 0, 0, 1, 0);
        RenderSettings settings = wanted;
        settings.law = std::make_shared<ProxyLaw>(Material{1000});
        settings.passivity_control = GetParam();
        settings.notice = notices_.sink();
        HapticProbe probe(device, world.space, radius, settings);
        stiffness_ = probe.renderer().rendered(Material{1000}).stiffness;
        world.run(probe, 9000);
        Swing last;
        for (int tick = 0; tick < 1000; ++tick)
        {
            world.run(probe, 1);
            last.add(device.true_position().z());
        }
        force_ = probe.last_tick().force.z();
        return last.width();
    }

    const OdeUse ode_;
    NoticeList notices_;
    double stiffness_ = 0;
    double force_ = 0;
};

INSTANTIATE_TEST_SUITE_P(PassivityControl, DelayTest, testing::Bool(),
                         [](const auto &info) { return info.param ? "On" : "Off"; });

TEST_P(DelayTest, OfEightTicksMakesNoLimitCycle)
{
    for (const int position_delay : {8, 4, 0})
    {
        EXPECT_LT(swing(position_delay, 8 - position_delay, {}), 0.0001) << position_delay;
        EXPECT_NEAR(stiffness_, 1000.0 / 17, 1e-9);
        EXPECT_GT(force_, 0.3) << "the floor is felt";
        EXPECT_NE(notices_.text(NoticeKind::stability).find("with a delay of 8 ms; 58.8"), std::string::npos)
            << notices_.text(NoticeKind::stability);
    }
}

TEST_P(DelayTest, OfADeviceWhoseDampingIsKnownIsAsStiffAsThatLetsItBe)
{
    RenderSettings settings;
    settings.device_damping = 6;
    EXPECT_LT(swing(4, 4, settings), 0.0001);
    EXPECT_NEAR(stiffness_, 2 * 6 / 0.017, 1e-9);
}

TEST_P(DelayTest, IsTakenFromTheSettingsWhereTheyKnowBetter)
{
    RenderSettings settings;
    settings.delay = 0.004;
    swing(0, 0, settings);
    EXPECT_NEAR(stiffness_, 1000.0 / 9, 1e-9);
}

TEST(Delay, ThatCannotBeIsRefused)
{
    const OdeUse ode;
    ProbeWorld world;
    for (const double bad : {-1.0, nan, infinity})
    {
        ScriptedDevice device([](double) { return Vector3(0, 0, 0.1); });
        RenderSettings settings;
        settings.delay = bad;
        EXPECT_THROW(HapticProbe(device, world.space, radius, settings), std::invalid_argument);
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
