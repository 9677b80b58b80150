// What only those can see who make the space themselves: its stand-in for a hash space.

#include "ode_predictive_space/space/predictive_space.h"

#include <gtest/gtest.h>
#include <ode/ode.h>

#include "ode_predictive_space/predictive_space.h"
#include "tests/contract/support/ode_test.h"

namespace
{
class InPlaceOfAHashSpace : public testing::Test
{
protected:
    ode_predictive_space::OdeMessages messages_;
    dxPredictiveSpace *space_ = make();

    static dxPredictiveSpace *make()
    {
        auto *space = new dxPredictiveSpace(nullptr);
        space->type = dHashSpaceClass;
        return space;
    }

    void TearDown() override
    {
        dSpaceDestroy(space_);
        EXPECT_EQ(ode_predictive_space::OdeMessages::text(), "");
    }
};

void count(void *data, dGeomID, dGeomID)
{
    ++*static_cast<int *>(data);
}

TEST_F(InPlaceOfAHashSpace, 17_AnswersWithTheClassOfAHashSpace)
{
    EXPECT_EQ(dSpaceGetClass(space_), dHashSpaceClass);
    EXPECT_EQ(dSpaceIsPredictive(space_), 1);
}

TEST_F(InPlaceOfAHashSpace, 17_HasTheLevelsOfAHashSpace)
{
    int min_level = 0, max_level = 0;
    dHashSpaceGetLevels(space_, &min_level, &max_level);
    dSpaceID hash = dHashSpaceCreate(nullptr);
    int usual_min_level = 1, usual_max_level = 1;
    dHashSpaceGetLevels(hash, &usual_min_level, &usual_max_level);
    dSpaceDestroy(hash);
    EXPECT_EQ(min_level, usual_min_level);
    EXPECT_EQ(max_level, usual_max_level);
}

TEST_F(InPlaceOfAHashSpace, 17_TakesLevelsWithoutHarm)
{
    dGeomID ball = dCreateSphere(space_, 1);
    dGeomID other = dCreateSphere(space_, 1);
    for (int tick = 0; tick < 100; ++tick)
    {
        dHashSpaceSetLevels(space_, -tick, tick);
        dGeomSetPosition(ball, 0.1 * tick, 0, 0);
        dGeomSetPosition(other, 5, 0, 0);
        int pairs = 0;
        dSpaceCollide(space_, &pairs, &count);
        EXPECT_EQ(pairs, tick >= 30 && tick <= 70 ? 1 : 0) << "tick " << tick;
        EXPECT_EQ(dPredictiveSpaceValidate(space_), 1);
    }
    int min_level = 0, max_level = 0;
    dHashSpaceGetLevels(space_, &min_level, &max_level);
    EXPECT_EQ(min_level, -99);
    EXPECT_EQ(max_level, 99);
}
} // namespace
