// With the clutch, a hand reaches farther than its device, in a scene with walls.

#include "ode_predictive_space/haptics/probe.h"
#include "ode_predictive_space/haptics/proxy_law.h"

#include "tests/haptics/support/probe_fixture.h"

namespace ode_predictive_space::haptics
{
namespace
{
using ClutchTest = HapticProbeTest;

double smooth(double u)
{
    u = std::clamp(u, 0.0, 1.0);
    return u * u * (3 - 2 * u);
}

/// Moves forwards by `stroke` in 0.4 s of each second, and back while the clutch is held, after a second of rest.
class RatchetingDevice : public ScriptedDevice
{
public:
    explicit RatchetingDevice(double stroke)
        : ScriptedDevice([stroke](double seconds) -> Vector3 {
              const double u = std::fmod(seconds, 1);
              return {seconds < 1 ? 0 : stroke * (u < 0.5 ? smooth(u / 0.4) : 1 - smooth((u - 0.52) / 0.4)), 0, 0};
          })
    {}

protected:
    DeviceState move_to(double seconds) override
    {
        const double u = std::fmod(seconds, 1);
        buttons = seconds > 1 && u > 0.5 && u < 0.96 ? 1 : 0;
        return ScriptedDevice::move_to(seconds);
    }
};

TEST_F(ClutchTest, AWallHoldsAfterEachReleaseAndSoDoesTheNextOne)
{
    for (const bool proxy : {true, false})
    {
        ProbeWorld world;
        world.add_box({0.05, 1, 1}, {0.035, 0, 0});
        world.add_box({0.02, 1, 1}, {0.09, 0, 0}); // 2 cm behind the first
        RatchetingDevice device(0.004);
        RenderSettings settings = proxy ? RenderSettings() : with_stiffness(500);
        settings.clutch_button = 0;
        HapticProbe probe(device, world.space, 0.005, settings);
        world.run(probe, 1000);
        double before = 0;
        for (int tick = 1000; tick < 8000; ++tick)
        {
            world.run(probe, 1);
            const int in_stroke = tick % 1000;
            const double force = probe.last_tick().force.x();
            ASSERT_LE(force, 1e-9) << tick;
            if (in_stroke < 500 || in_stroke > 965) // in between, the clutch is held and the force is zero
            {
                ASSERT_GE(force, before - 500 * 3e-5 - 7.9 / 500 - 1e-9) << tick << ": it comes evenly";
            }
            before = force;
            if (in_stroke == 490 && tick > 3000)
            {
                ASSERT_LT(force, -0.5) << tick << (proxy ? ", proxy" : ", penalty");
            }
        }
        EXPECT_GT(probe.tool().position.x(), 0.02);
    }
}

TEST_F(ClutchTest, OnlyWhatTheToolIsInAtTheReleaseRises)
{
    ProbeWorld world;
    world.add_box({0.05, 1, 1}, {0.035, 0, 0});
    const Vector3 deep(0.02, 0, 0.1);
    ScriptedDevice device([&](double seconds) -> Vector3 {
        if (seconds < 1)
            return deep - Vector3(0.025 - 0.012 * smooth(seconds), 0, 0); // from 10 mm outside to 2 mm inside
        if (seconds < 1.7)
            return deep - Vector3(0.013, 0, 0);
        return deep - Vector3(0.013, 0, 0.008 * smooth((seconds - 1.7) / 0.2)); // sinks onto the floor
    });
    RenderSettings settings;
    settings.clutch_button = 0;
    world.add_box({2, 2, 0.1}, {0, 0, 0.1 - 0.005 - 0.003 - 0.05}); // 3 mm below
    HapticProbe probe(device, world.space, 0.005, settings);
    world.run(probe, 1500);
    ASSERT_LT(probe.last_tick().force.x(), -0.5);
    const double pressing = probe.last_tick().force.x();
    device.buttons = 1;
    world.run(probe, 180);
    device.buttons = 0;
    world.run(probe, 230);
    EXPECT_NEAR(probe.last_tick().force.z(), 500 * 0.005, 0.05) << "the floor, 5 mm deep";
    EXPECT_NEAR(probe.last_tick().force.x() / pressing, 0.46, 0.03) << "the wall";
}

TEST_F(ClutchTest, ACouplingComesBackGradually)
{
    ProbeWorld world;
    dWorldSetGravity(world.world, 0, 0, 0);
    dCreatePlane(world.space, 0, 0, 1, 0);
    const dBodyID tool = world.add_moving_box({0.02, 0.02, 0.02}, {0, 0, 0.05}, 0.05);
    ScriptedDevice device(reach({0, 0, 0.05}, {0, 0, 0.006}));
    RenderSettings settings;
    settings.clutch_button = 0;
    HapticProbe probe(device, tool, CouplingProperties(), settings);
    world.run(probe, 2000);
    ASSERT_GT(probe.last_tick().force.z(), 1.5);
    device.buttons = 1;
    world.run(probe, 100);
    EXPECT_EQ(probe.last_tick().force.z(), 0);
    device.buttons = 0;
    double before = 0;
    for (int i = 0; i < 1000; ++i)
    {
        world.run(probe, 1);
        ASSERT_NEAR(probe.last_tick().force.z(), before, 0.05) << i;
        before = probe.last_tick().force.z();
    }
    EXPECT_NEAR(before, 500 * 0.004, 0.2);
}

// Once, both tiles pushed separately while their forces rose: twice the force, which fell by half at the end.
TEST_F(ClutchTest, TwoFlushTilesRiseAsOneFloor)
{
    ProbeWorld world;
    world.add_box({0.1, 0.2, 0.1}, {-0.05, 0, -0.05});
    world.add_box({0.1, 0.2, 0.1}, {0.05, 0, -0.05});
    constexpr double depth = 0.003; // m
    ScriptedDevice device([](double seconds) -> Vector3 {
        return {0.0005, 0, 0.005 - depth + 0.01 * (1 - smooth(seconds))};
    });
    RenderSettings settings;
    settings.law = std::make_shared<ProxyLaw>(Material{500});
    settings.clutch_button = 0;
    HapticProbe probe(device, world.space, 0.005, settings);
    world.run(probe, 1500);
    EXPECT_NEAR(probe.last_tick().requested.z(), 500 * depth, 0.01);
    device.buttons = 1;
    world.run(probe, 100);
    device.buttons = 0;
    double before = 0;
    for (int tick = 0; tick < 800; ++tick)
    {
        world.run(probe, 1);
        const double requested = probe.last_tick().requested.z();
        ASSERT_NEAR(requested, before, 500 * depth * 0.001 / 0.5 + 1e-9) << tick;
        before = requested;
    }
    EXPECT_NEAR(before, 500 * depth, 0.01);
}
} // namespace
} // namespace ode_predictive_space::haptics
