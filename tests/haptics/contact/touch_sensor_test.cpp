#include "ode_predictive_space/haptics/touch_sensor.h"

#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/probe_world.h"

#include <cmath>
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
