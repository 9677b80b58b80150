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

TEST(IdSet, KeepsItsMembersWhenItGrows)
{
    IdSet set;
    set.resize(64);
    set.insert(63);
    set.resize(65);
    EXPECT_TRUE(set.contains(63));
    EXPECT_FALSE(set.contains(64));
}

} // namespace
} // namespace ode_predictive_space
