// The single-threaded loop with a hand that yields to forces: it comes to rest.

#include "ode_predictive_space/haptics/loop.h"

#include "ode_predictive_space/haptics/virtual_device.h"
#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/probe_world.h"
#include "tests/haptics/support/scripted_device.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
Vector3 press(double seconds)
{
    const double u = std::clamp((seconds - 1) / 0.5, 0.0, 1.0);
    return {0, 0, 0.03 - 0.025 * u * u * (3 - 2 * u)};
}

class CoupledLoopTest : public testing::Test
{
protected:
    /// m; vertical motion of the hand in the last of five seconds on a wall.
    double rest_motion(const VirtualDeviceSettings &hand, RenderSettings rendering)
    {
        ProbeWorld world;
        dCreatePlane(world.space, 0, 0, 1, 0);
        VirtualDevice device(hand, &press);
        HapticProbe probe(device, world.space, radius, std::move(rendering));
        double lowest = 1;
        double highest = -1;
        probe.set_recorder([&](const RenderedTick &tick) {
            if (tick.time >= 4)
            {
                lowest = std::min(lowest, device.true_position().z());
                highest = std::max(highest, device.true_position().z());
            }
        });
        HapticLoop(probe, simulated(clock_, 5)).run(world.work(probe));
        stiffness_ = probe.renderer().rendered(probe.renderer().law().material()).stiffness;
        return highest - lowest;
    }

    const OdeUse ode_;
    SimulatedClock clock_;
    NoticeList notices_;
    double stiffness_ = 0; ///< N/m; as rendered
};

constexpr double at_rest = 0.00006; // m; two steps of the encoder

constexpr double light_damping = 0.4;                    // N s/m
constexpr double light_bound = 2 * light_damping * 1000; // N/m; 2 b / T

/// A device with so little damping that 2 b / T is below the stiffness that it states. The bound leaves out the damping of the
/// grip, because a hand may let go; this one does not.
VirtualDeviceSettings light_hand()
{
    VirtualDeviceSettings settings;
    settings.hand.damping = light_damping;
    settings.hand.grip_damping = 2;
    return settings;
}

TEST_F(CoupledLoopTest, AHandOnAWallComesToRestUpToTheSafeBound)
{
    for (const double stiffness : {100.0, 500.0, 1000.0})
        EXPECT_LE(rest_motion({}, with_stiffness(stiffness, notices_.sink())), at_rest) << stiffness;
    for (const double share : {0.2, 0.6, 0.99})
    {
        RenderSettings rendering = with_stiffness(share * light_bound, notices_.sink());
        rendering.device_damping = light_damping;
        EXPECT_LE(rest_motion(light_hand(), std::move(rendering)), at_rest) << share;
    }
    EXPECT_EQ(notices_.count(NoticeKind::stability), 0);
}

TEST_F(CoupledLoopTest, AboveTheBoundStiffnessIsClampedAndThatIsTold)
{
    EXPECT_LE(rest_motion({}, with_stiffness(20000, notices_.sink())), at_rest);
    EXPECT_EQ(stiffness_, 1000);
    EXPECT_EQ(notices_.count(NoticeKind::stability), 1);

    RenderSettings rendering = with_stiffness(20000, notices_.sink());
    rendering.device_damping = light_damping;
    EXPECT_LE(rest_motion(light_hand(), std::move(rendering)), at_rest);
    EXPECT_NEAR(stiffness_, light_bound, 1e-9);
    EXPECT_EQ(notices_.count(NoticeKind::stability), 2);
    EXPECT_FALSE(notices_.text(NoticeKind::stability).empty());
}

TEST_F(CoupledLoopTest, WithoutTheClampTheHandWouldShake)
{
    VirtualDeviceSettings hand = light_hand();
    hand.capabilities.max_stiffness = 0; // unknown
    EXPECT_GT(rest_motion(hand, with_stiffness(10 * light_bound)), 10 * at_rest);
}
} // namespace
} // namespace ode_predictive_space::haptics
