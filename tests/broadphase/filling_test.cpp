// The mode `filling`: many predictions are made in parts, while all objects are swept.

#include <gtest/gtest.h>

#include "tests/broadphase/support/calm_gas.h"

namespace ode_predictive_space
{
namespace
{
TEST(Sweeping, StartsWithPrediction)
{
    EXPECT_EQ(Sweeping().mode(), Mode::predicting);
}

class Filling : public testing::Test
{
protected:
    static constexpr std::size_t count = 1000;
    static constexpr std::size_t most_at_once = count / 16;

    Filling() : gas(count) { gas.run(300); }

    bool swept() const { return gas.world.broadphase.mode() != Mode::predicting; }

    // A tick that reports the overlapping pairs.
    void tick()
    {
        const Pairs reported = sorted_pairs(gas.tick());
        ASSERT_EQ(reported, gas.world.overlapping());
    }

    // Ticks from an explosion on, until too many predictions are broken for one tick.
    void explode()
    {
        gas.explode();
        for (int ticks = 0; ticks < 20 && !swept(); ++ticks)
            tick();
        ASSERT_TRUE(swept());
    }

    // Ticks until all are predicted again.
    int ticks_to_the_end()
    {
        int ticks = 0;
        for (; swept() && ticks < 200; ++ticks)
            tick();
        return ticks;
    }

    CalmGas gas;
};

TEST_F(Filling, PredictsFewObjectsPerTickAfterAnExplosion)
{
    ASSERT_FALSE(swept());
    std::uint64_t most = 0;
    for (int explosion = 0; explosion < 3; ++explosion)
    {
        gas.explode();
        for (int ticks = 0; ticks < 100; ++ticks)
        {
            const std::uint64_t before = gas.predictions();
            tick();
            most = std::max(most, gas.predictions() - before);
        }
        EXPECT_FALSE(swept()) << "filling does not end";
    }
    EXPECT_LT(most, 2 * most_at_once) << "with the objects whose horizons end";
    EXPECT_EQ(gas.world.violated_invariant(), "");
}

TEST_F(Filling, ComesToItsEnd)
{
    explode();
    EXPECT_LE(ticks_to_the_end(), 60);
    const std::uint64_t sweeps = gas.world.broadphase.counters().sweeps;
    for (int ticks = 0; ticks < 100; ++ticks)
        tick();
    EXPECT_EQ(gas.world.broadphase.counters().sweeps, sweeps) << "no more sweeps afterwards";
}

TEST_F(Filling, ComesToItsEndAmongIdleObjects)
{
    explode();
    for (ProxyId id = 0; id < count; id += 7)
        gas.world.object(id).enabled = false;
    EXPECT_LE(ticks_to_the_end(), 60);
}

// Each part of the scene then makes a good part of a tree.
TEST_F(Filling, PredictsNeighboursTogether)
{
    explode();
    const auto predicted = [this] {
        std::vector<bool> result;
        for (ProxyId id : gas.world.members())
            result.push_back(gas.world.broadphase.predicted(id));
        return result;
    };
    int slabs = 0;
    for (int ticks = 0; swept() && ticks < 200; ++ticks)
    {
        const std::vector<bool> before = predicted();
        tick();
        const std::vector<bool> after = predicted();
        Box part, all;
        int size = 0;
        for (ProxyId id = 0; id < count; ++id)
        {
            all.extend(gas.world.object(id).centre);
            if (after[id] && !before[id])
            {
                part.extend(gas.world.object(id).centre);
                ++size;
            }
        }
        if (size < 50)
            continue;
        ++slabs;
        EXPECT_LT((part.sizes().array() / all.sizes().array()).minCoeff(), 0.2) << size;
    }
    EXPECT_GT(slabs, 10);
}

TEST_F(Filling, DoesNotBeginForAFewBrokenPredictions)
{
    const std::uint64_t sweeps = gas.world.broadphase.counters().sweeps;
    for (int repetition = 0; repetition < 50; ++repetition)
    {
        for (ProxyId id = 0; id < most_at_once - 20; ++id)
            gas.world.object(id).displacement *= -1;
        tick();
        tick();
    }
    EXPECT_EQ(gas.world.broadphase.counters().sweeps, sweeps);
}

TEST_F(Filling, LetsObjectsComeAndGo)
{
    Random random(3);
    explode();
    for (ProxyId id = 0; swept() && id < 200; ++id)
    {
        gas.world.remove(count - 1 - id); // waits
        gas.world.remove(id);             // does not wait
        gas.world.add(ball(random.vector(2), 0.3, random.vector(0.001)));
        if (id % 2)
            gas.world.broadphase.catch_up(gas.world);
        tick();
        ASSERT_EQ(gas.world.violated_invariant(), "");
    }
    EXPECT_FALSE(swept());
}

TEST_F(Filling, LetsSettingsChange)
{
    explode();
    Broadphase &broadphase = gas.world.broadphase;
    for (int ticks = 0; swept() && ticks < 100; ++ticks)
    {
        broadphase.set_proximity_test(ticks % 3 ? ProximityTest::sphere : ProximityTest::box);
        broadphase.set_role(static_cast<ProxyId>(count - 1 - ticks), Role::fixed_interactive);
        tick();
        ASSERT_EQ(gas.world.violated_invariant(), "");
    }
    EXPECT_FALSE(swept());
}

TEST_F(Filling, LetsQueriesFindAll)
{
    explode();
    for (int ticks = 0; swept() && ticks < 100; ++ticks)
    {
        std::size_t found = 0;
        gas.world.broadphase.query({{-1e6f, -1e6f, -1e6f}, {1e6f, 1e6f, 1e6f}}, [&](ProxyId) { ++found; });
        ASSERT_EQ(found, count);
        tick();
    }
}

TEST_F(Filling, GivesTheMemoryOfTheSweepBackWhenTheLastWaitingObjectIsRemoved)
{
    explode();
    const std::size_t bytes = gas.world.broadphase.bytes();
    for (ProxyId id = count; swept(); --id)
        gas.world.remove(id - 1);
    EXPECT_LT(gas.world.broadphase.bytes(), bytes);
    tick();
    EXPECT_EQ(gas.world.violated_invariant(), "");
}

TEST_F(Filling, SweepsAtMostOncePerTick)
{
    for (int ticks = 0; ticks < 200; ++ticks)
    {
        const std::uint64_t sweeps = gas.world.broadphase.counters().sweeps;
        if (ticks < 10)
            gas.scatter();
        tick();
        ASSERT_LE(gas.world.broadphase.counters().sweeps, sweeps + 1) << "tick " << ticks;
    }
    EXPECT_FALSE(swept()) << "the motion is calm again";
}

TEST_F(Filling, LosesNoPairWhileNothingMoves)
{
    explode();
    tick();
    const Pairs pairs = sorted_pairs(gas.world.report());
    for (int ticks = 0; ticks < 50; ++ticks)
    {
        gas.world.broadphase.tick(gas.world);
        ASSERT_EQ(sorted_pairs(gas.world.report()), pairs);
    }
}

TEST_F(Filling, IsGivenUpWhenPredictionsKeepBreaking)
{
    explode();
    std::uint64_t before = gas.predictions();
    for (int ticks = 0; ticks < 100; ++ticks)
    {
        gas.scatter();
        const Pairs reported = sorted_pairs(gas.world.tick());
        ASSERT_EQ(reported, gas.world.overlapping());
        if (ticks == 20)
            before = gas.predictions();
    }
    EXPECT_EQ(gas.predictions(), before) << "all objects are swept and none is predicted";
}
} // namespace
} // namespace ode_predictive_space
