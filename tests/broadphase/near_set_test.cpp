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
    return {{first, second}, NearPair::to_the_end};
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

    // Of those that are tested at this tick, in their order; what is stale is dropped.
    std::vector<ProxyId> tested(Tick now = 0)
    {
        std::vector<ProxyId> ids;
        set.visit_tested(
            now, [](const NearPair &) {}, [&](const NearPair &pair) { ids.push_back(pair.first); });
        EXPECT_EQ(ids, firsts(set.pairs())) << "no others are left";
        return ids;
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

TEST_F(NearSetTest, PairsOfWhoIsRetiredAreStale)
{
    set.retire(1, 0);
    EXPECT_EQ(verdicts(), (std::map<ProxyId, Verdict>{{2, Verdict::open}, {3, Verdict::open}}));
    EXPECT_EQ(tested(), (std::vector<ProxyId>{2, 3}));
    EXPECT_FALSE(set.members().contains(0));
    EXPECT_FALSE(set.members().contains(1));
    EXPECT_TRUE(set.members().contains(2)) << "it is in another pair";
    EXPECT_EQ(tested(), (std::vector<ProxyId>{2, 3})) << "nobody is retired for ever";
}

TEST_F(NearSetTest, PairsThatCameSinceAreNot)
{
    tested();
    set.retire(1, 0);
    set.add(pair_of(1, 3));
    EXPECT_EQ(verdicts().size(), 3u);
    EXPECT_EQ(tested(), (std::vector<ProxyId>{2, 3, 1}));
    EXPECT_EQ(tested(), (std::vector<ProxyId>{2, 3, 1})) << "nor at the next tick";
}

TEST_F(NearSetTest, WhoIsRetiredAgainLosesThemToo)
{
    tested();
    set.retire(1, 0);
    set.add(pair_of(1, 3));
    set.retire(1, 0);
    set.add(pair_of(1, 4));
    EXPECT_EQ(verdicts().size(), 3u);
    EXPECT_EQ(tested(), (std::vector<ProxyId>{2, 3, 1}));
    EXPECT_EQ(set.pairs().back().second, 4u);
}

TEST_F(NearSetTest, PairsAtRestAreStaleToo)
{
    tested();
    let_all_rest();
    set.retire(1, 0);
    EXPECT_EQ(verdicts(), (std::map<ProxyId, Verdict>{{2, Verdict::together}, {3, Verdict::apart}}));
    set.add(pair_of(1, 2));
    set.retire(4, 0);
    EXPECT_EQ(verdicts(), (std::map<ProxyId, Verdict>{{1, Verdict::open}, {2, Verdict::together}}));
    set.wake_disturbed();
    EXPECT_EQ(tested(), (std::vector<ProxyId>{1}));
    EXPECT_EQ(firsts(set.together()), (std::vector<ProxyId>{2}));
    EXPECT_FALSE(set.members().contains(0)) << "who is dropped while it rests is no member any more";
    EXPECT_FALSE(set.members().contains(4));
}

TEST_F(NearSetTest, WhoIsRetiredOftenTakesNoMoreMemory)
{
    tested();
    set.retire(1, 0);
    const std::size_t before = set.bytes();
    for (int time = 0; time < 1000; ++time)
        set.retire(1, 0);
    EXPECT_EQ(set.bytes(), before);
}

TEST_F(NearSetTest, PairsThatHaveLeftAreDropped)
{
    set.add({{0, 4}, 7});
    set.add({{1, 4}, 5});
    EXPECT_EQ(tested(4).size(), 6u);
    EXPECT_EQ(tested(5).size(), 6u) << "the last tick at which they may be near";
    EXPECT_EQ(tested(6), (std::vector<ProxyId>{0, 1, 2, 3, 0}));
    EXPECT_EQ(tested(8), (std::vector<ProxyId>{0, 1, 2, 3}));
}

TEST_F(NearSetTest, TimeMayWrapAround)
{
    constexpr Tick now = ~Tick{0} - 1;
    for (std::int32_t stay : {1, 2, 3})
        set.add(NearPair::of({0, 4, 0, 0, stay}, now));
    set.add(NearPair::of({1, 4, 0, 0}, now));
    EXPECT_EQ(tested(now).size(), 8u);
    EXPECT_EQ(tested(now + 1).size(), 8u);
    EXPECT_EQ(tested(now + 2).size(), 7u);
    EXPECT_EQ(tested(now + 3).size(), 7u) << "the second is dropped a tick late: its own is 0";
    EXPECT_EQ(tested(now + 4).size(), 5u);
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
