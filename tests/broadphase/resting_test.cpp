// Pairs of two objects that have not moved for a while are not tested until one of them changes.

#include <cmath>

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/tuning.h"
#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
constexpr int long_enough = 200;

// A row of boxes of which each touches the next, a pair with a tiny gap, and a far object that moves, so that time passes.
class Resting : public testing::Test
{
protected:
    Resting()
    {
        for (int i = 0; i < count; ++i)
            world.add(box(Vector3(0.19 * i, 0, 0), Vector3::Constant(0.1), Vector3::Zero(), true));
        const ProxyId beside = world.add(box(Vector3(0, 0.2 + 1e-9, 0), Vector3::Constant(0.1), Vector3::Zero(), true));
        EXPECT_EQ(beside, neighbour);
        world.add(ball(Vector3(0, 0, 100), 0.1, Vector3(0.0001, 0, 0)));
        run(long_enough);
    }

    void tick()
    {
        world.advance();
        ASSERT_EQ(sorted_pairs(world.tick()), sorted_pairs(world.overlapping()));
        ASSERT_EQ(world.violated_invariant(), "");
    }

    void run(int ticks)
    {
        for (int i = 0; i < ticks; ++i)
            tick();
    }

    std::size_t tested() const { return world.tested_pairs(); }

    static constexpr int count = 10;
    static constexpr ProxyId neighbour = count;
    World world;
};

TEST_F(Resting, PairsThatDoNotMoveAreNotTested)
{
    EXPECT_EQ(tested(), 0u);
    EXPECT_GE(world.broadphase.near_pairs(), std::size_t{count - 1});
    const std::uint64_t woken = world.broadphase.woken_pairs();
    world.place(0, {1e-5, 0, 0});
    tick();
    EXPECT_EQ(world.broadphase.woken_pairs(), woken + 2) << "that with its touching neighbour, and that with a gap";
}

// Many searches between two ticks drop stale pairs of the near set in between.
TEST_F(Resting, NoPairIsReportedTwiceAfterManyQueries)
{
    constexpr int crowd = 60;
    const Vector3 place(0, 50, 0);
    std::vector<ProxyId> ids;
    for (int i = 0; i < crowd; ++i)
        ids.push_back(world.add(box(place, Vector3::Constant(0.1), Vector3::Zero(), true)));
    tick();
    world.broadphase.set_role(3, Role::fixed_environment);
    std::size_t before = 0;
    do
    {
        before = tested();
        for (ProxyId id : ids)
            world.place(id, world.object(id).centre + Vector3(0.01, 0, 0));
        world.broadphase.find_new_pairs(world);
    } while (tested() > before);
    EXPECT_EQ(sorted_pairs(world.tick()), sorted_pairs(world.overlapping()));
}

TEST_F(Resting, PairsThatMoveAreTestedOn)
{
    for (int i = 0; i < long_enough; ++i)
    {
        world.place(0, world.object(0).centre + Vector3(0, i % 2 ? 1e-4 : -1e-4, 0));
        tick();
        ASSERT_GE(tested(), 1u);
    }
    EXPECT_LE(tested(), 4u);
}

// Only some reports check which pairs may rest. A move before any of the reports in between must be seen.
TEST_F(Resting, PairsThatMoveOnceBetweenTwoLooksAreTestedOn)
{
    constexpr auto period = static_cast<int>(tuning::reports_per_rest);
    for (int phase = 0; phase < period; ++phase)
    {
        const std::uint64_t woken = world.broadphase.woken_pairs();
        for (int i = 0; i < 4 * period; ++i)
        {
            if (i % period == phase)
                world.place(0, world.object(0).centre + Vector3(0, i / period % 2 ? 1e-5 : -1e-5, 0));
            tick();
        }
        EXPECT_LE(world.broadphase.woken_pairs(), woken + 2) << "they came to rest in between, " << phase;
        run(long_enough);
    }
}

TEST_F(Resting, PairsRestAfterAtMostTwoLooks)
{
    constexpr auto period = static_cast<int>(tuning::reports_per_rest);
    for (int phase = 0; phase < period; ++phase)
    {
        run(long_enough / period * period + 1);
        world.place(0, world.object(0).centre + Vector3(0, phase % 2 ? 1e-5 : -1e-5, 0));
        run(2 * period);
        EXPECT_EQ(tested(), 0u) << phase;
    }
}

TEST(RestingAtRandom, ReportsWhatOverlaps)
{
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
    {
        Random random(seed);
        World world;
        const auto anywhere = [&] {
            return box(random.vector(0.6), Vector3::Constant(random.uniform(0.05, 0.15)), Vector3::Zero(), true);
        };
        for (int i = 0; i < 60; ++i)
            world.add(anywhere());
        world.add(ball(Vector3(0, 0, 100), 0.1, Vector3(0.0001, 0, 0)));
        std::size_t ticks_at_rest = 0;
        for (int tick = 0; tick < 3000; ++tick)
        {
            world.advance();
            const ProxyId id = static_cast<ProxyId>(random.index(60));
            if (world.present(id) && random.chance(0.02))
                world.place(id, world.object(id).centre + random.vector(random.chance(0.5) ? 1e-3 : 0.3));
            if (world.present(id) && random.chance(0.005))
                world.remove(id);
            if (random.chance(0.005))
                world.add(anywhere());
            ASSERT_EQ(sorted_pairs(world.tick()), sorted_pairs(world.overlapping())) << seed << " at " << tick;
            ASSERT_EQ(world.violated_invariant(), "") << seed << " at " << tick;
            ticks_at_rest += world.tested_pairs() < world.broadphase.near_pairs() / 2;
        }
        EXPECT_GT(ticks_at_rest, 1000u);
    }
}
} // namespace
} // namespace ode_predictive_space
