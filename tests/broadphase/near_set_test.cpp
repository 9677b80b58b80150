#include "ode_predictive_space/broadphase/near/near_set.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

namespace ode_predictive_space
{
namespace
{
NearPair pair_of(ProxyId first, ProxyId second)
{
    return {{first, second}, NearPair::to_the_end};
}

// Decides each pair by its first object, and remembers which pairs were tested.
struct PairScene : Scene
{
    std::set<ProxyId> overlapping = {0, 2};
    std::vector<ProxyId> tested;

    bool overlap(ProxyId first, ProxyId) override
    {
        tested.push_back(first);
        return overlapping.count(first) > 0;
    }

    // The near set asks nothing else.
    void locate(const ProxyId *, std::size_t, Location *) override { ADD_FAILURE(); }
    void measure(const ProxyId *, std::size_t, MeasuredBox *) override { ADD_FAILURE(); }
    void observe(const ProxyId *, std::size_t, const bool *, Observation *) override { ADD_FAILURE(); }
    Box bounds(ProxyId) override { return {}; }
    std::optional<Vector3> pivot(ProxyId) override { return std::nullopt; }
    void find_disabled(const ProxyId *, std::size_t, std::vector<ProxyId> &) override { ADD_FAILURE(); }
};

// The pairs 0 1, 1 2, 2 3, 3 4. Their boxes decide nothing.
class NearSetTest : public testing::Test
{
protected:
    static constexpr std::size_t objects = 5;

    NearSetTest() : boxes(objects, MeasuredBox(undecided_box()))
    {
        set.resize(objects);
        for (ProxyId id = 0; id + 1 < objects; ++id)
            set.add(pair_of(id, id + 1));
    }

    static Box undecided_box()
    {
        const Vector3 unknown = Vector3::Constant(std::numeric_limits<double>::quiet_NaN());
        return Box(unknown, unknown);
    }

    // First objects of the reported pairs.
    std::vector<ProxyId> report(Tick now = 0)
    {
        ++reports;
        scene.tested.clear();
        room.resize(set.most_pairs());
        const OverlapTest test{scene, boxes.data(), false};
        const CandidatePair *end = set.report(test, now, reports % 2 == 0, room.data());
        std::vector<ProxyId> firsts;
        for (const CandidatePair *pair = room.data(); pair != end; ++pair)
            firsts.push_back(pair->first);
        return firsts;
    }

    // Reports until pairs have been let rest once.
    void reach_rest()
    {
        do
            report();
        while (reports % tuning::reports_per_rest != 0);
    }

    // Moves that were noted before are forgotten the first time.
    void let_all_rest()
    {
        reach_rest();
        reach_rest();
    }

    void move(std::initializer_list<ProxyId> ids)
    {
        IdSet moved;
        moved.resize(objects);
        for (ProxyId id : ids)
            moved.insert(id);
        set.note_moves(moved);
    }

    // States by first object of the pair.
    std::map<ProxyId, PairState> states() const
    {
        std::map<ProxyId, PairState> found;
        set.for_each(
            [&](const NearPair &pair, PairState state) { EXPECT_TRUE(found.emplace(pair.first, state).second); });
        return found;
    }

    // The pairs that are tested at this tick, in their order; stale ones are dropped.
    std::vector<ProxyId> tested(Tick now = 0)
    {
        report(now);
        EXPECT_EQ(scene.tested, firsts(set.active())) << "no others are left";
        return scene.tested;
    }

    static std::vector<ProxyId> firsts(const std::vector<NearPair> &pairs)
    {
        std::vector<ProxyId> ids;
        for (const NearPair &pair : pairs)
            ids.push_back(pair.first);
        return ids;
    }

    PairScene scene;
    std::vector<MeasuredBox> boxes;
    std::vector<CandidatePair> room;
    unsigned reports = 0;
    NearSet set;
};

using States = std::map<ProxyId, PairState>;
constexpr PairState active = PairState::active, separated = PairState::separated, overlapping = PairState::overlapping;

TEST_F(NearSetTest, RestingPairsAreReportedWithoutATestAndStayMembers)
{
    let_all_rest();
    EXPECT_TRUE(set.active().empty());
    EXPECT_EQ(firsts(set.overlapping()), (std::vector<ProxyId>{0, 2}));
    EXPECT_EQ(set.members().size(), 5u);
    EXPECT_EQ(states(), (States{{0, overlapping}, {1, separated}, {2, overlapping}, {3, separated}}));
    EXPECT_EQ(report(), (std::vector<ProxyId>{0, 2}));
    EXPECT_TRUE(scene.tested.empty());
}

TEST_F(NearSetTest, PairsOfMovedObjectsAreTestedOn)
{
    scene.overlapping = {1};
    while (reports + 1 < tuning::reports_per_rest)
        report();
    move({0, 3});
    reach_rest();
    EXPECT_EQ(firsts(set.active()), (std::vector<ProxyId>{0, 2, 3}));
    EXPECT_EQ(firsts(set.overlapping()), (std::vector<ProxyId>{1}));
}

TEST_F(NearSetTest, ADisturbedObjectHasItsPairsTestedAndNoOthers)
{
    let_all_rest();
    move({1});
    EXPECT_EQ(states(), (States{{0, active}, {1, active}, {2, overlapping}, {3, separated}}));
    EXPECT_EQ(report(), (std::vector<ProxyId>{0, 2}));
    EXPECT_EQ(scene.tested, (std::vector<ProxyId>{0, 1}));
    EXPECT_EQ(firsts(set.active()), (std::vector<ProxyId>{0, 1}));
    EXPECT_EQ(firsts(set.overlapping()), (std::vector<ProxyId>{2}));
    EXPECT_EQ(states().size(), 4u);
}

TEST_F(NearSetTest, ManyObjectsAreDisturbedAtOnce)
{
    let_all_rest();
    move({0, 4});
    report();
    EXPECT_EQ(firsts(set.active()), (std::vector<ProxyId>{0, 3}));
}

TEST_F(NearSetTest, DisturbedPairsCanRestAgain)
{
    for (int time = 0; time < 3; ++time)
    {
        let_all_rest();
        EXPECT_TRUE(set.active().empty());
        move({2});
        report();
        EXPECT_EQ(firsts(set.active()), (std::vector<ProxyId>{2, 1})) << "overlapping pairs come first";
    }
}

TEST_F(NearSetTest, PairsOfARetiredObjectAreStale)
{
    set.retire(1, 0);
    EXPECT_EQ(states(), (States{{2, active}, {3, active}}));
    EXPECT_EQ(tested(), (std::vector<ProxyId>{2, 3}));
    EXPECT_FALSE(set.members().contains(0));
    EXPECT_FALSE(set.members().contains(1));
    EXPECT_TRUE(set.members().contains(2)) << "it is in another pair";
    EXPECT_EQ(tested(), (std::vector<ProxyId>{2, 3})) << "an object is retired once, not for ever";
}

TEST_F(NearSetTest, PairsAddedSinceAreNot)
{
    tested();
    set.retire(1, 0);
    set.add(pair_of(1, 3));
    EXPECT_EQ(states().size(), 3u);
    EXPECT_EQ(tested(), (std::vector<ProxyId>{2, 3, 1}));
    EXPECT_EQ(tested(), (std::vector<ProxyId>{2, 3, 1})) << "nor at the next tick";
}

TEST_F(NearSetTest, AnObjectThatIsRetiredAgainLosesThemToo)
{
    tested();
    set.retire(1, 0);
    set.add(pair_of(1, 3));
    set.retire(1, 0);
    set.add(pair_of(1, 4));
    EXPECT_EQ(states().size(), 3u);
    EXPECT_EQ(tested(), (std::vector<ProxyId>{2, 3, 1}));
    EXPECT_EQ(set.active().back().second, 4u);
}

TEST_F(NearSetTest, PairsAtRestAreStaleToo)
{
    tested();
    let_all_rest();
    set.retire(1, 0);
    EXPECT_EQ(states(), (States{{2, overlapping}, {3, separated}}));
    set.add(pair_of(1, 2));
    set.retire(4, 0);
    EXPECT_EQ(states(), (States{{1, active}, {2, overlapping}}));
    EXPECT_EQ(report(), (std::vector<ProxyId>{2}));
    EXPECT_EQ(scene.tested, (std::vector<ProxyId>{1}));
    EXPECT_EQ(firsts(set.active()), (std::vector<ProxyId>{1}));
    EXPECT_EQ(firsts(set.overlapping()), (std::vector<ProxyId>{2}));
    EXPECT_FALSE(set.members().contains(0)) << "an object whose resting pairs are dropped is no member any more";
    EXPECT_FALSE(set.members().contains(4));
}

TEST_F(NearSetTest, AnObjectThatIsRetiredOftenTakesNoMoreMemory)
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
    move({3});
    set.clear();
    EXPECT_TRUE(report().empty());
    EXPECT_TRUE(states().empty());
    EXPECT_TRUE(set.members().empty());
    set.add(pair_of(0, 1));
    move({0});
    EXPECT_EQ(states().size(), 1u);
    EXPECT_EQ(tested(), (std::vector<ProxyId>{0}));
}
} // namespace
} // namespace ode_predictive_space
