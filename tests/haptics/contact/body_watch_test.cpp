#include "ode_predictive_space/haptics/contact/body_watch.h"

#include "tests/haptics/support/probe_world.h"

#include <gtest/gtest.h>
#include <memory>

namespace ode_predictive_space::haptics
{
namespace
{
const Vector3 push_force = {1, 2, 3}; // N

std::uintptr_t name(dBodyID body)
{
    return reinterpret_cast<std::uintptr_t>(body);
}

Vector3 force_on(dBodyID body)
{
    const dReal *force = dBodyGetForce(body);
    return {force[0], force[1], force[2]};
}

class BodyWatchTest : public testing::Test
{
protected:
    const OdeUse ode_;
    ProbeWorld world_;
    BodyWatch watch_;
};

TEST_F(BodyWatchTest, PushesWhatItKeepsWhereItIsTold)
{
    const dBodyID body = world_.add_body({1, 0, 0}, 2);
    dBodyDisable(body);
    watch_.keep(body);
    EXPECT_EQ(dBodyIsEnabled(body), 0) << "to be watched is not to be pushed";
    EXPECT_TRUE(watch_.push(name(body), push_force, {0, 0, 0.5}));
    EXPECT_EQ(force_on(body), push_force);
    const dReal *torque = dBodyGetTorque(body);
    EXPECT_EQ(Vector3(torque[0], torque[1], torque[2]), Vector3(0, 0, 0.5).cross(push_force));
    EXPECT_NE(dBodyIsEnabled(body), 0);
}

TEST_F(BodyWatchTest, ForgetsWhatWasNotTouchedForLong)
{
    const dBodyID touched = world_.add_body({0, 0, 0}, 2);
    const dBodyID left = world_.add_body({0, 0, 0}, 2);
    watch_.keep(left);
    for (int tick = 0; tick < 200; ++tick)
    {
        watch_.age();
        watch_.keep(touched);
    }
    for (int tick = 0; tick < 50; ++tick)
        watch_.age();
    EXPECT_TRUE(watch_.push(name(touched), push_force, {0, 0, 0}));
    EXPECT_EQ(dBodyGetNumJoints(touched), 1) << "kept once, however often it was touched";
    EXPECT_FALSE(watch_.push(name(left), push_force, {0, 0, 0}));
    EXPECT_EQ(dBodyGetNumJoints(left), 0);
}

TEST_F(BodyWatchTest, ANewBodyMayHaveTheAddressOfOneThatIsGone)
{
    const dBodyID other = world_.add_body({0, 0, 0}, 1);
    watch_.keep(other);
    for (int i = 0; i < 20; ++i)
    {
        const dBodyID body = world_.add_body({0, 0, 0}, 1);
        EXPECT_FALSE(watch_.push(name(body), push_force, {0, 0, 0})) << i;
        watch_.keep(body);
        EXPECT_TRUE(watch_.push(name(body), push_force, {0, 0, 0})) << i;
        dBodyDestroy(body);
        EXPECT_FALSE(watch_.push(name(body), push_force, {0, 0, 0})) << i;
    }
    EXPECT_TRUE(watch_.push(name(other), push_force, {0, 0, 0}));
}

TEST_F(BodyWatchTest, AWorldMayGoBeforeItsWatch)
{
    auto world = std::make_unique<ProbeWorld>();
    const dBodyID body = world->add_body({0, 0, 0}, 1);
    watch_.keep(body);
    world.reset();
    EXPECT_FALSE(watch_.push(name(body), push_force, {0, 0, 0}));
    watch_.age();
    const dBodyID another = world_.add_body({0, 0, 0}, 1);
    watch_.keep(another);
    EXPECT_TRUE(watch_.push(name(another), push_force, {0, 0, 0}));
}
} // namespace
} // namespace ode_predictive_space::haptics
