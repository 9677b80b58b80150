// Contact with very light bodies in two threads. In simulated time both run in one, so that all runs are alike.

#include "ode_predictive_space/haptics/loop.h"

#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/probe_world.h"
#include "tests/haptics/support/scripted_device.h"

#include <cmath>
#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double side = 0.06; // m

class LightBodyTest : public testing::TestWithParam<bool>
{
protected:
    dBodyID add_cube(const Vector3 &position, double kilograms)
    {
        const dBodyID body = world_.add_moving_box({side, side, side}, position, kilograms);
        dMass mass;
        dMassSetBoxTotal(&mass, kilograms, side, side, side);
        dBodySetMass(body, &mass);
        return body;
    }

    void run(Device &device, double stiffness, double rate, double physics_rate, double duration,
             const std::function<void(const RenderedTick &)> &recorder = {},
             const std::function<void(double)> &each_step = {})
    {
        HapticProbe probe(device, world_.space, radius, with_law(make_law(GetParam(), Material{stiffness})));
        probe.set_recorder(recorder);
        LoopSettings settings = simulated(clock_, duration, true, physics_rate);
        settings.rate = rate;
        HapticLoop loop(probe, settings);
        loop.run(world_.work(probe, each_step));
    }

    const OdeUse ode_;
    SimulatedClock clock_;
    ProbeWorld world_;
};

ScriptedDevice::Path push_at(double speed, double start)
{
    return [=](double seconds) -> Vector3 { return {start + speed * std::max(0.0, seconds - 1), 0, 0}; };
}

// A hand of constant speed is a wall with a spring: the body bounces off it at twice the hand's speed.
TEST_P(LightBodyTest, AFreeBodyLeavesAHandOfConstantSpeedAtTwiceItsSpeed)
{
    constexpr double speed = 0.1; // m/s
    for (const double stiffness : {200.0, 500.0})
    {
        for (const double physics_rate : {100.0, 200.0, 1000.0})
        {
            for (const double kilograms : {0.01, 0.02, 0.05, 0.2, 1.0})
            {
                for (const double gap :
                     {0.0061, 0.0067}) // m; the contact begins at different moments between two steps
                {
                    SCOPED_TRACE(std::to_string(kilograms) + " kg, " + std::to_string(physics_rate) + " Hz, " +
                                 std::to_string(stiffness) + " N/m");
                    const dBodyID body = add_cube({side / 2 + gap, 0, 0}, kilograms);
                    clock_.advance(1);
                    ScriptedDevice device(push_at(speed, -radius));
                    run(device, stiffness, 1000, physics_rate, 1.6);
                    world_.step(1 / physics_rate); // the hand's last impulse is pending
                    const double ratio = dBodyGetLinearVel(body)[0] / speed;
                    EXPECT_LE(ratio, 2.05);
                    EXPECT_GE(ratio, 1.95);
                    dGeomDestroy(dBodyGetFirstGeom(body));
                    dBodyDestroy(body);
                }
            }
        }
    }
}

double press_depth(double seconds)
{
    const double t = seconds - 1;
    return t < 0      ? -0.005
           : t < 0.25 ? -0.005 + 0.03 * t
                      : 0.0025 - 0.0015 * std::sin(2 * M_PI * 1.5 * (t - 0.25) + M_PI);
}

class HeldBodyTest : public LightBodyTest
{
protected:
    /// The largest relative error of the force, compared with stiffness times depth.
    /// @param towards the hand's direction; the body is supported on that side.
    double worst_error(dBodyID body, const Vector3 &towards, double stiffness, double physics_rate)
    {
        const Vector3 centre = place_of(body);
        const Vector3 contact = centre - towards * (side / 2 + radius);
        ScriptedDevice device([=](double seconds) -> Vector3 { return contact + press_depth(seconds) * towards; });
        double worst = 0;
        Vector3 surface = contact; // m; place at which the tool just touches the body
        int compared = 0;
        const auto compare = [&](const RenderedTick &tick) {
            if (tick.time > 1.5)
            {
                const double depth = (tick.tool.position - surface).dot(towards);
                worst = std::max(worst, std::abs(-tick.force.dot(towards) / (stiffness * depth) - 1));
                ++compared;
            }
        };
        run(device, stiffness, 1000, physics_rate, 3, compare,
            [&](double) { surface = place_of(body) - towards * (side / 2 + radius); });
        EXPECT_GT(compared, 1000);
        return worst;
    }

    void expect_the_stiffness_of_the_wall(const Vector3 &place, const Vector3 &towards)
    {
        for (const double stiffness : {200.0, 500.0})
        {
            for (const double physics_rate : {100.0, 200.0, 1000.0})
            {
                for (const double kilograms : {0.01, 0.02, 0.05, 0.2, 1.0})
                {
                    SCOPED_TRACE(std::to_string(kilograms) + " kg, " + std::to_string(physics_rate) + " Hz, " +
                                 std::to_string(stiffness) + " N/m");
                    const dBodyID body = add_cube(place, kilograms);
                    clock_.advance(1);
                    EXPECT_LE(worst_error(body, towards, stiffness, physics_rate), 0.02);
                    dGeomDestroy(dBodyGetFirstGeom(body));
                    dBodyDestroy(body);
                }
            }
        }
    }

    static Vector3 place_of(dBodyID body)
    {
        const dReal *position = dBodyGetPosition(body);
        return {position[0], position[1], position[2]};
    }
};

TEST_P(HeldBodyTest, ABodyAgainstAWallIsAsStiffAsTheWall)
{
    dCreatePlane(world_.space, -1, 0, 0, -side);
    expect_the_stiffness_of_the_wall({side / 2, 0, 0}, Vector3::UnitX());
}

std::string name_of_law(const testing::TestParamInfo<bool> &law)
{
    return law.param ? "Proxy" : "Penalty";
}

INSTANTIATE_TEST_SUITE_P(Laws, LightBodyTest, testing::Bool(), name_of_law);
INSTANTIATE_TEST_SUITE_P(Laws, HeldBodyTest, testing::Bool(), name_of_law);
} // namespace
} // namespace ode_predictive_space::haptics
