#include "ode_predictive_space/broadphase/schedule/pair_proximity.h"

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/verify/checks.h"
#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/proxies.h"
#include "tests/prediction/box_proximity.h"

namespace ode_predictive_space
{
namespace
{
struct Found
{
    int near = 0;
    int apart = 0;
    int too_near = 0; ///< said to come near although even the envelopes with all rounding do not
};

// Never late to enter, never early to leave, with respect to double precision; and rarely near for nothing.
void check(const ProxyStore &store, Tick now, Found &found)
{
    const double horizon = store.common_horizon(0, 1, now);
    const std::optional<ProximityInterval> expected =
                                               box_proximity(store.envelope(0, now), store.envelope(1, now), horizon),
                                           with_rounding = box_proximity(store.outer_envelope(0, now),
                                                                         store.outer_envelope(1, now), horizon),
                                           seen = PairProximity(store, 0, now, ProximityTest::box).to(1);
    found.near += seen.has_value();
    found.apart += !seen.has_value();
    found.too_near += seen && !with_rounding;
    if (!expected)
        return;
    ASSERT_TRUE(seen) << expected->enter << " to " << expected->leave;
    EXPECT_LE(seen->enter, expected->enter);
    EXPECT_GE(seen->enter, 0);
    EXPECT_GE(seen->leave, std::min(expected->leave, horizon));
    EXPECT_GE(seen->leave, seen->enter);
    EXPECT_GT(seen->leave, 0);
}

// The farthest that a centre can be on this side along the x axis and pass the check.
Vector3 farthest(const PackedPath &path, Tick now, double side)
{
    const double t = ticks_between(path.since, now);
    Vector3 passes = path.path().at(t);
    const double reach = path.deviation().at(t);
    double inside = 0, outside = reach * 1.01 + 1e-3;
    for (int i = 0; i < 80; ++i)
    {
        const double middle = 0.5 * (inside + outside);
        const Vector3 centre = passes + Vector3(side * middle, 0, 0);
        (centre_inside(path, centre.data(), now) ? inside : outside) = middle;
    }
    passes.x() += side * inside;
    return passes;
}

TEST(PairProximity, IsNeverLateAndNeverLeavesEarly)
{
    Random random(11);
    for (double place : {0.0, 10.0, -3000.0})
    {
        Found found;
        constexpr int pairs = 20000;
        for (int i = 0; i < pairs; ++i)
        {
            ProxyStore store;
            const Tick begin = 1000, now = begin + static_cast<Tick>(random.index(2));
            for (int k = 0; k < 2; ++k)
            {
                const ProxyId id = add_random_proxy(store, random, 1, begin - static_cast<Tick>(random.index(3)));
                for (double &coordinate : store.paths[id].position)
                    coordinate += place;
                Tick &until = store.records[id].prediction.until;
                until = std::max(until, now);
            }
            check(store, now, found);
            ASSERT_FALSE(HasFailure()) << i;
        }
        EXPECT_GT(found.near, pairs / 100);
        EXPECT_GT(found.apart, pairs / 2);
        EXPECT_LE(found.too_near, pairs / 1000) << place;
    }
}

TEST(PairProximity, LongHorizonsAndFastPathsAreNoLessSafe)
{
    Random random(12);
    Found found;
    for (int i = 0; i < 20000; ++i)
    {
        ProxyStore store;
        const Tick now = 7000000;
        for (int k = 0; k < 2; ++k)
        {
            const Path path = {random.vector(100), random.vector(random.chance(0.5) ? 1e-4 : 10),
                               random.vector(random.chance(0.5) ? 0 : 1e-3)};
            const Deviation deviation = {random.uniform(0, 1), random.uniform(0, 1e-3), random.uniform(0, 1e-6)};
            add_proxy(store, path, deviation, random.uniform(0.01, 30), now - static_cast<Tick>(random.index(2000)),
                      2000 + static_cast<Tick>(random.index(1000000)));
        }
        check(store, now, found);
        ASSERT_FALSE(HasFailure()) << i;
    }
    EXPECT_GT(found.near, 1000);
    EXPECT_GT(found.apart, 1000);
}

// Two that pass the check where it lets them come nearest, at some tick, and just touch there.
TEST(PairProximity, ExpectsWhateverPassesTheCheck)
{
    Random random(14);
    int touching = 0;
    for (int i = 0; i < 20000; ++i)
    {
        ProxyStore store;
        constexpr Tick now = 5000, most = 2000;
        const double size = std::pow(10, random.uniform(-2, 3));
        const Vector3 place = Vector3::Constant(random.chance(0.3) ? 1e11 * size : 0);
        for (int k = 0; k < 2; ++k)
        {
            const Path path = {place + size * random.vector(0.4), random.vector(random.chance(0.5) ? 0.1 : 1e-4) * size,
                               random.vector(random.chance(0.5) ? 0 : 1e-5) * size};
            const Deviation deviation = {random.uniform(0, 0.02) * size, random.uniform(0, 1e-3) * size, 0};
            add_proxy(store, path, deviation, size, now - static_cast<Tick>(random.index(500)), 500 + most);
        }
        const Tick then = now + static_cast<Tick>(random.index(1000));
        const auto gap = [&] {
            return farthest(store.paths[1], then, -1).x() + store.records[1].prediction.low[0] -
                   (farthest(store.paths[0], then, 1).x() + store.records[0].prediction.high[0]);
        };
        const Vector3 apart = store.paths[1].path().at(ticks_between(store.paths[1].since, then)) -
                              store.paths[0].path().at(ticks_between(store.paths[0].since, then));
        for (int axis : {1, 2})
            store.paths[1].position[axis] -= apart[axis];
        for (int round = 0; round < 4; ++round)
            store.paths[1].position[0] -= gap();
        if (!(gap() <= 0))
            continue;
        ++touching;
        const double ticks = then - now;
        for (ProxyId id : {0u, 1u})
        {
            const auto interval = PairProximity(store, id, now, ProximityTest::box).to(1 - id);
            ASSERT_TRUE(interval) << i;
            EXPECT_LE(interval->enter, ticks) << i;
            EXPECT_GE(interval->leave, ticks) << i;
        }
        ASSERT_FALSE(HasFailure());
    }
    EXPECT_GT(touching, 5000);
}

TEST(PairProximity, TheOrderDoesNotMatterMuch)
{
    Random random(13);
    for (int i = 0; i < 5000; ++i)
    {
        ProxyStore store;
        add_random_proxy(store, random, 1, 50);
        add_random_proxy(store, random, 1, 50);
        const auto forth = PairProximity(store, 0, 50, ProximityTest::box).to(1),
                   back = PairProximity(store, 1, 50, ProximityTest::box).to(0);
        if (forth && back)
        {
            EXPECT_NEAR(forth->enter, back->enter, 1e-3);
        }
    }
}

// A plane's bounds end on one side; the other is never apart.
TEST(PairProximity, InfiniteSidesAreNeverApart)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0);
    std::fill(store.records[0].prediction.low, store.records[0].prediction.low + 3,
              -std::numeric_limits<float>::infinity());
    std::fill(store.records[0].prediction.high, store.records[0].prediction.high + 2,
              std::numeric_limits<float>::infinity());
    store.records[0].prediction.high[2] = 0;
    add_proxy(store, {{0, 0, 5}, {0, 0, -0.25}, Vector3::Zero()}, {}, 1, 10, 60);
    for (ProxyId id : {0u, 1u})
    {
        const auto interval = PairProximity(store, id, 10, ProximityTest::box).to(1 - id);
        ASSERT_TRUE(interval);
        EXPECT_NEAR(interval->enter, 16, 1e-3) << "4 / 0.25";
        EXPECT_EQ(interval->leave, infinity);
    }
    store.paths[1].velocity[2] = 0.25f;
    EXPECT_FALSE(PairProximity(store, 0, 10, ProximityTest::box).to(1));
    EXPECT_FALSE(PairProximity(store, 1, 10, ProximityTest::box).to(0));
}

TEST(PairProximity, WhatIsNotANumberIsNear)
{
    for (int what = 0; what < 5; ++what)
    {
        ProxyStore store;
        add_still_proxy(store, {0, 0, 0}, 1, 0);
        add_proxy(store, {{50, 0, 0}, {0.1, 0, 0}, Vector3::Zero()}, {0.1, 0, 0}, 1, 10, 60);
        ASSERT_FALSE(PairProximity(store, 0, 10, ProximityTest::box).to(1));
        PackedPath &path = store.paths[1];
        ProxyRecord::Prediction &bounds = store.records[1].prediction;
        if (what == 0)
            path.position[1] = std::numeric_limits<double>::quiet_NaN();
        else if (what == 4)
            path.position[0] = 1e300;
        else
            (what == 1 ? path.velocity : what == 2 ? bounds.low : &path.deviation_base)[0] = float_nan;
        for (ProxyId id : {0u, 1u})
        {
            const auto interval = PairProximity(store, id, 10, ProximityTest::box).to(1 - id);
            ASSERT_TRUE(interval) << what;
            EXPECT_EQ(interval->enter, 0);
            EXPECT_EQ(interval->leave, infinity);
        }
    }
}

// What one object's half says must not depend on how long ago it was predicted.
TEST(PairProximity, CountsFromNow)
{
    ProxyStore store;
    add_proxy(store, {{0, 0, 0}, {0.5, 0, 0}, Vector3::Zero()}, {}, 1, 0, 100);
    add_proxy(store, {{22, 0, 0}, {-0.5, 0, 0}, Vector3::Zero()}, {}, 1, 4, 100);
    EXPECT_NEAR(PairProximity(store, 0, 4, ProximityTest::box).to(1)->enter, 18, 1e-3) << "20 - 4 * 0.5 = 18";
    EXPECT_NEAR(PairProximity(store, 1, 10, ProximityTest::box).to(0)->enter, 12, 1e-3);
}
} // namespace
} // namespace ode_predictive_space
