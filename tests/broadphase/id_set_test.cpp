#include "ode_predictive_space/broadphase/base/id_set.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
std::vector<ProxyId> members(const IdSet &set)
{
    std::vector<ProxyId> found;
    set.for_each([&](ProxyId id) { found.push_back(id); });
    return found;
}

TEST(IdSet, BehavesAsASetDoes)
{
    Random random(1);
    IdSet set;
    std::set<ProxyId> reference;
    std::size_t room = 0;
    for (int step = 0; step < 20000; ++step)
    {
        if (room == 0 || random.chance(0.01))
            set.resize(room += 1 + random.index(70));
        const ProxyId id = static_cast<ProxyId>(random.index(room));
        if (random.chance(0.5))
        {
            set.insert(id);
            reference.insert(id);
        }
        else
        {
            set.erase(id);
            reference.erase(id);
        }
        if (random.chance(0.001))
        {
            set.clear();
            reference.clear();
        }
        ASSERT_EQ(set.contains(id), reference.count(id) == 1);
        ASSERT_EQ(set.size(), reference.size());
        ASSERT_EQ(set.empty(), reference.empty());
        if (step % 64 == 0)
        {
            ASSERT_EQ(members(set), std::vector<ProxyId>(reference.begin(), reference.end()));
        }
    }
}

TEST(IdSet, IsWalkedInAscendingOrderWhateverOrderItWasFilledIn)
{
    IdSet set;
    set.resize(200);
    for (ProxyId id : {199u, 64u, 0u, 63u, 127u, 128u, 65u})
        set.insert(id);
    EXPECT_EQ(members(set), (std::vector<ProxyId>{0, 63, 64, 65, 127, 128, 199}));
}

TEST(IdSet, HasRoomForExactlyTheNumbersAskedFor)
{
    IdSet set;
    EXPECT_EQ(set.words(), 0u);
    EXPECT_TRUE(set.empty());
    set.resize(64);
    EXPECT_EQ(set.words(), 1u);
    set.insert(63);
    set.resize(65);
    EXPECT_EQ(set.words(), 2u);
    EXPECT_TRUE(set.contains(63)) << "members stay when the set grows";
    EXPECT_FALSE(set.contains(64));
}

TEST(IdSet, ShrunkItKeepsItsMembersAndGivesMemoryBack)
{
    IdSet set;
    set.resize(10000);
    set.insert(3);
    set.insert(9999);
    set.resize(64);
    EXPECT_EQ(members(set), std::vector<ProxyId>{3});
    EXPECT_EQ(set.bytes(), sizeof(std::uint64_t));
}

TEST(IdSet, IsReadAWordAtATime)
{
    IdSet set;
    set.resize(130);
    set.insert(64);
    set.insert(65);
    set.insert(127);
    EXPECT_EQ(members(set), (std::vector<ProxyId>{64, 65, 127}));
    EXPECT_EQ(set.word(1), 0x8000000000000003u);
    EXPECT_EQ(IdSet::count(set.word(1)), 3u);
    EXPECT_EQ(IdSet::count(0), 0u);
    std::vector<ProxyId> visited;
    IdSet::visit_word(2, 0x11, [&](ProxyId id) { visited.push_back(id); });
    EXPECT_EQ(visited, (std::vector<ProxyId>{128, 132}));
}
} // namespace
} // namespace ode_predictive_space
