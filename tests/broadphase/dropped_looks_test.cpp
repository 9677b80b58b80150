// Looks of dropped pairs: each comes back for its own pair, in whichever order its objects are, and for no other.

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/near/dropped_looks.h"

namespace ode_predictive_space
{
namespace
{
Look look_of(ProxyId first, ProxyId second)
{
    Look look;
    look.due = 1000.0 * first + second;
    look.axis[0] = 1;
    look.axis[1] = -2;
    return look;
}

// One object among many, and pairs of neighbours: most have an object in common with another.
class DroppedLooksTest : public testing::Test
{
protected:
    static constexpr ProxyId objects = 100;

    DroppedLooksTest()
    {
        for (ProxyId i = 1; i < objects; i += 2)
            add({0, i});
        for (ProxyId i = 1; i + 2 < objects; i += 3)
            add({i + 2, i});
        looks_.prepare();
    }

    void add(const CandidatePair &pair)
    {
        added_[pair.first][pair.second] = true;
        looks_.add(pair, look_of(pair.first, pair.second));
    }

    DroppedLooks looks_;
    bool added_[objects][objects] = {};
};

TEST_F(DroppedLooksTest, AreFoundForTheirOwnPairAlone)
{
    for (ProxyId first = 0; first < objects; ++first)
        for (ProxyId second = 0; second < objects; ++second)
        {
            const Look *look = first == second || added_[second][first] ? nullptr : looks_.find({first, second});
            ASSERT_EQ(look != nullptr, added_[first][second]) << first << " " << second;
            if (look)
            {
                EXPECT_EQ(look->due, look_of(first, second).due);
                EXPECT_EQ(look->axis[1], -2);
            }
        }
}

TEST_F(DroppedLooksTest, OfAPairInTheOtherOrderPointTheOtherWay)
{
    for (int times = 0; times < 2; ++times)
    {
        const Look *look = looks_.find({1, 3});
        ASSERT_NE(look, nullptr);
        EXPECT_EQ(look->due, look_of(3, 1).due);
        EXPECT_EQ(look->axis[0], -1);
        EXPECT_EQ(look->axis[1], 2);
    }
    EXPECT_EQ(looks_.find({3, 1})->axis[1], -2) << "and back";
}

TEST_F(DroppedLooksTest, AreNoneAfterTheyWereTaken)
{
    looks_.clear();
    EXPECT_TRUE(looks_.empty());
    looks_.add({5, 6}, look_of(5, 6));
    looks_.prepare();
    EXPECT_EQ(looks_.find({0, 1}), nullptr);
    EXPECT_NE(looks_.find({5, 6}), nullptr);
}
} // namespace
} // namespace ode_predictive_space
