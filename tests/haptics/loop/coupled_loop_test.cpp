// The single-threaded loop with a hand that yields to forces: it comes to rest, and its runs can be replayed.

#include "ode_predictive_space/haptics/loop.h"

#include "ode_predictive_space/haptics/recording.h"
#include "ode_predictive_space/haptics/virtual_device.h"
#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/probe_world.h"

#include <cmath>
#include <cstdio>
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
    LoopSettings settings(double duration)
    {
        LoopSettings settings;
        settings.duration = duration;
        settings.clock = &clock_;
        settings.ask_for_priority = false;
        return settings;
    }

    LoopReport run(HapticProbe &probe, ProbeWorld &world, const LoopSettings &settings)
    {
        HapticLoop loop(probe, settings);
        return loop.run({[&] { world.collide(probe); }, [&](double dt) { world.step(dt); }});
    }

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
        run(probe, world, settings(5));
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

void furnish(ProbeWorld &world)
{
    dCreatePlane(world.space, 0, 0, 1, 0);
    world.add_moving_box({0.04, 0.04, 0.04}, {0.02, 0, 0.02}, 0.1);
    world.add_moving_box({0.04, 0.04, 0.04}, {-0.03, 0.01, 0.02}, 0.3);
    dWorldSetGravity(world.world, 0, 0, -9.81);
}

TEST_F(CoupledLoopTest, AReplayedRunGivesTheSameForcesBitByBit)
{
    const std::string file = testing::TempDir() + "coupled_loop_test_run.txt";
    {
        ProbeWorld world;
        furnish(world);
        VirtualDevice device({}, [](double seconds) -> Vector3 {
            const double t = std::max(0.0, seconds - 1);
            return {0.03 * std::sin(5 * t), 0.01 * std::sin(7 * t), 0.07 - 0.065 * std::pow(std::sin(2 * t), 2)};
        });
        HapticProbe probe(device, world.space, radius, with_stiffness(600));
        Recorder recorder(file, device.capabilities(), Recorder::Flush::by_caller);
        probe.set_recorder([&](const RenderedTick &tick) { recorder.add(tick.time, tick.state, tick.wrench.force); });
        run(probe, world, settings(5));
        recorder.close();
        ASSERT_EQ(recorder.lost(), 0U);
    }
    const Recording recording = read_recording(file);
    ASSERT_EQ(recording.ticks.size(), 5000U);

    ProbeWorld world;
    furnish(world);
    ReplayDevice device(recording);
    HapticProbe probe(device, world.space, radius, with_stiffness(600));
    std::vector<Vector3> forces;
    probe.set_recorder([&](const RenderedTick &tick) { forces.push_back(tick.force); });
    run(probe, world, settings(5));
    ASSERT_EQ(forces.size(), recording.ticks.size());
    int in_touch = 0;
    for (std::size_t tick = 0; tick < forces.size(); ++tick)
    {
        ASSERT_EQ(forces[tick], recording.ticks[tick].force) << "tick " << tick;
        in_touch += forces[tick].isZero(0) ? 0 : 1;
    }
    EXPECT_GT(in_touch, 500);
    std::remove(file.c_str());
}
} // namespace
} // namespace ode_predictive_space::haptics
