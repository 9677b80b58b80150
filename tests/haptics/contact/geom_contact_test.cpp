// Contacts of a probe with a geom of the program, between two steps of the scene.

#include "ode_predictive_space/haptics/contact/nearby_geom.h"
#include "tests/haptics/contact/contact_fixture.h"

namespace ode_predictive_space::haptics
{
namespace
{
class GeomContact : public testing::Test
{
protected:
    NearbyGeom contact(double depth, const Vector3 &normal = Vector3::UnitZ()) const
    {
        dContactGeom found = {};
        found.pos[2] = 0.999;
        found.depth = depth;
        for (int axis = 0; axis < 3; ++axis)
            found.normal[axis] = normal.normalized()[axis];
        return NearbyGeom::at_contact(box_, found, tool_);
    }

    const OdeUse ode_;
    ProbeWorld world_;
    const dGeomID box_ = world_.add_box({1, 1, 1}, {0.2, 0.3, 0.5});
    const Vector3 tool_{0, 0, 1};
};

TEST_F(GeomContact, AtItsOwnPlaceAndTimeItIsWhatItWasMadeOf)
{
    const Touch touch = contact(0.002).touch_at(tool_);
    EXPECT_NEAR(touch.depth, 0.002, 1e-15);
    EXPECT_LE((touch.point - Vector3(0, 0, 0.999)).norm(), 1e-15);
    EXPECT_EQ(touch.object, object_of(box_));
    EXPECT_FALSE(touch.from_entry_side);
}

TEST_F(GeomContact, DepthFollowsTheToolAlongTheNormal)
{
    const NearbyGeom wall = contact(0.002, {1, 0, 1});
    const Touch deeper = wall.touch_at(tool_ + Vector3(-0.001, 0.7, -0.001));
    EXPECT_NEAR(deeper.depth, 0.002 + 0.001 * std::sqrt(2), 1e-15);
    EXPECT_NEAR(deeper.point.y(), 0.7, 1e-15) << "the contact goes with the tool along the surface";
    EXPECT_LT(wall.touch_at(tool_ + Vector3(0.002, 0, 0.001)).depth, 0) << "outside";
}

TEST_F(GeomContact, SurfacesMove)
{
    NearbyGeom wall = contact(-0.001); // 1 mm away
    wall.set_motion({Vector3::Zero(), {0.5, 0, 1}, Vector3::Zero()});
    EXPECT_LT(wall.later(0.0005).touch_at(tool_).depth, 0);
    const Touch touch = wall.later(0.003).touch_at(tool_);
    EXPECT_NEAR(touch.depth, 0.002, 1e-12);
    EXPECT_NEAR(touch.point.z(), 0.999 + 0.003, 1e-12);
}

TEST_F(GeomContact, AServoRendersAMovingPlateBetweenTheStepsOfTheScene)
{
    for (const bool proxy_law : {false, true})
    {
        ProbeWorld world;
        Material properties;
        properties.stiffness = k;
        RenderSettings rendering;
        rendering.law = std::make_shared<PenaltyLaw>(properties);
        if (proxy_law)
            rendering.law = std::make_shared<ProxyLaw>(properties);
        const dBodyID plate = world.add_body({0, 0, -0.05}, 1);
        dBodySetKinematic(plate);
        dGeomSetBody(world.add_box({1, 1, 0.1}, {0, 0, 0}), plate);
        dBodySetLinearVel(plate, 0, 0, 0.01);
        const auto height = [](double t) { return t < 0.3 ? 0.02 : 0.02 - 0.1 * (t - 0.3); };
        ScriptedDevice device([&](double t) { return Vector3(0.05, 0, height(t)); });
        HapticProbe probe(device, dCreateBox(world.space, 0.02, 0.02, 0.02), rendering);
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
        LoopSettings settings;
        settings.decoupled = true;
        settings.physics_rate = 100;
        settings.duration = 0.5;
        settings.ask_for_priority = false;
        settings.clock = &clock;
        HapticLoop loop(probe, settings);
        loop.run({[&] { world.collide(probe); }, [&](double dt) { world.step(dt); }});
        EXPECT_GT(compared, 40);
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
