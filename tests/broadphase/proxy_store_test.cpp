#include "ode_predictive_space/broadphase/objects/proxy_store.h"

#include <gtest/gtest.h>

#include "tests/broadphase/support/proxies.h"

namespace ode_predictive_space
{
namespace
{
bool encloses(const FloatBox &outer, const Box &inner)
{
    for (int axis = 0; axis < 3; ++axis)
        if (!(outer.low[axis] <= inner.min()[axis] && inner.max()[axis] <= outer.high[axis]))
            return false;
    return true;
}

TEST(ProxyStore, CountsTheTimeOfAnEnvelopeFromNow)
{
    ProxyStore store;
    const ProxyId id = add_proxy(store, {{1, 2, 3}, {0.5, 0, -0.25}, {0.125, 0, 0}}, {0.25, 0.5, 0.125}, 1, 100, 50);
    for (Tick now : {100u, 101u, 130u, 150u})
    {
        const Envelope since = store.envelope(id, 100);
        const double t = now - 100.0;
        EXPECT_TRUE(store.envelope(id, now).at(0).isApprox(since.at(t))) << now;
        EXPECT_TRUE(store.envelope(id, now).at(7).isApprox(since.at(t + 7))) << now;
        EXPECT_EQ(store.remaining(id, now), static_cast<std::int32_t>(150 - now));
    }
}

TEST(ProxyStore, AStillEnvelopeKnowsNoTime)
{
    ProxyStore store;
    const ProxyId id = add_still_proxy(store, {1, 2, 3}, 1, 0.25);
    const Box there = store.envelope(id, 0).at(0);
    EXPECT_EQ(there.min(), Vector3(-0.25, 0.75, 1.75));
    for (Tick now : {1u, 1000000u, 0x80000000u, 0xffffffffu})
    {
        EXPECT_TRUE(store.envelope(id, now).at(0).isApprox(there));
        EXPECT_GT(store.remaining(id, now), 1000000);
    }
}

TEST(ProxyStore, TimeMayWrapAround)
{
    ProxyStore store;
    const Tick since = 0xfffffff0u;
    const ProxyId id = add_proxy(store, {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, {}, 1, since, 40);
    EXPECT_EQ(store.envelope(id, since + 20).at(0).center().x(), 20);
    EXPECT_EQ(store.remaining(id, since + 20), 20);
    EXPECT_LT(since + 20, since) << "the test is about the wrap-around";
}

TEST(ProxyStore, TheSweptBoxHoldsTheEnvelopeUntilItsEnd)
{
    Random random(1);
    for (int i = 0; i < 20000; ++i)
    {
        ProxyStore store;
        const Path path = {random.vector(10), random.vector(0.5), random.vector(0.02)};
        const Deviation deviation = {random.uniform(0, 0.1), random.uniform(0, 0.1), random.uniform(0, 0.01)};
        const ProxyId id = add_proxy(store, path, deviation, random.uniform(0.01, 1), 50, 60);
        const Tick now = 50 + static_cast<Tick>(random.index(60));
        const FloatBox swept = store.swept_box(id, now);
        for (std::int32_t t = 0; t <= store.remaining(id, now); ++t)
        {
            ASSERT_TRUE(encloses(swept, store.envelope(id, now).at(t)));
            ASSERT_TRUE(encloses(swept, store.envelope(id, now + static_cast<Tick>(t)).at(0)));
        }
    }
}

TEST(ProxyStore, TheBoxOfAStillEnvelopeIsNoLargerThanItself)
{
    ProxyStore store;
    const ProxyId id = add_still_proxy(store, {1, 2, 3}, 0.5, 0.25);
    const FloatBox box = store.swept_box(id, 12345);
    EXPECT_EQ(box.low[0], 0.25f);
    EXPECT_EQ(box.high[2], 3.75f);
}

TEST(ProxyStore, AGenerationIsCurrentUntilTheNext)
{
    ProxyStore store;
    const ProxyId id = add_still_proxy(store, {0, 0, 0}, 1, 0);
    const Generation generation = store.generations[id];
    EXPECT_TRUE(store.current(id, generation));
    ++store.generations[id];
    EXPECT_FALSE(store.current(id, generation));
}

// The box that a scene in single precision computes from a centre that passed the check.
TEST(ProxyStore, TheOuterEnvelopeHoldsWhatASceneInSinglePrecisionComputes)
{
    Random random(2);
    constexpr float epsilon = std::numeric_limits<float>::epsilon();
    for (int i = 0; i < 20000; ++i)
    {
        ProxyStore store(epsilon);
        const Vector3 place = random.vector(i % 2 ? 1 : 1e5);
        const auto radius = static_cast<float>(random.uniform(0.1, 10));
        const ProxyId id = add_still_proxy(store, place, radius, 0.01);
        Box computed;
        for (int axis = 0; axis < 3; ++axis)
        {
            const double reach = store.paths[id].deviation_base;
            const auto lowest = static_cast<float>(place[axis] - reach),
                       highest = static_cast<float>(place[axis] + reach);
            computed.min()[axis] = lowest - radius;
            computed.max()[axis] = highest + radius;
        }
        ASSERT_TRUE(encloses(FloatBox::around(store.outer_envelope(id, 0).at(0)), computed)) << i;
    }
    EXPECT_EQ(ProxyStore().scene_rounding(), 0);
    EXPECT_EQ(ProxyStore(epsilon).scene_rounding(), 8 * double{epsilon});
}

TEST(ProxyStore, ANumberIsUsedAgainWithNothingLeftButANewGeneration)
{
    ProxyStore store;
    const ProxyId first = add_still_proxy(store, {1, 2, 3}, 1, 0), second = store.add();
    EXPECT_EQ(store.count(), 2u);
    EXPECT_TRUE(store.predicted(first));
    const Generation generation = store.generations[first];
    store.records[first].role = Role::fixed_interactive;
    store.remove(first);
    EXPECT_EQ(store.count(), 1u);
    EXPECT_FALSE(store.members().contains(first));
    EXPECT_TRUE(store.members().contains(second));
    EXPECT_FALSE(store.current(first, generation)) << "its pairs and events are stale";
    EXPECT_EQ(store.add(), first);
    EXPECT_EQ(store.size(), 2u);
    EXPECT_EQ(store.count(), 2u);
    EXPECT_FALSE(store.current(first, generation));
    EXPECT_FALSE(store.predicted(first));
    EXPECT_EQ(store.records[first].role, Role::environment);
    EXPECT_EQ(store.records[first].learned.history, no_history);
    EXPECT_LT(store.stamps[first].radius, 0);
}

TEST(ProxyStore, ForgettingAPredictionKeepsWhatWasLearned)
{
    ProxyStore store;
    const ProxyId id = add_still_proxy(store, {1, 2, 3}, 1, 0);
    store.records[id].learned.horizon = 77;
    store.forget_prediction(id);
    EXPECT_FALSE(store.predicted(id));
    EXPECT_LT(store.stamps[id].radius, 0);
    EXPECT_EQ(store.records[id].learned.horizon, 77u);
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
