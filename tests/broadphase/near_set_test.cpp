#include "ode_predictive_space/broadphase/near/near_set.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

namespace ode_predictive_space
{
namespace
{
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
    void measure(const ProxyId *, std::size_t, Place *, const Origin &) override { ADD_FAILURE(); }
    void observe(const ProxyId *, std::size_t, Observation *, const Origin &) override { ADD_FAILURE(); }
    Box bounds(ProxyId) override { return {}; }
    SampledPose pose(ProxyId) override { return {}; }
    void find_disabled(const ProxyId *, std::size_t, std::vector<ProxyId> &) override { ADD_FAILURE(); }
};

// The pairs 0 1, 1 2, 2 3, 3 4.
class NearSetTest : public testing::Test
{
protected:
    static constexpr std::size_t objects = 5;

    NearSetTest() : places(objects)
    {
        set.resize(objects);
        for (Place &place : places)
            place.set_tight(Box(Vector3::Zero(), Vector3::Zero()));
        for (ProxyId id = 0; id + 1 < objects; ++id)
            set.add({id, id + 1}, false);
    }

    // First objects of the reported pairs.
    std::vector<ProxyId> report()
    {
        ++reports;
        scene.tested.clear();
        room.resize(set.most_pairs());
        const OverlapTest test{scene, places.data(), false, Origin().doubt(), Float4::all(0)};
        const CandidatePair *end = set.report(test, places.data(), update++, room.data());
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

    // As the look does.
    void move(std::initializer_list<ProxyId> ids)
    {
        for (ProxyId id : ids)
        {
            places[id].note_move(update);
            set.disturb(id);
        }
    }

    // As the update does. First objects of the pairs that were dropped.
    std::vector<ProxyId> drop_retired()
    {
        std::vector<ProxyId> dropped;
        set.drop_retired([&](const CandidatePair &pair) { dropped.push_back(pair.first); });
        EXPECT_FALSE(set.has_retired());
        return dropped;
    }

    // States by first object of the pair.
    std::map<ProxyId, PairState> states() const
    {
        std::map<ProxyId, PairState> found;
        set.for_each(
            [&](const CandidatePair &pair, PairState state) { EXPECT_TRUE(found.emplace(pair.first, state).second); });
        return found;
    }

    // The pairs that are tested at this tick, in their order.
    std::vector<ProxyId> tested()
    {
        report();
        EXPECT_EQ(scene.tested, firsts(set.active())) << "no others are left";
        return scene.tested;
    }

    static std::vector<ProxyId> firsts(const std::vector<CandidatePair> &pairs)
    {
        std::vector<ProxyId> ids;
        for (const CandidatePair &pair : pairs)
            ids.push_back(pair.first);
        return ids;
    }

    PairScene scene;
    std::vector<Place> places; // their boxes decide nothing
    std::vector<CandidatePair> room;
    unsigned reports = 0;
    UpdateNumber update = 1;
    NearSet set;
};

using States = std::map<ProxyId, PairState>;
constexpr PairState active = PairState::active, separated = PairState::separated, overlapping = PairState::overlapping;

TEST_F(NearSetTest, RestingPairsAreReportedWithoutATestAndStayMembers)
{
    let_all_rest();
    EXPECT_TRUE(set.active().empty());
    EXPECT_EQ(set.resting(), 4u);
    EXPECT_EQ(states(), (States{{0, overlapping}, {1, separated}, {2, overlapping}, {3, separated}}));
    EXPECT_EQ(report(), (std::vector<ProxyId>{0, 2}));
    EXPECT_TRUE(scene.tested.empty());
}

TEST_F(NearSetTest, ObjectsAtRestAreLookedAtWhenTheyMove)
{
    for (Place &place : places)
        place.watch_solid({Watch::sphere, 1, 0, 0});
    move({0});
    const Solid solid = places[0].solid();
    reach_rest();
    reach_rest();
    for (const Place &place : places)
        EXPECT_EQ(place.watch(), Watch::look);
    EXPECT_EQ(solid.formula, Watch::sphere);
    for (ProxyId id = 0; id < objects; ++id)
        EXPECT_TRUE(set.rests(id));
}

TEST_F(NearSetTest, WhatHasNotMovedSinceTheFirstReportsRestsSoon)
{
    report();
    EXPECT_EQ(set.resting(), 0u);
    move({0});
    report();
    EXPECT_EQ(firsts(set.active()), (std::vector<ProxyId>{0}));
    while (reports < 8)
        report();
    EXPECT_TRUE(set.active().empty());
}

TEST_F(NearSetTest, PairsAtRestDoNotTakeTheMemoryOfActiveOnes)
{
    constexpr std::size_t many = 200, pairs = many * (many - 1) / 2;
    set.resize(many);
    places.resize(many, places.front());
    scene.overlapping.clear();
    for (ProxyId id = objects; id < many; ++id)
        for (ProxyId other = 0; other < id; ++other)
            set.add({id, other}, false);
    let_all_rest();
    EXPECT_TRUE(set.active().empty());
    EXPECT_LT(set.bytes(), 2 * pairs * sizeof(CandidatePair) + 20000);
}

TEST_F(NearSetTest, PairsOfMovedObjectsAreTestedOn)
{
    scene.overlapping = {1};
    while (reports + 1 < tuning::reports_per_rest)
        report();
    move({0, 3});
    reach_rest();
    EXPECT_EQ(firsts(set.active()), (std::vector<ProxyId>{0, 2, 3}));
    EXPECT_EQ(states()[1], overlapping);
}

TEST_F(NearSetTest, ADisturbedObjectHasItsPairsTestedAndNoOthers)
{
    let_all_rest();
    move({1});
    EXPECT_EQ(report(), (std::vector<ProxyId>{0, 2}));
    EXPECT_EQ(scene.tested, (std::vector<ProxyId>{0, 1}));
    EXPECT_EQ(states(), (States{{0, active}, {1, active}, {2, overlapping}, {3, separated}}));
    EXPECT_EQ(set.woken(), 2u);
    EXPECT_FALSE(set.rests(1));
    EXPECT_TRUE(set.rests(2)) << "it is in another pair at rest";
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
    set.retire(1);
    EXPECT_TRUE(set.has_retired());
    EXPECT_EQ(states(), (States{{2, active}, {3, active}})) << "also before they are dropped";
    EXPECT_EQ(drop_retired(), (std::vector<ProxyId>{0, 1}));
    EXPECT_EQ(tested(), (std::vector<ProxyId>{2, 3}));
    EXPECT_TRUE(drop_retired().empty()) << "an object is retired once, not for ever";
}

TEST_F(NearSetTest, PairsAddedSinceAreNot)
{
    set.retire(1);
    drop_retired();
    set.add({1, 3}, false);
    EXPECT_EQ(states().size(), 3u);
    EXPECT_TRUE(drop_retired().empty());
    EXPECT_EQ(tested(), (std::vector<ProxyId>{2, 3, 1}));
}

TEST_F(NearSetTest, PairsAtRestAreStaleToo)
{
    let_all_rest();
    set.retire(1);
    EXPECT_EQ(states(), (States{{2, overlapping}, {3, separated}}));
    drop_retired();
    set.add({1, 2}, false);
    set.retire(4);
    drop_retired();
    EXPECT_EQ(states(), (States{{1, active}, {2, overlapping}}));
    EXPECT_EQ(report(), (std::vector<ProxyId>{2}));
    EXPECT_EQ(scene.tested, (std::vector<ProxyId>{1}));
}

TEST_F(NearSetTest, AnObjectThatIsRetiredOftenTakesNoMoreMemory)
{
    let_all_rest();
    set.retire(1);
    const std::size_t before = set.bytes();
    for (int time = 0; time < 1000; ++time)
        set.retire(1);
    EXPECT_EQ(set.bytes(), before);
}

// Numbers of updates have 28 bits.
TEST_F(NearSetTest, UpdateNumbersMayWrapAround)
{
    constexpr UpdateNumber end = UpdateNumber{1} << 28;
    update = end - 40;
    for (int i = 0; i < 200; ++i)
    {
        update %= end;
        if (i % 50 == 0)
            move({0});
        const std::vector<ProxyId> reported = report();
        EXPECT_EQ(std::set<ProxyId>(reported.begin(), reported.end()), (std::set<ProxyId>{0, 2})) << i;
    }
    EXPECT_EQ(set.resting(), 4u);
}

TEST_F(NearSetTest, NothingIsLeftAfterClearing)
{
    let_all_rest();
    move({3});
    set.clear();
    EXPECT_TRUE(report().empty());
    EXPECT_TRUE(states().empty());
    EXPECT_FALSE(set.rests(0));
    set.add({0, 1}, false);
    move({0});
    EXPECT_EQ(states().size(), 1u);
    EXPECT_EQ(tested(), (std::vector<ProxyId>{0}));
}
} // namespace
} // namespace ode_predictive_space
