#include "ode_predictive_space/broadphase/base/batch.h"

#include <gtest/gtest.h>

namespace ode_predictive_space
{
namespace
{
using Ids = std::vector<ProxyId>;

struct BatchTest : testing::Test
{
    BatchTest() { batch.resize(2000); }

    void add(const Ids &ids)
    {
        for (ProxyId id : ids)
            batch.add(id);
    }

    Batch batch;
};

TEST_F(BatchTest, HasEachObjectOnceInTheOrderOfItsFirstAddition)
{
    EXPECT_TRUE(batch.empty());
    add({7, 3, 7, 1999, 3, 0});
    EXPECT_EQ(batch.ids(), (Ids{7, 3, 1999, 0}));
    EXPECT_EQ(batch.size(), 4u);
    EXPECT_FALSE(batch.empty());
}

TEST_F(BatchTest, IsASetOfTheSameObjects)
{
    add({7, 3, 1999});
    Ids members;
    batch.members().for_each([&](ProxyId id) { members.push_back(id); });
    EXPECT_EQ(members, (Ids{3, 7, 1999}));
    EXPECT_TRUE(batch.contains(1999));
    EXPECT_FALSE(batch.contains(0));
}

TEST_F(BatchTest, AllLieAnywhereUnlessNeighboursBegin)
{
    EXPECT_EQ(batch.single(), 0u);
    add({7, 3});
    EXPECT_EQ(batch.single(), 2u);
    batch.begin_neighbours();
    add({4, 5, 7});
    EXPECT_EQ(batch.single(), 2u);
    EXPECT_EQ(batch.ids(), (Ids{7, 3, 4, 5}));
    batch.clear();
    add({4, 5, 6});
    EXPECT_EQ(batch.single(), 3u) << "the next batch has no neighbours yet";
}

TEST_F(BatchTest, ClearedItIsEmptyAndTakesTheSameObjectsAgain)
{
    add({7, 3});
    batch.clear();
    EXPECT_TRUE(batch.empty());
    EXPECT_TRUE(batch.members().empty());
    add({3});
    EXPECT_EQ(batch.ids(), Ids{3});
}
} // namespace
} // namespace ode_predictive_space
