#include "ode_predictive_space/broadphase/near_set.h"

#include <gtest/gtest.h>

#include <map>

namespace ode_predictive_space
{
namespace
{
using Verdict = NearSet::Verdict;

NearPair pair_of(ProxyId first, ProxyId second)
{
    return {first, second, 0, 0, 0, false};
}

// The pairs 0 1, 1 2, 2 3, 3 4.
class NearSetTest : public testing::Test
{
protected:
    NearSetTest()
    {
        set.resize(5);
        for (ProxyId id = 0; id < 4; ++id)
            set.add(pair_of(id, id + 1));
    }

    // Those whose first is even are together.
    void let_all_rest()
    {
        set.let_rest([](const NearPair &pair) { return pair.first % 2 == 0 ? Verdict::together : Verdict::apart; });
    }

    // Verdicts by first of the pair.
    std::map<ProxyId, Verdict> verdicts() const
    {
        std::map<ProxyId, Verdict> found;
        set.for_all(
            [&](const NearPair &pair, Verdict verdict) { EXPECT_TRUE(found.emplace(pair.first, verdict).second); });
        return found;
    }

    static std::vector<ProxyId> firsts(const std::vector<NearPair> &pairs)
    {
        std::vector<ProxyId> ids;
        for (const NearPair &pair : pairs)
            ids.push_back(pair.first);
        return ids;
    }

    NearSet set;
};

TEST_F(NearSetTest, WhatRestsIsNotTestedAndStaysAMember)
{
    let_all_rest();
    EXPECT_TRUE(set.pairs().empty());
    EXPECT_EQ(firsts(set.together()), (std::vector<ProxyId>{0, 2}));
    EXPECT_EQ(set.members().size(), 5u);
    EXPECT_EQ(verdicts(),
              (std::map<ProxyId, Verdict>{
                  {0, Verdict::together}, {1, Verdict::apart}, {2, Verdict::together}, {3, Verdict::apart}}));
}

TEST_F(NearSetTest, OpenPairsAreTestedOn)
{
    set.let_rest([](const NearPair &pair) { return pair.first == 1 ? Verdict::together : Verdict::open; });
    EXPECT_EQ(firsts(set.pairs()), (std::vector<ProxyId>{0, 2, 3}));
    EXPECT_EQ(firsts(set.together()), (std::vector<ProxyId>{1}));
}

TEST_F(NearSetTest, ADisturbedObjectHasItsPairsTestedAndNoOthers)
{
    let_all_rest();
    set.disturb(1);
    EXPECT_EQ(verdicts(), (std::map<ProxyId, Verdict>{
                              {0, Verdict::open}, {1, Verdict::open}, {2, Verdict::together}, {3, Verdict::apart}}));
    set.wake_disturbed();
    EXPECT_EQ(firsts(set.pairs()), (std::vector<ProxyId>{0, 1}));
    EXPECT_EQ(firsts(set.together()), (std::vector<ProxyId>{2}));
    EXPECT_EQ(verdicts().size(), 4u);
}

TEST_F(NearSetTest, ManyAreDisturbedAtOnce)
{
    let_all_rest();
    IdSet some;
    some.resize(5);
    some.insert(0);
    some.insert(4);
    set.disturb(some);
    set.wake_disturbed();
    EXPECT_EQ(firsts(set.pairs()), (std::vector<ProxyId>{0, 3}));
}

TEST_F(NearSetTest, WhatWasWokenCanRestAgain)
{
    for (int time = 0; time < 3; ++time)
    {
        let_all_rest();
        EXPECT_TRUE(set.pairs().empty());
        set.disturb(2);
        set.wake_disturbed();
        EXPECT_EQ(firsts(set.pairs()), (std::vector<ProxyId>{2, 1})) << "those together come first";
    }
}

TEST_F(NearSetTest, WhoIsDroppedAfterRestingIsNoMemberAnyMore)
{
    let_all_rest();
    set.disturb(0);
    set.wake_disturbed();
    set.keep_if(
        false, [](const NearPair &) {}, [](const NearPair &) { return false; });
    EXPECT_FALSE(set.members().contains(0));
    EXPECT_TRUE(set.members().contains(1)) << "it rests with another";
}

TEST_F(NearSetTest, NothingIsLeftAfterClearing)
{
    let_all_rest();
    set.disturb(3);
    set.clear();
    set.wake_disturbed();
    EXPECT_TRUE(verdicts().empty());
    EXPECT_TRUE(set.members().empty());
    set.add(pair_of(0, 1));
    set.disturb(0);
    EXPECT_EQ(verdicts().size(), 1u);
}
} // namespace
} // namespace ode_predictive_space
