#include "ode_predictive_space/haptics/touch_sensor.h"

#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/probe_world.h"

#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <stdexcept>

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

/// Flat ground whose samples the sensor does not have. It counts the heights that ODE reads.
class CountedGround
{
public:
    explicit CountedGround(dSpaceID space) : data_(dGeomHeightfieldDataCreate())
    {
        dGeomHeightfieldDataBuildCallback(data_, &reads, &read, 40, 40, 401, 401, 1, 0, 1, 0);
        dGeomHeightfieldDataSetBounds(data_, -1, 0);
        dMatrix3 upright;
        dRFromAxisAndAngle(upright, 1, 0, 0, std::acos(0.0));
        dGeomSetRotation(dCreateHeightfield(space, data_, 1), upright);
    }
    ~CountedGround() { dGeomHeightfieldDataDestroy(data_); }
    CountedGround(const CountedGround &) = delete;
    CountedGround &operator=(const CountedGround &) = delete;

    int reads = 0;

private:
    static dReal read(void *reads, int, int)
    {
        ++*static_cast<int *>(reads);
        return 0;
    }

    dHeightfieldDataID data_;
};

class TouchSensorTest : public testing::Test
{
protected:
    const std::vector<Touch> &look(TouchSensor &sensor, const Vector3 &position)
    {
        return look_as(sensor, at(position));
    }

    const std::vector<Touch> &look_as(TouchSensor &sensor, const ToolState &tool)
    {
        sensor.clear();
        sensor.pose(tool);
        dSpaceCollide(world_.space, &sensor, [](void *data, dGeomID first, dGeomID second) {
            static_cast<TouchSensor *>(data)->touch(first, second);
        });
        return sensor.touches();
    }

    const OdeUse ode_;
    ProbeWorld world_;
};

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

// The touch began a margin early.
TEST_F(TouchSensorTest, AGeomOfTheProgramTouchesTheSphereOfAnotherProbeWithoutItsMargin)
{
    TouchSensor sphere(world_.space, radius);
    TouchSensor box(dCreateBox(world_.space, 0.02, 0.02, 0.02));
    sphere.set_margin(0.005);
    look(sphere, {0, 0, 0});
    ASSERT_EQ(look(box, {0, 0, 0.018}).size(), 1U);
    EXPECT_NEAR(box.touches()[0].depth, 0.002, 1e-9);
}

// ODE's memory for a heightfield grows with the square of the triangles below a geom: a probe that lagged behind a fast hand in a
// slow scene took 22 GB.
TEST_F(TouchSensorTest, AFastToolReadsFewHeightsOfAHeightfield)
{
    for (const TouchView view : {TouchView::each_object_alone, TouchView::all_together})
    {
        CountedGround ground(world_.space);
        TouchSensor sensor(world_.space, radius);
        sensor.set_view(view);
        EXPECT_TRUE(look(sensor, {-1, 0, 0.5}).empty());
        ground.reads = 0;
        EXPECT_TRUE(look(sensor, {1, 0, 0.5}).empty());
        EXPECT_LT(ground.reads, 500);
    }
}

TEST_F(TouchSensorTest, AHeightfieldHoldsAToolThatPassesThroughItInOneTick)
{
    const CountedGround ground(world_.space);
    TouchSensor sensor(world_.space, radius);
    sensor.set_view(TouchView::all_together);
    EXPECT_TRUE(look(sensor, {0, 0, 0.3}).empty());
    ASSERT_EQ(look(sensor, {0.2, 0, -0.1}).size(), 1U);
    EXPECT_NEAR(sensor.touches()[0].depth, 0.1 + radius, 1e-9);
    EXPECT_NEAR(sensor.touches()[0].normal.z(), 1, 1e-9);
}

// Only ODE collides a probe that is not a sphere.
TEST_F(TouchSensorTest, OfAnObjectThatIsCollidedByOdeTheDeepestContactCounts)
{
    TouchSensor sensor(dCreateBox(world_.space, 0.02, 0.02, 0.02));
    const dBodyID body = dBodyCreate(world_.world);
    const double tops[] = {-0.003, 0, -0.002}; // the order in which a space reports them may differ
    for (const double top : tops)
    {
        const dGeomID box = dCreateBox(world_.space, 0.2, 0.2, 0.2);
        dGeomSetBody(box, body);
        dGeomSetOffsetWorldPosition(box, 0, 0, top - 0.1);
    }
    ASSERT_EQ(look(sensor, {0, 0, 0.005}).size(), 1U);
    EXPECT_NEAR(sensor.touches()[0].depth, 0.005, 1e-9);
}

TEST_F(TouchSensorTest, AGeomOfTheProgramTurnsWithTheTool)
{
    TouchSensor sensor(dCreateBox(world_.space, 0.02, 0.02, 0.06));
    world_.add_box({0.2, 0.2, 0.2}, {0, 0, -0.1});
    ToolState tool = at({0, 0, 0.025});
    EXPECT_EQ(look_as(sensor, tool).size(), 1U);
    tool.orientation = Quaternion(Eigen::AngleAxisd(std::acos(0.0), Vector3::UnitY()));
    EXPECT_TRUE(look_as(sensor, tool).empty());
    tool.orientation.setIdentity();
    EXPECT_EQ(look_as(sensor, tool).size(), 1U);
}

TEST_F(TouchSensorTest, AGeomOfTheProgramFeelsTheMaterialOfWhatItTouches)
{
    TouchSensor sensor(dCreateBox(world_.space, 0.02, 0.02, 0.02));
    world_.add_box({0.2, 0.2, 0.2}, {0, 0, -0.1});
    double stiffness = 300; // N/m
    sensor.set_materials([&](dGeomID) { return Material{stiffness}; });
    EXPECT_EQ(look(sensor, {0, 0, 0.008}).at(0).material.value().stiffness, 300);
    stiffness = -1;
    EXPECT_FALSE(look(sensor, {0, 0, 0.008}).at(0).material);
    EXPECT_TRUE(sensor.saw_nonsense());
    stiffness = 200;
    EXPECT_EQ(look(sensor, {0, 0, 0.008}).at(0).material.value().stiffness, 200);
    EXPECT_FALSE(sensor.saw_nonsense());
}

TEST_F(TouchSensorTest, AGeomOfTheProgramDoesNotTouchWhatItBeginsInUntilItHasLeft)
{
    TouchSensor sensor(dCreateBox(world_.space, 0.02, 0.02, 0.02));
    world_.add_box({0.2, 0.2, 0.2}, {0, 0, -0.1});
    sensor.forget_sides();
    for (const double z : {0.005, 0.009, 0.012})
        EXPECT_TRUE(look(sensor, {0, 0, z}).empty()) << z;
    EXPECT_EQ(look(sensor, {0, 0, 0.005}).size(), 1U);
}

TEST_F(TouchSensorTest, OfTooManyObjectsTheDeepestAreTouched)
{
    TouchSensor sensor(dCreateBox(world_.space, 0.02, 0.02, 0.02));
    constexpr int beyond = 4;
    for (int i = 0; i < static_cast<int>(touch_capacity) + beyond; ++i)
        world_.add_box({0.2, 0.2, 0.2}, {0, 0, 1e-5 * i - 0.1});
    world_.add_box({0.2, 0.2, 0.2}, {1, 0, -0.1});
    EXPECT_EQ(look(sensor, {0, 0, 0.009}).size(), touch_capacity);
    EXPECT_TRUE(sensor.exceeds_capacity());
    for (const Touch &touch : sensor.touches())
        EXPECT_GT(touch.depth, 0.001 + 1e-5 * (beyond - 0.5));
    EXPECT_EQ(look(sensor, {1, 0, 0.009}).size(), 1U);
    EXPECT_FALSE(sensor.exceeds_capacity());
}

TEST_F(TouchSensorTest, PushesATouchedBodyButDoesNotWakeItWithoutAForce)
{
    for (const bool own_geom : {false, true})
    {
        const dBodyID body = world_.add_moving_box({0.2, 0.2, 0.2}, {0, 0, -0.1}, 1);
        dBodyDisable(body);
        std::optional<TouchSensor> sensor;
        own_geom ? sensor.emplace(dCreateSphere(world_.space, radius)) : sensor.emplace(world_.space, radius);
        ASSERT_EQ(look(*sensor, {0, 0, 0.008}).size(), 1U);
        ForceShare share;
        share.object = sensor->touches()[0].object;
        sensor->push({share});
        EXPECT_EQ(dBodyIsEnabled(body), 0) << own_geom;
        share.force.z() = 3;
        sensor->push({share});
        EXPECT_EQ(dBodyIsEnabled(body), 1) << own_geom;
        EXPECT_EQ(dBodyGetForce(body)[2], -3) << own_geom;
        dGeomDestroy(dBodyGetFirstGeom(body));
        dBodyDestroy(body);
    }
}

TEST_F(TouchSensorTest, AfterAJumpNothingIsLeftOfThePlateThatHeldIt)
{
    TouchSensor sensor(world_.space, radius);
    world_.add_moving_box({0.2, 0.2, 0.001}, {0, 0, -0.0005}, 1);
    EXPECT_TRUE(look(sensor, {0, 0, 0.012}).empty());
    EXPECT_EQ(look(sensor, {0, 0, 0.005}).size(), 1U);
    sensor.forget_sides();
    EXPECT_TRUE(look(sensor, {0, 0, -0.02}).empty());
    sensor.forget_sides();
    EXPECT_EQ(look(sensor, {0, 0, radius - 5e-5}).size(), 1U) << "it begins on the plate, not in it";
}

TEST_F(TouchSensorTest, TheSphereOfAProbeInAnotherSpaceOfTheSceneMovesAsItsTool)
{
    const dSpaceID nested = dSimpleSpaceCreate(world_.space);
    TouchSensor other(nested, radius), sensor(world_.space, radius);
    ToolState tool;
    tool.linear_velocity = {0.1, 0.2, 0.3};
    other.pose(tool);
    ASSERT_EQ(look(sensor, {0, 0, 0.018}).size(), 1U);
    EXPECT_EQ(sensor.touches()[0].surface_velocity, tool.linear_velocity);
    dSpaceDestroy(nested);
    other.pose(tool);
    EXPECT_TRUE(look(sensor, {0, 0, 0.018}).empty()) << "it went with its space";
}

TEST_F(TouchSensorTest, AfterAnExceptionTheCallbackIsNotCalledAgain)
{
    const dSpaceID things = dSimpleSpaceCreate(world_.space);
    for (int i = 0; i < 3; ++i)
        dCreateSphere(things, 1);
    const dGeomID box = world_.add_box({1, 1, 1}, {0, 0, 0});
    int calls = 0;
    const auto near = [](void *count, dGeomID, dGeomID) {
        ++*static_cast<int *>(count);
        throw std::runtime_error("near callback");
    };
    EXPECT_THROW(safe_collide(things, &calls, near), std::runtime_error);
    EXPECT_EQ(calls, 1);
    EXPECT_THROW(safe_collide2(box, reinterpret_cast<dGeomID>(things), &calls, near), std::runtime_error);
    EXPECT_EQ(calls, 2);
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
