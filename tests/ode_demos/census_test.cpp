#include "demos/ode/census.h"

#include <gtest/gtest.h>
#include <limits>

namespace ode_predictive_space::ode_demos
{
namespace
{
class CensusTest : public testing::Test
{
protected:
    CensusTest()
    {
        dInitODE2(0);
        world_ = dWorldCreate();
        contacts_ = dJointGroupCreate(0);
        space_ = dSimpleSpaceCreate(nullptr);
    }

    ~CensusTest() override
    {
        dJointGroupDestroy(contacts_);
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
        dCloseODE();
    }

    dBodyID add_ball(dSpaceID space, dReal height)
    {
        const dBodyID body = dBodyCreate(world_);
        dGeomSetBody(dCreateSphere(space, 1), body);
        dBodySetPosition(body, 0, 0, height);
        return body;
    }

    void add_contact(dBodyID first, dBodyID second)
    {
        dContact contact{};
        dJointAttach(dJointCreateContact(world_, contacts_, &contact), first, second);
    }

    dWorldID world_;
    dJointGroupID contacts_;
    dSpaceID space_;
};

TEST_F(CensusTest, CountsABodyOnceHoweverManyGeomsItHas)
{
    dCreatePlane(space_, 0, 0, 1, 0);
    const dBodyID body = add_ball(space_, 3);
    dGeomSetBody(dCreateBox(space_, 1, 1, 1), body);
    dBodyDisable(add_ball(space_, 5));

    const Census census = take_census(space_);

    EXPECT_EQ(census.geoms, 4);
    EXPECT_EQ(census.bodies, 2);
    EXPECT_EQ(census.resting, 1);
    EXPECT_EQ(census.mean_height, 4);
    EXPECT_EQ(census.centres.min().z(), 3);
    EXPECT_EQ(census.centres.max().z(), 5);
    EXPECT_TRUE(census.finite);
}

TEST_F(CensusTest, LooksIntoNestedSpaces)
{
    add_ball(dHashSpaceCreate(space_), 1);

    EXPECT_EQ(take_census(space_).geoms, 1);
    EXPECT_EQ(take_census(space_).bodies, 1);
}

TEST_F(CensusTest, CountsContactsWithTheGroundAndBetweenBodiesAlike)
{
    const dBodyID first = add_ball(space_, 1);
    const dBodyID second = add_ball(space_, 2);
    add_contact(first, second);
    add_contact(first, nullptr);
    add_contact(nullptr, second);
    dJointAttach(dJointCreateBall(world_, nullptr), first, second);

    EXPECT_EQ(take_census(space_).contacts, 3);
}

TEST_F(CensusTest, SeesWhatIsNoNumber)
{
    const dBodyID body = add_ball(space_, 1);
    dBodySetLinearVel(body, 0, std::numeric_limits<dReal>::quiet_NaN(), 0);
    EXPECT_FALSE(take_census(space_).finite);
    dBodySetLinearVel(body, 0, 0, 0);
    EXPECT_TRUE(take_census(space_).finite);
    dBodySetPosition(body, std::numeric_limits<dReal>::infinity(), 0, 0);
    EXPECT_FALSE(take_census(space_).finite);
}

TEST_F(CensusTest, CountsWhatIsInAQuadtree)
{
    const dVector3 middle = {0, 0, 0};
    const dVector3 extents = {5, 5, 5};
    const dSpaceID quadtree = dQuadTreeSpaceCreate(space_, middle, extents, 3);
    dCreatePlane(quadtree, 0, 0, 1, 0);
    add_ball(quadtree, 100);
    add_ball(dHashSpaceCreate(quadtree), 1);

    EXPECT_EQ(take_census(space_).geoms, 3);
    EXPECT_EQ(take_census(space_).bodies, 2);
    EXPECT_TRUE(take_census(space_).finite);
}
} // namespace
} // namespace ode_predictive_space::ode_demos
