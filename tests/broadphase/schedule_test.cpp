#include "ode_predictive_space/broadphase/schedule/schedule.h"

#include <gtest/gtest.h>

#include "tests/broadphase/support/proxies.h"

namespace ode_predictive_space
{
namespace
{
// What becomes of the candidate pair of objects 0 and 1.
struct Classified
{
    std::vector<NearPair> near;
    std::size_t scheduled = 0;
    std::int32_t ticks = 0;      // until the scheduled pair wakes
    std::vector<NearPair> woken; // at that tick
};

Classified classified(const ProxyStore &store, Tick now, ProximityTest test)
{
    Classified result;
    Schedule schedule;
    schedule.restart(now);
    schedule.classify(store, {{0, 1}}, now, test, result.near);
    result.scheduled = schedule.pairs(store);
    constexpr std::int32_t longest = 200;
    while (result.scheduled > 0 && result.woken.empty() && result.ticks < longest)
    {
        ++result.ticks;
        const Tick tick = now + static_cast<Tick>(result.ticks);
        schedule.advance(tick);
        const std::size_t woken = schedule.wake(store, tick, result.woken);
        EXPECT_EQ(woken, result.woken.size());
        schedule.finish(store);
    }
    EXPECT_EQ(result.woken.size(), result.scheduled);
    EXPECT_EQ(schedule.pairs(store), 0u);
    return result;
}

Path towards(const Vector3 &position, const Vector3 &velocity)
{
    return {position, velocity, Vector3::Zero()};
}

TEST(Schedule, WhatOverlapsIsNear)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_still_proxy(store, {1.5, 0, 0}, 1, 0);
    const Classified result = classified(store, 0, ProximityTest::box);
    ASSERT_EQ(result.near.size(), 1u);
    EXPECT_EQ(result.scheduled, 0u);
    const NearPair &pair = result.near[0];
    EXPECT_EQ(pair.first, 0u);
    EXPECT_EQ(pair.second, 1u);
    EXPECT_EQ(pair.until, NearPair::to_the_end) << "neither moves";
}

TEST(Schedule, WhatTouchesIsNear)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_still_proxy(store, {2, 2, 2}, 1, 0);
    EXPECT_EQ(classified(store, 0, ProximityTest::box).near.size(), 1u);
}

TEST(Schedule, StillOnesThatAreApartAreDropped)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_still_proxy(store, {2.01, 0, 0}, 1, 0);
    const Classified result = classified(store, 77, ProximityTest::box);
    EXPECT_TRUE(result.near.empty());
    EXPECT_EQ(result.scheduled, 0u);
}

TEST(Schedule, WhatMeetsBeforeTheNextTickSleepsUntilThen)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_proxy(store, towards({2.5, 0, 0}, {-0.6, 0, 0}), {}, 1, 10, 20);
    const Classified result = classified(store, 10, ProximityTest::box);
    EXPECT_TRUE(result.near.empty());
    ASSERT_EQ(result.scheduled, 1u);
    EXPECT_EQ(result.ticks, 1);
}

TEST(Schedule, WhatPassesKnowsWhenItHasLeft)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_proxy(store, towards({2.5, 0, 0}, {-0.25, 0, 0}), {}, 1, 10, 60);
    const Classified result = classified(store, 10, ProximityTest::box);
    ASSERT_EQ(result.scheduled, 1u);
    EXPECT_EQ(result.ticks, 2) << "2.5 - 2 * 0.25 = 2";
    const NearPair near = result.woken.at(0);
    EXPECT_EQ(near.until, 28u) << "2.5 - 18 * 0.25 = -2";
    EXPECT_EQ(near.ticks_left(28), 0);
    EXPECT_LT(near.ticks_left(29), 0);
}

TEST(Schedule, WhatPassesBetweenTwoTicksIsDropped)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_proxy(store, towards({20, 0, 0}, {-16, 0, 0}), {}, 1, 10, 60);
    const Classified result = classified(store, 10, ProximityTest::box);
    EXPECT_TRUE(result.near.empty());
    EXPECT_EQ(result.scheduled, 0u);
}

TEST(Schedule, WhatMeetsLaterSleepsUntilThen)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_proxy(store, towards({7.25, 0, 0}, {-0.5, 0, 0}), {}, 1, 10, 20);
    store.generations = {5, 8};
    const Classified result = classified(store, 10, ProximityTest::box);
    EXPECT_TRUE(result.near.empty());
    ASSERT_EQ(result.scheduled, 1u);
    EXPECT_EQ(result.ticks, 11) << "they touch after 10.5 ticks";
    EXPECT_EQ(result.woken.at(0).first, 0u);
    EXPECT_EQ(result.woken.at(0).second, 1u);
    EXPECT_EQ(classified(store, 16, ProximityTest::box).ticks, 5) << "counted from now on";
}

TEST(Schedule, WhatMeetsAfterTheHorizonIsDropped)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_proxy(store, towards({12.5, 0, 0}, {-0.5, 0, 0}), {}, 1, 10, 20);
    const Classified result = classified(store, 10, ProximityTest::box);
    EXPECT_TRUE(result.near.empty());
    EXPECT_EQ(result.scheduled, 0u);
}

TEST(Schedule, TheShorterOfBothHorizonsCounts)
{
    ProxyStore store;
    add_proxy(store, towards({0, 0, 0}, {0.25, 0, 0}), {}, 1, 10, 5);
    add_proxy(store, towards({7, 0, 0}, {-0.25, 0, 0}), {}, 1, 10, 20);
    EXPECT_EQ(classified(store, 10, ProximityTest::box).scheduled, 0u) << "they would touch after 10 ticks";
    store.records[0].prediction.until = 10 + 15;
    EXPECT_EQ(classified(store, 10, ProximityTest::box).scheduled, 1u);
}

TEST(Schedule, TheSphereTestDropsPairsWhoseCornersOverlap)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_still_proxy(store, {1.9, 1.9, 0}, 1, 0);
    EXPECT_EQ(classified(store, 0, ProximityTest::box).near.size(), 1u);
    const Classified result = classified(store, 0, ProximityTest::sphere);
    EXPECT_TRUE(result.near.empty());
    EXPECT_EQ(result.scheduled, 0u);
}

TEST(Schedule, TheSphereTestNeedsBoxesToOverlapToo)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_still_proxy(store, {1.5, 0, 0}, 1, 0);
    // Flat objects in large spheres.
    for (ProxyId id : {0u, 1u})
        store.records[id].prediction.low[0] = -0.1f, store.records[id].prediction.high[0] = 0.1f;
    EXPECT_TRUE(classified(store, 0, ProximityTest::sphere).near.empty());
}

TEST(Schedule, TheSphereTestWaitsForTheSpheres)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_proxy(store, towards({5.5, 1.5, 0}, {-0.25, 0, 0}), {}, 1, 0, 100);
    const Classified boxes = classified(store, 0, ProximityTest::box);
    const Classified spheres = classified(store, 0, ProximityTest::sphere);
    ASSERT_EQ(boxes.scheduled, 1u);
    ASSERT_EQ(spheres.scheduled, 1u);
    EXPECT_EQ(boxes.ticks, 14) << "3.5 apart along x";
    EXPECT_EQ(spheres.ticks, 17) << "sqrt(4 - 2.25) from the centre, after 16.7 ticks";
}

TEST(Schedule, WithoutASphereTheSphereTestIsTheBoxTest)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_still_proxy(store, {1.9, 1.9, 0}, 1, 0);
    store.records[1].prediction.radius = std::numeric_limits<float>::infinity();
    EXPECT_EQ(classified(store, 0, ProximityTest::sphere).near.size(), 1u);
}

TEST(Schedule, NothingIsKnownOfWhatIsNotANumber)
{
    for (ProximityTest test : {ProximityTest::box, ProximityTest::sphere})
    {
        ProxyStore store;
        add_still_proxy(store, {0, 0, 0}, 1, 0);
        add_still_proxy(store, {0, std::numeric_limits<double>::quiet_NaN(), 0}, 1, 0);
        EXPECT_EQ(classified(store, 0, test).near.size(), 1u);
    }
}

// Each centre may be anywhere in a cube around its path: the check of centres is one of coordinates.
bool spheres_may_touch(const Envelope &one, const Envelope &other)
{
    const double freedom = one.deviation.a + other.deviation.a;
    const Vector3 apart = (one.path.position - other.path.position).cwiseAbs().array() - freedom;
    return apart.cwiseMax(0).norm() <= one.radius + other.radius;
}

// A pair that is not near now must be apart at each tick until it is looked at again.
TEST(Schedule, IsNeverLate)
{
    Random random(1);
    int scheduled = 0, dropped = 0;
    for (int i = 0; i < 100000; ++i)
    {
        const Tick now = 0xffffffe0u + static_cast<Tick>(random.index(20));
        ProxyStore store;
        add_random_proxy(store, random, 1, now - static_cast<Tick>(random.index(1)));
        add_random_proxy(store, random, 1, now);
        const ProximityTest test = random.chance(0.5) ? ProximityTest::box : ProximityTest::sphere;
        const Classified result = classified(store, now, test);
        ASSERT_LE(result.near.size() + result.scheduled, 1u);
        if (!result.near.empty())
            continue;
        const std::int32_t end = std::min(store.remaining(0, now), store.remaining(1, now));
        const bool wakes = result.scheduled != 0;
        (wakes ? scheduled : dropped) += 1;
        const std::int32_t asleep = wakes ? result.ticks : std::min(end, 1000) + 1;
        ASSERT_GT(asleep, 0);
        if (wakes)
        {
            ASSERT_LE(asleep, end);
        }
        for (std::int32_t t = 0; t < asleep; ++t)
        {
            const Envelope one = store.envelope(0, now + static_cast<Tick>(t));
            const Envelope other = store.envelope(1, now + static_cast<Tick>(t));
            const bool boxes = one.at(0).intersects(other.at(0));
            const bool spheres = spheres_may_touch(one, other);
            ASSERT_FALSE(boxes && (spheres || test == ProximityTest::box))
                << "pair " << i << " after " << t << " ticks";
        }
    }
    EXPECT_GT(scheduled, 5000);
    EXPECT_GT(dropped, 5000);
}

// Two balls, the second on its way to the first: they touch after 10.5 ticks.
ProxyStore two_that_meet()
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_proxy(store, towards({7.25, 0, 0}, {-0.5, 0, 0}), {}, 1, 10, 20);
    return store;
}

TEST(Schedule, AnOlderPredictionOfEitherObjectWakesNoPair)
{
    for (ProxyId predicted : {0u, 1u})
    {
        ProxyStore store = two_that_meet();
        Schedule schedule;
        std::vector<NearPair> near;
        schedule.restart(10);
        schedule.classify(store, {{0, 1}}, 10, ProximityTest::box, near);
        EXPECT_EQ(schedule.pairs(store), 1u);
        ++store.generations[predicted];
        EXPECT_EQ(schedule.pairs(store), 0u);
        for (Tick now = 11; now < 40; ++now)
        {
            schedule.advance(now);
            EXPECT_EQ(schedule.has_due_events(), now == 21) << "a stale event stays where it is";
            EXPECT_EQ(schedule.wake(store, now, near), 0u);
            schedule.finish(store);
        }
        EXPECT_TRUE(near.empty());
    }
}

Batch batch_of(const ProxyStore &store)
{
    Batch batch;
    batch.resize(store.size());
    for (ProxyId id = 0; id < store.size(); ++id)
        batch.add(id);
    return batch;
}

TEST(Schedule, AHorizonEndsAtItsTickUnlessANewerPredictionHasItsOwn)
{
    ProxyStore store;
    add_proxy(store, towards({0, 0, 0}, {1, 0, 0}), {}, 1, 10, 5);
    add_proxy(store, towards({0, 0, 0}, {1, 0, 0}), {}, 1, 10, 5);
    const ProxyId until_left = add_still_proxy(store, {0, 0, 0}, 1, 0);
    store.records[until_left].prediction.until = 10;
    const ProxyId settling = add_still_proxy(store, {0, 0, 0}, 1, 0);
    store.records[settling].prediction.until = 138;
    Schedule schedule;
    schedule.restart(10);
    schedule.expect_ends(store, batch_of(store), 10);
    EXPECT_EQ(schedule.pairs(store), 0u) << "the end of a horizon is no pair";
    ++store.generations[1];
    for (Tick now = 11; now < 200; ++now)
    {
        schedule.advance(now);
        Batch batch;
        batch.resize(store.size());
        schedule.take_expired(store, batch);
        std::vector<NearPair> near;
        EXPECT_EQ(schedule.wake(store, now, near), 0u);
        schedule.finish(store);
        EXPECT_FALSE(schedule.has_due_events());
        const std::vector<ProxyId> expected = now == 15    ? std::vector<ProxyId>{0}
                                              : now == 138 ? std::vector<ProxyId>{settling}
                                                           : std::vector<ProxyId>{};
        EXPECT_EQ(batch.ids(), expected) << now;
    }
}

TEST(Schedule, ARestartForgetsAllEvents)
{
    const ProxyStore store = two_that_meet();
    Schedule schedule;
    std::vector<NearPair> near;
    schedule.restart(10);
    schedule.classify(store, {{0, 1}}, 10, ProximityTest::box, near);
    schedule.restart(500);
    EXPECT_EQ(schedule.pairs(store), 0u);
    for (Tick now = 501; now < 530; ++now)
    {
        schedule.advance(now);
        EXPECT_FALSE(schedule.has_due_events());
    }
}

TEST(Schedule, StaleEventsDoNotPileUp)
{
    ProxyStore store = two_that_meet();
    store.records[1].prediction.until = 1000000;
    store.paths[1].velocity[0] = -1e-4f;
    Schedule schedule;
    std::vector<NearPair> near;
    schedule.restart(10);
    std::size_t most = 0;
    for (std::size_t i = 0; i < 20 * tuning::least_purge; ++i)
    {
        ++store.generations[1];
        schedule.classify(store, {{0, 1}}, 10, ProximityTest::box, near);
        schedule.finish(store);
        most = std::max(most, schedule.bytes());
        ASSERT_EQ(schedule.pairs(store), 1u);
        if (i == tuning::least_purge)
            most = 0;
    }
    EXPECT_LT(most, 100 * tuning::least_purge);
}

// Each candidate of a long list becomes what it becomes alone, in the order of the list.
TEST(Schedule, ClassifiesEachCandidateAsIfItWereAlone)
{
    Random random(2);
    ProxyStore store;
    constexpr ProxyId objects = 60;
    constexpr Tick now = 1000;
    for (ProxyId id = 0; id < objects; ++id)
        add_random_proxy(store, random, 1, now);
    std::vector<CandidatePair> candidates;
    std::vector<ProxyId> expected;
    std::size_t scheduled = 0;
    std::vector<NearPair> near;
    for (ProxyId first = 0; first < objects; ++first)
        for (ProxyId second = first + 1; second < objects; ++second)
        {
            Schedule alone;
            alone.restart(now);
            near.clear();
            alone.classify(store, {{first, second}}, now, ProximityTest::box, near);
            scheduled += alone.pairs(store);
            candidates.push_back({first, second});
            if (!near.empty())
                expected.insert(expected.end(), {first, second});
        }
    Schedule together;
    together.restart(now);
    near.clear();
    together.classify(store, candidates, now, ProximityTest::box, near);
    std::vector<ProxyId> found;
    for (const NearPair &pair : near)
        found.insert(found.end(), {pair.first, pair.second});
    EXPECT_EQ(found, expected);
    EXPECT_EQ(together.pairs(store), scheduled);
    EXPECT_GT(expected.size(), 100u);
    EXPECT_GT(scheduled, 100u);
}
} // namespace
} // namespace ode_predictive_space
