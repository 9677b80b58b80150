#include "ode_predictive_space/broadphase/base/id_list.h"

#include <vector>

#include <gtest/gtest.h>

namespace ode_predictive_space
{
namespace
{
TEST(IdList, KeepsTheOrderInWhichObjectsWereAdded)
{
    IdList list;
    EXPECT_TRUE(list.empty());
    list.resize(10);
    EXPECT_TRUE(list.empty());
    for (ProxyId id : {9u, 0u, 4u})
        list.add(id);
    EXPECT_EQ(std::vector<ProxyId>(list.begin(), list.end()), (std::vector<ProxyId>{9, 0, 4}));
    EXPECT_EQ(list.size(), 3u);
    EXPECT_EQ(list.data(), list.begin());
    EXPECT_FALSE(list.empty());
}

TEST(IdList, HasRoomForAllObjects)
{
    IdList list;
    list.resize(1000);
    const std::size_t before = list.bytes();
    EXPECT_GE(before, 1000 * sizeof(ProxyId));
    for (int round = 0; round < 3; ++round)
    {
        for (ProxyId id = 0; id < 1000; ++id)
            list.add(id);
        EXPECT_EQ(list.size(), 1000u);
        list.clear();
        EXPECT_TRUE(list.empty());
    }
    EXPECT_EQ(list.bytes(), before) << "adding takes no memory";
}

TEST(IdList, ResizedItKeepsWhatItHasRoomForAndGivesMemoryBack)
{
    IdList list;
    list.resize(1000);
    for (ProxyId id : {5, 3, 7})
        list.add(id);
    list.resize(2000);
    EXPECT_EQ(std::vector<ProxyId>(list.begin(), list.end()), (std::vector<ProxyId>{5, 3, 7}));
    list.resize(2);
    EXPECT_EQ(std::vector<ProxyId>(list.begin(), list.end()), (std::vector<ProxyId>{5, 3}));
    EXPECT_EQ(list.bytes(), 2 * sizeof(ProxyId));
}
} // namespace
} // namespace ode_predictive_space
