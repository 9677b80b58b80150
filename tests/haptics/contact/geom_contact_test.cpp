// Contacts of a probe with a geom of the program, between two steps of the scene.

#include "ode_predictive_space/haptics/contact/nearby_geom.h"
#include "tests/haptics/contact/contact_fixture.h"

namespace ode_predictive_space::haptics
{
namespace
{
TEST(GeomContact, DepthFollowsTheToolAlongTheNormal)
{
    const OdeUse ode;
    ProbeWorld world;
    const Vector3 tool(0, 0, 1);
    dContactGeom found = {};
    found.pos[2] = 0.999;
    found.depth = 0.002;
    found.normal[0] = found.normal[2] = std::sqrt(0.5);
    const NearbyGeom wall = NearbyGeom::at_contact(world.add_box({1, 1, 1}, {0.2, 0.3, 0.5}), found, tool);
    const Touch deeper = wall.touch_at(tool + Vector3(-0.001, 0.7, -0.001));
    EXPECT_NEAR(deeper.depth, 0.002 + 0.001 * std::sqrt(2), 1e-15);
    EXPECT_NEAR(deeper.point.y(), 0.7, 1e-15) << "the contact goes with the tool along the surface";
    EXPECT_LT(wall.touch_at(tool + Vector3(0.002, 0, 0.001)).depth, 0) << "outside";
    NearbyGeom turning = wall;
    turning.set_motion({Vector3::Zero(), Vector3::Zero(), Vector3::UnitY()});
    EXPECT_NEAR(turning.later(0.001).touch_at(tool).depth, 0.002 + 0.001 * 0.999 * std::sqrt(0.5), 1e-12);
}

TEST(Mobility, TurnsWithTheBody)
{
    const OdeUse ode;
    ProbeWorld world;
    const dBodyID body = world.add_body({0, 0, 0}, 1);
    dMass mass;
    dMassSetBoxTotal(&mass, 1, 0.1, 0.02, 0.02);
    dBodySetMass(body, &mass);
    const double along_z = Mobility::of(body).along({0.05, 0, 0}, Vector3::UnitZ());
    const dQuaternion about_z = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
    dBodySetQuaternion(body, about_z);
    EXPECT_NEAR(Mobility::of(body).along({0, 0.05, 0}, Vector3::UnitZ()), along_z, 1e-9);
}

TEST(GeomContact, AServoRendersAMovingPlateBetweenTheStepsOfTheScene)
{
    const OdeUse ode;
    for (const bool proxy_law : {false, true})
    {
        ProbeWorld world;
        const dBodyID plate = world.add_body({0, 0, -0.05}, 1);
        dBodySetKinematic(plate);
        dGeomSetBody(world.add_box({1, 1, 0.1}, {0, 0, 0}), plate);
        dBodySetLinearVel(plate, 0, 0, 0.01);
        const auto height = [](double t) { return t < 0.3 ? 0.02 : 0.02 - 0.1 * (t - 0.3); };
        ScriptedDevice device([&](double t) { return Vector3(0.05, 0, height(t)); });
        HapticProbe probe(device, dCreateBox(world.space, 0.02, 0.02, 0.02),
                          with_law(make_law(proxy_law, Material{k})));
        int compared = 0;
        probe.set_recorder([&](const RenderedTick &tick) {
            const double depth = 0.01 * tick.time - (height(tick.time) - 0.01);
            if (depth > 0.0025 && depth < 0.01) // a step after the first contact
            {
                ++compared;
                EXPECT_NEAR(tick.requested.z(), k * depth, 1e-6) << tick.time;
            }
        });
        SimulatedClock clock;
        HapticLoop loop(probe, simulated(clock, 0.5, true, 100));
        loop.run(world.work(probe));
        EXPECT_GT(compared, 40);
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
