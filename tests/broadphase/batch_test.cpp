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
    for (ProxyId id = 0; id < 2000; ++id)
        EXPECT_EQ(batch.contains(id), id == 3 || id == 7 || id == 1999);
}

TEST_F(BatchTest, ClearedItIsEmptyAndTakesTheSameObjectsAgain)
{
    add({7, 3});
    batch.clear();
    EXPECT_TRUE(batch.empty());
    EXPECT_FALSE(batch.contains(7));
    add({3});
    EXPECT_EQ(batch.ids(), Ids{3});
}
} // namespace
} // namespace ode_predictive_space
