#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/probe.h"

#include "tests/haptics/support/probe_fixture.h"

namespace ode_predictive_space::haptics
{
namespace
{
using MovingBase = HapticProbeTest;

constexpr double way = 0.045;     // m
constexpr double speed = 0.02;    // m/s
constexpr double in_wall = 0.005; // m; final depth of the probe in the wall

double base_at(double seconds)
{
    return std::clamp(speed * (seconds - 1), 0.0, way);
}

WorkspacePlacement placed_at(double x)
{
    WorkspacePlacement placement;
    placement.offset.x() = x;
    return placement;
}

dGeomID add_wall(ProbeWorld &world)
{
    return world.add_box({0.1, 1, 1}, {0.05 + radius + way - in_wall, 0, 0});
}

ScriptedDevice still_device()
{
    return ScriptedDevice([](double) -> Vector3 { return Vector3::Zero(); });
}

TEST_F(MovingBase, PressesTheToolOnAWallAsTheHandWould)
{
    Vector3 force[2];
    for (const bool by_base : {false, true})
    {
        ProbeWorld world;
        add_wall(world);
        ScriptedDevice device([&](double seconds) -> Vector3 { return {by_base ? 0 : base_at(seconds), 0, 0}; });
        HapticProbe probe(device, world.space, radius);
        double greatest_change = 0;
        for (int tick = 0; tick < 6000; ++tick)
        {
            const double before = probe.last_tick().force.x();
            if (by_base)
            {
                const double x = base_at(0.001 * tick);
                BaseMotion motion;
                motion.velocity.x() = x > 0 && x < way ? speed : 0;
                if (tick < 4000)
                    probe.renderer().move_base(placed_at(x), motion);
            }
            world.run(probe, 1);
            greatest_change = std::max(greatest_change, std::abs(probe.last_tick().force.x() - before));
        }
        force[by_base] = probe.last_tick().force;
        EXPECT_NEAR(force[by_base].x(), -500 * in_wall, 1e-6);
        EXPECT_LT(greatest_change, 0.05);
    }
    EXPECT_NEAR((force[0] - force[1]).norm(), 0, 1e-9);
}

TEST_F(MovingBase, InTwoThreadsToo)
{
    for (const double physics_rate : {60.0, 200.0, 1000.0})
    {
        ProbeWorld world;
        add_wall(world);
        ScriptedDevice device = still_device();
        HapticProbe probe(device, world.space, radius);
        SimulatedClock clock;
        double greatest_change = 0;
        double before = 0;
        probe.set_recorder([&](const RenderedTick &tick) {
            greatest_change = std::max(greatest_change, std::abs(tick.force.x() - before));
            before = tick.force.x();
        });
        HapticLoop loop(probe, simulated(clock, 6, true, physics_rate));
        double seconds = 0;
        SceneWork work;
        work.collide = [&] { world.collide(probe); };
        work.advance = [&](double dt) {
            seconds += dt;
            BaseMotion motion;
            motion.velocity.x() = seconds > 1 && base_at(seconds) < way ? speed : 0;
            probe.renderer().move_base(placed_at(base_at(seconds)), motion);
            world.step(dt);
        };
        loop.run(work);
        EXPECT_NEAR(before, -500 * in_wall, 0.01) << physics_rate;
        EXPECT_LT(greatest_change, 0.05) << physics_rate;
    }
}

TEST_F(MovingBase, CarriesTheHeldToolAndTheGripAlong)
{
    ProbeWorld world;
    ScriptedDevice device = still_device();
    RenderSettings settings;
    settings.clutch_button = 0;
    HapticProbe probe(device, world.space, radius, settings);
    world.run(probe, 10);
    device.buttons = 1;
    world.run(probe, 10);
    BaseMotion motion;
    motion.velocity = {0, 0.5, 0};
    motion.spin = {0, 0, 1};
    WorkspacePlacement placement = placed_at(0.1);
    placement.rotation = Quaternion(Eigen::AngleAxisd(0.3, Vector3::UnitZ()));
    probe.renderer().move_base(placement, motion);
    world.run(probe, 1);
    EXPECT_NEAR((probe.tool().position - placement.offset).norm(), 0, 1e-12);
    EXPECT_NEAR(probe.tool().orientation.angularDistance(placement.rotation), 0, 1e-7);
    EXPECT_NEAR((probe.tool().linear_velocity - motion.velocity).norm(), 0, 1e-12);
    world.run(probe, 5);
    EXPECT_NEAR((probe.tool().position - placement.offset).norm(), 0, 1e-12);
    EXPECT_EQ(probe.tool().linear_velocity, Vector3(Vector3::Zero())) << "no further call: it stands";
}

TEST_F(MovingBase, TurnsAndMovesEvenlyWithinAStepOfTheScene)
{
    ProbeWorld world;
    ScriptedDevice device = still_device();
    RenderSettings settings;
    settings.physics_rate = 100;
    HapticProbe probe(device, world.space, radius, settings);
    world.run(probe, 10);
    WorkspacePlacement placement = placed_at(0.1);
    placement.rotation = Quaternion(Eigen::AngleAxisd(0.3, Vector3::UnitZ()));
    probe.renderer().move_base(placement, {});
    for (const double part : {0.5, 1.0})
    {
        world.run(probe, 5);
        EXPECT_NEAR(probe.tool().position.x(), part * 0.1, 1e-9);
        EXPECT_NEAR(probe.tool().orientation.angularDistance(Quaternion::Identity()), part * 0.3, 1e-9);
    }
}

TEST_F(MovingBase, StaysWhereItIsPlacedAfterACallToMoveIt)
{
    for (const int ticks : {0, 3}) // of ten for a motion
    {
        ProbeWorld world;
        ScriptedDevice device = still_device();
        RenderSettings settings;
        settings.physics_rate = 100;
        HapticProbe probe(device, world.space, radius, settings);
        world.run(probe, 10);
        probe.renderer().move_base(placed_at(0.1), {});
        world.run(probe, ticks);
        probe.renderer().set_placement(placed_at(0.3));
        world.run(probe, 20);
        EXPECT_NEAR((probe.tool().position - placed_at(0.3).offset).norm(), 0, 1e-12) << ticks;
    }
}

TEST_F(MovingBase, RefusesAnotherScaleAndNonsense)
{
    ProbeWorld world;
    ScriptedDevice device = still_device();
    RenderSettings settings;
    settings.placement.scale = 2;
    settings.placement.force_scale = 3;
    HapticProbe probe(device, world.space, radius, settings);
    WorkspacePlacement placement = settings.placement;
    EXPECT_NO_THROW(probe.renderer().move_base(placement, {}));
    placement.scale = 1;
    EXPECT_THROW(probe.renderer().move_base(placement, {}), std::invalid_argument);
    placement = settings.placement;
    placement.force_scale = 1;
    EXPECT_THROW(probe.renderer().move_base(placement, {}), std::invalid_argument);
    placement = settings.placement;
    placement.offset.y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(probe.renderer().move_base(placement, {}), std::invalid_argument);
    BaseMotion motion;
    motion.spin.z() = std::numeric_limits<double>::infinity();
    EXPECT_THROW(probe.renderer().move_base(settings.placement, motion), std::invalid_argument);
    world.run(probe, 1);
    EXPECT_EQ(probe.tool().position, Vector3(Vector3::Zero()));
}
} // namespace
} // namespace ode_predictive_space::haptics
