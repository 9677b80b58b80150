#include "ode_predictive_space/broadphase/assess.h"

#include <gtest/gtest.h>

#include "tests/broadphase/support/proxies.h"

namespace ode_predictive_space
{
namespace
{
struct Assessment
{
    std::vector<NearPair> near;
    std::vector<ScheduledPair> scheduled;
};

Assessment assessed(const ProxyStore &store, Tick now, Proximity measure)
{
    Assessment result;
    assess(store, {{0, 1}}, now, measure, result.near, result.scheduled);
    return result;
}

Path towards(const Vector3 &position, const Vector3 &velocity)
{
    return {position, velocity, Vector3::Zero()};
}

TEST(Assess, WhatOverlapsIsNear)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_still_proxy(store, {1.5, 0, 0}, 1, 0);
    const Assessment result = assessed(store, 0, Proximity::box);
    ASSERT_EQ(result.near.size(), 1u);
    EXPECT_TRUE(result.scheduled.empty());
    const NearPair &pair = result.near[0];
    EXPECT_EQ(pair.first, 0u);
    EXPECT_EQ(pair.second, 1u);
    EXPECT_EQ(pair.until, NearPair::to_the_end) << "neither moves";
}

TEST(Assess, WhatTouchesIsNear)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_still_proxy(store, {2, 2, 2}, 1, 0);
    EXPECT_EQ(assessed(store, 0, Proximity::box).near.size(), 1u);
}

TEST(Assess, StillOnesThatAreApartAreDropped)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_still_proxy(store, {2.01, 0, 0}, 1, 0);
    const Assessment result = assessed(store, 77, Proximity::box);
    EXPECT_TRUE(result.near.empty());
    EXPECT_TRUE(result.scheduled.empty());
}

TEST(Assess, WhatMeetsBeforeTheNextTickSleepsUntilThen)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_proxy(store, towards({2.5, 0, 0}, {-0.6, 0, 0}), {}, 1, 10, 20);
    const Assessment result = assessed(store, 10, Proximity::box);
    EXPECT_TRUE(result.near.empty());
    ASSERT_EQ(result.scheduled.size(), 1u);
    EXPECT_EQ(result.scheduled[0].ticks, 1);
}

TEST(Assess, WhatPassesKnowsWhenItHasLeft)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_proxy(store, towards({2.5, 0, 0}, {-0.25, 0, 0}), {}, 1, 10, 60);
    const Assessment result = assessed(store, 10, Proximity::box);
    ASSERT_EQ(result.scheduled.size(), 1u);
    const ScheduledPair &pair = result.scheduled[0];
    EXPECT_EQ(pair.ticks, 2) << "2.5 - 2 * 0.25 = 2";
    EXPECT_EQ(pair.event.stay, 16) << "until 2.5 - 18 * 0.25 = -2";
    const NearPair near = NearPair::of(pair.event, 12);
    EXPECT_EQ(near.until, 28u);
    EXPECT_EQ(near.ticks_left(28), 0);
    EXPECT_LT(near.ticks_left(29), 0);
}

TEST(Assess, WhatPassesBetweenTwoTicksIsDropped)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_proxy(store, towards({20, 0, 0}, {-16, 0, 0}), {}, 1, 10, 60);
    const Assessment result = assessed(store, 10, Proximity::box);
    EXPECT_TRUE(result.near.empty());
    EXPECT_TRUE(result.scheduled.empty());
}

TEST(Assess, WhatMeetsLaterSleepsUntilThen)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_proxy(store, towards({7.25, 0, 0}, {-0.5, 0, 0}), {}, 1, 10, 20);
    store.generations = {5, 8};
    const Assessment result = assessed(store, 10, Proximity::box);
    EXPECT_TRUE(result.near.empty());
    ASSERT_EQ(result.scheduled.size(), 1u);
    EXPECT_EQ(result.scheduled[0].ticks, 11) << "they touch after 10.5 ticks";
    EXPECT_EQ(result.scheduled[0].event.first, 0u);
    EXPECT_EQ(result.scheduled[0].event.second, 1u);
    EXPECT_EQ(result.scheduled[0].event.first_generation, 5u);
    EXPECT_EQ(result.scheduled[0].event.second_generation, 8u);
    EXPECT_EQ(assessed(store, 16, Proximity::box).scheduled.at(0).ticks, 5) << "counted from now on";
}

TEST(Assess, WhatMeetsAfterTheHorizonIsDropped)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_proxy(store, towards({12.5, 0, 0}, {-0.5, 0, 0}), {}, 1, 10, 20);
    const Assessment result = assessed(store, 10, Proximity::box);
    EXPECT_TRUE(result.near.empty());
    EXPECT_TRUE(result.scheduled.empty());
}

TEST(Assess, TheShorterOfBothHorizonsCounts)
{
    ProxyStore store;
    add_proxy(store, towards({0, 0, 0}, {0.25, 0, 0}), {}, 1, 10, 5);
    add_proxy(store, towards({7, 0, 0}, {-0.25, 0, 0}), {}, 1, 10, 20);
    EXPECT_TRUE(assessed(store, 10, Proximity::box).scheduled.empty()) << "they would touch after 10 ticks";
    store.bounds[0].until = 10 + 15;
    EXPECT_EQ(assessed(store, 10, Proximity::box).scheduled.size(), 1u);
}

TEST(Assess, TheMeasureOfSpheresDropsPairsWhoseCornersOverlap)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_still_proxy(store, {1.9, 1.9, 0}, 1, 0);
    EXPECT_EQ(assessed(store, 0, Proximity::box).near.size(), 1u);
    const Assessment result = assessed(store, 0, Proximity::sphere);
    EXPECT_TRUE(result.near.empty());
    EXPECT_TRUE(result.scheduled.empty());
}

TEST(Assess, TheMeasureOfSpheresStillAsksForBoxes)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_still_proxy(store, {1.5, 0, 0}, 1, 0);
    // Flat objects in large spheres.
    for (ProxyId id : {0u, 1u})
        store.bounds[id].low[0] = -0.1f, store.bounds[id].high[0] = 0.1f;
    EXPECT_TRUE(assessed(store, 0, Proximity::sphere).near.empty());
}

TEST(Assess, TheMeasureOfSpheresWaitsForTheSpheres)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_proxy(store, towards({5.5, 1.5, 0}, {-0.25, 0, 0}), {}, 1, 0, 100);
    const Assessment boxes = assessed(store, 0, Proximity::box);
    const Assessment spheres = assessed(store, 0, Proximity::sphere);
    ASSERT_EQ(boxes.scheduled.size(), 1u);
    ASSERT_EQ(spheres.scheduled.size(), 1u);
    EXPECT_EQ(boxes.scheduled[0].ticks, 14) << "3.5 apart along x";
    EXPECT_EQ(spheres.scheduled[0].ticks, 17) << "sqrt(4 - 2.25) from the centre, after 16.7 ticks";
}

TEST(Assess, WithoutASphereTheMeasureOfSpheresIsThatOfBoxes)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    add_still_proxy(store, {1.9, 1.9, 0}, 1, 0);
    store.bounds[1].radius = std::numeric_limits<float>::infinity();
    EXPECT_EQ(assessed(store, 0, Proximity::sphere).near.size(), 1u);
}

TEST(Assess, NothingIsKnownOfWhatIsNotANumber)
{
    for (Proximity measure : {Proximity::box, Proximity::sphere})
    {
        ProxyStore store;
        add_still_proxy(store, {0, 0, 0}, 1, 0);
        add_still_proxy(store, {0, std::numeric_limits<double>::quiet_NaN(), 0}, 1, 0);
        EXPECT_EQ(assessed(store, 0, measure).near.size(), 1u);
    }
}

// Each centre may be anywhere in a cube around its path: the check of centres is one of coordinates.
bool spheres_may_touch(const Envelope &one, const Envelope &other)
{
    const double freedom = one.deviation.a + other.deviation.a;
    const Vector3 apart = (one.path.position - other.path.position).cwiseAbs().array() - freedom;
    return apart.cwiseMax(0).norm() <= one.radius + other.radius;
}

// Whatever is not near now must be apart at each tick until it is looked at again.
TEST(Assess, IsNeverLate)
{
    Random random(1);
    int scheduled = 0, dropped = 0;
    for (int i = 0; i < 100000; ++i)
    {
        const Tick now = 0xffffffe0u + static_cast<Tick>(random.index(20));
        ProxyStore store;
        add_random_proxy(store, random, 1, now - static_cast<Tick>(random.index(1)));
        add_random_proxy(store, random, 1, now);
        const Proximity measure = random.chance(0.5) ? Proximity::box : Proximity::sphere;
        const Assessment result = assessed(store, now, measure);
        ASSERT_LE(result.near.size() + result.scheduled.size(), 1u);
        if (!result.near.empty())
            continue;
        const std::int32_t end = std::min(store.remaining(0, now), store.remaining(1, now));
        const bool wakes = !result.scheduled.empty();
        (wakes ? scheduled : dropped) += 1;
        const std::int32_t asleep = wakes ? result.scheduled[0].ticks : std::min(end, 1000) + 1;
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
            ASSERT_FALSE(boxes && (spheres || measure == Proximity::box)) << "pair " << i << " after " << t << " ticks";
        }
    }
    EXPECT_GT(scheduled, 5000);
    EXPECT_GT(dropped, 5000);
}
} // namespace
} // namespace ode_predictive_space
