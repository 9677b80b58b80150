#include "ode_predictive_space/haptics/touch_sensor.h"

#include "tests/haptics/constants.h"
#include "tests/haptics/probe_world.h"

#include <gtest/gtest.h>
#include <optional>

namespace ode_predictive_space::haptics
{
namespace
{
ToolState at(const Vector3 &position)
{
    ToolState tool;
    tool.position = position;
    return tool;
}

class TouchSensorTest : public testing::Test
{
protected:
    /// One tick's look at the scene.
    const std::vector<Touch> &look(TouchSensor &sensor, const Vector3 &position)
    {
        sensor.clear();
        sensor.pose(at(position));
        dSpaceCollide(world_.space, &sensor, [](void *data, dGeomID first, dGeomID second) {
            static_cast<TouchSensor *>(data)->touch(first, second);
        });
        return sensor.touches();
    }

    const OdeUse ode_;
    ProbeWorld world_;
};

TEST_F(TouchSensorTest, TellsDepthPlaceAndDirection)
{
    TouchSensor sensor(world_.space, radius);
    const dGeomID box = world_.add_box({0.2, 0.2, 0.2}, {0, 0, -0.1});
    const auto &touches = look(sensor, {0.01, 0.02, 0.007});
    ASSERT_EQ(touches.size(), 1U);
    EXPECT_NEAR(touches[0].depth, 0.003, 1e-12);
    EXPECT_TRUE(touches[0].normal.isApprox(Vector3::UnitZ()));
    EXPECT_NEAR(touches[0].point.x(), 0.01, 1e-12);
    EXPECT_TRUE(touches[0].surface_velocity.isZero(0));
    EXPECT_EQ(touches[0].object, object_of(box));
    EXPECT_TRUE(look(sensor, {0, 0, 0.0101}).empty());
}

TEST_F(TouchSensorTest, TheSurfaceMovesAsTheBodyDoesAtThePoint)
{
    TouchSensor sensor(world_.space, radius);
    const dBodyID body = world_.add_moving_box({0.2, 0.2, 0.2}, {0, 0, -0.1}, 1);
    dBodySetLinearVel(body, 1, 0, 0);
    dBodySetAngularVel(body, 0, 0, 2);
    const auto &touches = look(sensor, {0, 0.05, 0.005});
    ASSERT_EQ(touches.size(), 1U);
    const Vector3 arm = touches[0].point - Vector3(0, 0, -0.1);
    EXPECT_TRUE(touches[0].surface_velocity.isApprox(Vector3(1, 0, 0) + Vector3(0, 0, 2).cross(arm)));
    EXPECT_EQ(touches[0].object, reinterpret_cast<std::uintptr_t>(body));
}

TEST_F(TouchSensorTest, TheMarginShowsWhatIsNearWithoutChangingDepths)
{
    TouchSensor sensor(world_.space, radius);
    world_.add_box({0.2, 0.2, 0.2}, {0, 0, -0.1});
    sensor.set_margin(0.005);
    ASSERT_EQ(look(sensor, {0, 0, 0.012}).size(), 1U);
    EXPECT_NEAR(sensor.touches()[0].depth, -0.002, 1e-12);
    EXPECT_NEAR(look(sensor, {0, 0, 0.008})[0].depth, 0.002, 1e-12);
    EXPECT_TRUE(look(sensor, {0, 0, 0.0151}).empty());
}

TEST_F(TouchSensorTest, ClaimsItsPairsAndNoOthers)
{
    TouchSensor sensor(world_.space, radius);
    const dGeomID one = world_.add_box({1, 1, 1}, {0, 0, 0});
    const dGeomID two = world_.add_box({1, 1, 1}, {0, 0, 0});
    const dSpaceID nested = dSimpleSpaceCreate(world_.space);
    EXPECT_TRUE(sensor.touch(one, sensor.geom()));
    EXPECT_TRUE(sensor.touch(sensor.geom(), two));
    EXPECT_FALSE(sensor.touch(one, two));
    EXPECT_FALSE(sensor.touch(sensor.geom(), reinterpret_cast<dGeomID>(nested))) << "the program is to descend into it";
}

TEST_F(TouchSensorTest, NonsenseIsSeenAndLeftOut)
{
    TouchSensor sensor(world_.space, radius);
    const dGeomID broken = add_broken_geom(world_.space);
    world_.add_box({0.2, 0.2, 0.2}, {0, 0, -0.1});
    EXPECT_EQ(look(sensor, {0, 0, 0.005}).size(), 1U);
    EXPECT_TRUE(sensor.saw_nonsense());
    dGeomDestroy(broken);
    look(sensor, {0, 0, 0.005});
    EXPECT_FALSE(sensor.saw_nonsense());
}

TEST_F(TouchSensorTest, ABodyWhoseVelocityIsNotANumberIsNonsense)
{
    TouchSensor sensor(world_.space, radius);
    const dBodyID body = world_.add_moving_box({0.2, 0.2, 0.2}, {0, 0, -0.1}, 1);
    dBodySetLinearVel(body, std::numeric_limits<dReal>::quiet_NaN(), 0, 0);
    EXPECT_TRUE(look(sensor, {0, 0, 0.005}).empty());
    EXPECT_TRUE(sensor.saw_nonsense());
}

TEST_F(TouchSensorTest, ABodyThatIsGoneIsNotPushed)
{
    TouchSensor sensor(world_.space, radius);
    const dBodyID gone = world_.add_moving_box({0.2, 0.2, 0.2}, {-0.1, 0, -0.1}, 1);
    const dBodyID there = world_.add_moving_box({0.2, 0.2, 0.2}, {0.1, 0, -0.1}, 1);
    ASSERT_EQ(look(sensor, {0, 0, 0.005}).size(), 2U);
    const Vector3 force = {0, 0, 2};
    const std::vector<ForceShare> shares = {{reinterpret_cast<std::uintptr_t>(gone), {0, 0, 0}, force},
                                            {reinterpret_cast<std::uintptr_t>(there), {0.1, 0, 0}, force}};
    dGeomDestroy(dBodyGetFirstGeom(gone));
    dBodyDestroy(gone);
    sensor.push(shares);
    EXPECT_EQ(dBodyGetForce(there)[2], -2);
    EXPECT_EQ(look(sensor, {0, 0, 0.005}).size(), 1U);
}

TEST_F(TouchSensorTest, AGeomOfTheProgramStaysWhenTheSensorGoes)
{
    const dGeomID geom = dCreateBox(world_.space, 0.02, 0.02, 0.02);
    std::optional<TouchSensor> sensor;
    sensor.emplace(geom);
    world_.add_box({0.2, 0.2, 0.2}, {0, 0, -0.1});
    EXPECT_EQ(look(*sensor, {0, 0, 0.005}).size(), 1U);
    sensor->set_margin(0.01);
    EXPECT_NEAR(sensor->touches()[0].depth, 0.005, 1e-9) << "it cannot be larger than it is";
    sensor.reset();
    EXPECT_EQ(dSpaceQuery(world_.space, geom), 1);
    EXPECT_EQ(dSpaceGetNumGeoms(world_.space), 2);
    sensor.emplace(world_.space, radius);
    EXPECT_EQ(dSpaceGetNumGeoms(world_.space), 3);
    sensor.reset();
    EXPECT_EQ(dSpaceGetNumGeoms(world_.space), 2) << "its own goes with it";
}
} // namespace
} // namespace ode_predictive_space::haptics
