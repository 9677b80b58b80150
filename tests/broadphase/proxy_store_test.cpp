#include "ode_predictive_space/broadphase/objects/proxy_store.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace ode_predictive_space
{
namespace
{
TEST(ProxyStore, ANumberIsUsedAgainWithNothingLeft)
{
    ProxyStore store;
    const ProxyId first = store.add(), second = store.add();
    EXPECT_EQ(store.count(), 2u);
    store.places[first].set_envelope({Float4::all(-1), Float4::all(1)});
    store.places[first].note_move(7);
    store.records[first].role = Role::fixed_interactive;
    store.records[first].reach = 1;
    store.remove(first);
    EXPECT_EQ(store.count(), 1u);
    EXPECT_FALSE(store.members().contains(first));
    EXPECT_TRUE(store.members().contains(second));
    EXPECT_EQ(store.add(), first);
    EXPECT_EQ(store.size(), 2u);
    EXPECT_EQ(store.count(), 2u);
    EXPECT_FALSE(store.places[first].has_envelope());
    EXPECT_EQ(store.places[first].moved(), 0u);
    EXPECT_EQ(store.places[first].watch(), Watch::look);
    EXPECT_EQ(store.records[first].role, Role::environment);
    EXPECT_EQ(store.records[first].reach, 0);
    EXPECT_EQ(store.records[first].shelf, Shelf::none);
}

TEST(ProxyStore, APlaceAndARecordAreALineEach)
{
    ProxyStore store;
    for (int i = 0; i < 100; ++i)
    {
        const ProxyId id = store.add();
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(&store.places[id]) % 64, 0u);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(&store.records[id]) % 64, 0u);
    }
}

TEST(ProxyStore, TrimmedItGivesBackTheMemoryOfNumbersThatAreNotNeeded)
{
    ProxyStore store;
    EXPECT_EQ(store.needed_size(), 0u);
    for (int i = 0; i < 1000; ++i)
        store.add();
    const std::size_t before = store.bytes();
    for (ProxyId id = 0; id < 1000; ++id)
        if (id != 2 && id != 9)
            store.remove(id);
    EXPECT_EQ(store.needed_size(), 10u);
    EXPECT_EQ(store.size(), 1000u);
    store.trim();
    EXPECT_EQ(store.size(), 10u);
    EXPECT_LT(store.bytes(), before / 50);
    std::vector<ProxyId> added;
    for (int i = 0; i < 9; ++i)
        added.push_back(store.add());
    std::sort(added.begin(), added.end());
    EXPECT_EQ(added, (std::vector<ProxyId>{0, 1, 3, 4, 5, 6, 7, 8, 10})) << "first those that were free";
    EXPECT_EQ(store.count(), 11u);
}
} // namespace
} // namespace ode_predictive_space
