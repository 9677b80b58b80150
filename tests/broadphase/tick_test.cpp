// The tick as a whole: when time passes, what is counted, how the work is spread, when the scene is swept instead.

#include <gtest/gtest.h>

#include "tests/broadphase/support/calm_gas.h"
#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
TEST(Tick, PassesTimeWhenSomethingHasMoved)
{
    World world;
    const ProxyId id = world.add(ball({0, 0, 0}, 1, {0, 0, 0}));
    world.tick();
    const Tick start = world.broadphase.now();
    for (Tick tick = 1; tick <= 10; ++tick)
    {
        world.place(id, {0.01 * tick, 0, 0});
        world.tick();
        EXPECT_EQ(world.broadphase.now(), start + tick);
    }
}

TEST(Tick, StandsStillWhileNothingMoves)
{
    CalmGas gas(100);
    gas.run(50);
    const Tick before = gas.world.broadphase.now();
    const std::uint64_t predictions = gas.predictions();
    const Pairs pairs = gas.world.report();
    for (int repetition = 0; repetition < 2000; ++repetition)
    {
        gas.world.broadphase.tick(gas.world);
        ASSERT_EQ(gas.world.report(), pairs);
    }
    EXPECT_EQ(gas.world.broadphase.now(), before);
    EXPECT_EQ(gas.predictions(), predictions) << "not even horizons end while nothing moves";
    EXPECT_EQ(gas.world.violated_invariant(), "");
}

TEST(Tick, CatchingUpAfterAStepIsTheTickOfThatStep)
{
    CalmGas asked(100), untouched(100);
    for (int tick = 0; tick < 300; ++tick)
    {
        asked.world.advance();
        asked.world.broadphase.catch_up(asked.world);
        asked.world.broadphase.catch_up(asked.world);
        asked.world.tick();
        untouched.world.advance();
        untouched.world.tick();
    }
    EXPECT_NEAR(asked.world.broadphase.now(), untouched.world.broadphase.now(), 2);
    EXPECT_LE(asked.predictions(), untouched.predictions() + untouched.predictions() / 10)
        << "a question must not break predictions";
}

TEST(Tick, ASingleMoveBetweenTicksIsNoTick)
{
    CalmGas gas(100);
    gas.run(100);
    const Tick before = gas.world.broadphase.now();
    const std::uint64_t violations = gas.world.broadphase.counters().violations;
    gas.world.place(0, {0, 0, 0});
    gas.world.broadphase.catch_up(gas.world);
    EXPECT_EQ(gas.world.broadphase.now(), before);
    EXPECT_LE(gas.world.broadphase.counters().violations, violations + 1)
        << "the others were not expected to have moved";
    EXPECT_EQ(gas.world.violated_invariant(), "");
}

TEST(Tick, SeesThatAnObjectWithoutReportsHasStopped)
{
    World world;
    const ProxyId moving = world.add(ball({0, 0, 0}, 0.1, {0.001, 0, 0}));
    const ProxyId other = world.add(ball({0.5, 5, 0}, 0.1, {0.001, 0, 0}));
    for (int tick = 0; tick < 100; ++tick)
    {
        world.advance();
        world.tick();
    }
    world.object(moving).displacement = Vector3::Zero();
    world.object(moving).velocity = Vector3::Zero();
    for (int tick = 0; tick < 500; ++tick)
    {
        world.advance();
        world.tick();
        ASSERT_EQ(world.violated_invariant(), "") << "tick " << tick;
    }
    EXPECT_TRUE(world.broadphase.proxies().records[moving].kind.still);
    EXPECT_FALSE(world.broadphase.proxies().records[other].kind.still);
}

// The slow path would hold for long, and the object would be looked at in each tick.
TEST(Tick, PredictsThatAStoppedObjectWillStay)
{
    World world;
    const ProxyId slow = world.add(ball({0, 0, 0}, 0.1, {0.00002, 0, 0}));
    world.add(ball({0.5, 5, 0}, 0.1, {0.001, 0, 0}));
    for (int tick = 0; tick < 200; ++tick)
    {
        world.advance();
        world.tick();
    }
    ASSERT_FALSE(world.broadphase.proxies().records[slow].kind.still);
    world.object(slow).displacement = Vector3::Zero();
    world.object(slow).velocity = Vector3::Zero();
    const std::uint64_t broken = world.broadphase.counters().violations;
    for (int tick = 0; tick < 40; ++tick)
    {
        world.advance();
        world.tick();
    }
    EXPECT_TRUE(world.broadphase.proxies().records[slow].kind.still);
    EXPECT_EQ(world.broadphase.counters().violations, broken) << "it had not left its envelope";
    EXPECT_EQ(world.violated_invariant(), "");
}

TEST(Tick, AnObjectAtRestLosesItsNeighbour)
{
    World world;
    const ProxyId still = world.add(ball({0.1, 0, 0}, 0.1, {0, 0, 0}));
    const ProxyId mover = world.add(ball({-0.2004, 0, 0}, 0.1, {0.001, 0, 0}));
    world.add(ball({0.5, 5, 0}, 0.1, {0.001, 0, 0}));
    for (int tick = 0; tick < 400; ++tick)
    {
        // The object stops less than its slack before the other.
        if (world.object(mover).centre.x() > -0.101)
        {
            world.object(mover).displacement = Vector3::Zero();
            world.object(mover).velocity = Vector3::Zero();
        }
        world.advance();
        world.tick();
        if (tick == 110)
        {
            EXPECT_EQ(world.broadphase.near_pairs(), 1u);
        }
    }
    EXPECT_EQ(world.broadphase.near_pairs(), 0u);
    EXPECT_EQ(world.broadphase.proxies().paths[mover].deviation_base, 0);
    EXPECT_EQ(world.violated_invariant(), "");
    world.place(mover, world.object(mover).centre + Vector3(0.001, 0, 0));
    EXPECT_EQ(world.tick(), (Pairs{{mover, still}}));
}

TEST(Tick, DoesNotDependOnTheOrderOfReports)
{
    CalmGas forwards(150), backwards(150);
    for (int tick = 0; tick < 300; ++tick)
    {
        const Pairs expected = forwards.tick();
        // All moves are reported beforehand, the last object first; the moves themselves then bring nothing new.
        std::vector<ProxyId> members = backwards.world.members();
        for (auto id = members.rbegin(); id != members.rend(); ++id)
            backwards.world.touch(*id);
        ASSERT_EQ(backwards.tick(), expected) << "tick " << tick;
    }
}

TEST(Tick, CountsWhatItDoes)
{
    CalmGas gas(50);
    gas.run(1);
    const Counters &counters = gas.world.broadphase.counters();
    EXPECT_EQ(counters.moved, 50u);
    EXPECT_EQ(counters.repredictions, 50u);
    EXPECT_EQ(counters.violations, 0u) << "an object without a prediction cannot break it";
    gas.run(10);
    EXPECT_EQ(counters.moved, 550u);
    EXPECT_GE(counters.verified, 500u);
    gas.world.place(0, {100, 0, 0});
    const std::uint64_t before = counters.violations;
    gas.world.tick();
    EXPECT_GE(counters.violations, before + 1);
    EXPECT_EQ(counters.sweeps, 0u);
}

TEST(Tick, PredictsSeldomInUniformMotion)
{
    CalmGas gas(500);
    gas.run(400);
    const std::uint64_t before = gas.predictions();
    gas.run(1000);
    const double per_tick = static_cast<double>(gas.predictions() - before) / 1000 / gas.objects();
    RecordProperty("predictions_per_object_and_tick", std::to_string(per_tick));
    EXPECT_LT(per_tick, 1.0 / 20);
    EXPECT_EQ(gas.world.broadphase.counters().sweeps, 0u);
    EXPECT_EQ(gas.world.violated_invariant(), "");
}

TEST(Tick, SleepsUntilTheTimeOfProximity)
{
    World world;
    world.add(ball({0, 0, 0}, 0.1, {0.0005, 0, 0}));
    world.add(ball({0.4, 0, 0}, 0.1, {0, 0, 0}));
    std::size_t near_ticks = 0, overlapping_ticks = 0;
    for (int tick = 0; tick < 1000; ++tick)
    {
        world.advance();
        overlapping_ticks += world.tick().size();
        near_ticks += world.broadphase.near_pairs();
    }
    EXPECT_GT(overlapping_ticks, 500u);
    EXPECT_LT(near_ticks, overlapping_ticks + 100) << "apart, the pair should not be tested";
    EXPECT_GT(world.broadphase.counters().woken, 0u);
}

// Objects that were predicted together must not expire together: haptics depends on the slowest tick.
TEST(Tick, SpreadsTheEndsOfHorizons)
{
    CalmGas gas(1000);
    gas.run(1000);
    std::uint64_t most = 0;
    const std::uint64_t start = gas.predictions();
    constexpr int ticks = 1000;
    for (int tick = 0; tick < ticks; ++tick)
    {
        const std::uint64_t before = gas.predictions();
        gas.tick();
        most = std::max(most, gas.predictions() - before);
    }
    const double mean = static_cast<double>(gas.predictions() - start) / ticks;
    EXPECT_LT(static_cast<double>(most), 6 * mean + 10);
}

// Half of them still, half moving, in a program without questions.
World newcomers(std::size_t count)
{
    World world;
    world.broadphase = Broadphase();
    Random random(7);
    for (std::size_t i = 0; i < count; ++i)
        world.add(ball(random.vector(5), 0.1, i % 2 ? random.vector(0.001) : Vector3::Zero()));
    return world;
}

TEST(Tick, NewObjectsAreSweptUntilItIsKnownHowTheyMove)
{
    for (std::size_t count : {2, 30, 1000})
    {
        World world = newcomers(count);
        for (int tick = 0; tick < 30; ++tick)
        {
            world.advance();
            ASSERT_EQ(sorted_pairs(world.tick()), world.overlapping());
        }
        EXPECT_EQ(world.broadphase.mode(), Mode::predicting);
        const Counters &counters = world.broadphase.counters();
        EXPECT_GE(counters.sweeps, 3u) << count;
        EXPECT_LE(counters.sweeps, count < 100 ? 5u : 20u) << count << ", many of which are predicted in parts";
        EXPECT_LT(counters.repredictions, 2 * count) << "predicted once, when it is known how far velocities carry";
        EXPECT_EQ(counters.violations, 0u);
        EXPECT_EQ(world.violated_invariant(), "");
    }
}

TEST(Tick, PredictionsAreMadeAtOnceWhenWanted)
{
    World world = newcomers(100);
    world.advance();
    world.tick();
    EXPECT_EQ(world.broadphase.counters().repredictions, 0u);
    EXPECT_TRUE(world.broadphase.want_predictions());
    world.broadphase.catch_up(world);
    EXPECT_GE(world.broadphase.counters().repredictions, 100u);
    EXPECT_EQ(world.broadphase.mode(), Mode::predicting);
    EXPECT_FALSE(world.broadphase.want_predictions()) << "the predictions are made";
    EXPECT_EQ(sorted_pairs(world.report()), world.overlapping());
    EXPECT_EQ(world.violated_invariant(), "");
}

TEST(Tick, ManyNewObjectsAmongFewOldOnesAreSwept)
{
    World world = newcomers(20);
    for (int tick = 0; tick < 30; ++tick)
    {
        world.advance();
        world.tick();
    }
    const std::uint64_t sweeps = world.broadphase.counters().sweeps;
    for (int i = 0; i < 100; ++i)
        world.add(ball({0.1 * i, 3, 0}, 0.1, {0, 0.001, 0}));
    for (int tick = 0; tick < 30; ++tick)
    {
        world.advance();
        ASSERT_EQ(sorted_pairs(world.tick()), world.overlapping());
    }
    EXPECT_GT(world.broadphase.counters().sweeps, sweeps);
    EXPECT_EQ(world.broadphase.mode(), Mode::predicting);
}

TEST(Tick, AnExplosionIsNoReasonToSweepForLong)
{
    CalmGas gas(200);
    gas.run(300);
    for (int explosion = 0; explosion < 5; ++explosion)
    {
        gas.scatter();
        ASSERT_EQ(sorted_pairs(gas.world.tick()), gas.world.overlapping());
        gas.run(100);
    }
    EXPECT_EQ(gas.world.broadphase.mode(), Mode::predicting);
}

class Teleports : public testing::Test
{
protected:
    Teleports() : gas(200) { gas.run(50); }

    // Ticks of teleports until sweeping has begun.
    int teleport_until_swept()
    {
        for (int tick = 1; tick < 100; ++tick)
        {
            gas.scatter();
            EXPECT_EQ(sorted_pairs(gas.world.tick()), gas.world.overlapping());
            if (gas.world.broadphase.mode() == Mode::sweeping)
                return tick;
        }
        return 100;
    }

    CalmGas gas;
};

TEST_F(Teleports, AreSwept)
{
    EXPECT_LT(teleport_until_swept(), 10);
    const std::uint64_t predictions = gas.predictions();
    const std::uint64_t sweeps = gas.world.broadphase.counters().sweeps;
    for (int tick = 0; tick < 500; ++tick)
    {
        gas.scatter();
        ASSERT_EQ(sorted_pairs(gas.world.tick()), gas.world.overlapping()) << "tick " << tick;
        ASSERT_EQ(gas.world.violated_invariant(), "");
    }
    EXPECT_GT(gas.world.broadphase.counters().sweeps, sweeps + 400);
    EXPECT_LT(static_cast<double>(gas.predictions() - predictions), 0.2 * 500 * gas.objects());
}

TEST_F(Teleports, AreForgottenWhenCalmReturns)
{
    ASSERT_LT(teleport_until_swept(), 100);
    int ticks = 0;
    while (gas.world.broadphase.mode() != Mode::predicting && ticks < 1000)
    {
        const Pairs reported = sorted_pairs(gas.tick());
        ASSERT_EQ(reported, gas.world.overlapping()) << "tick " << ticks;
        ++ticks;
    }
    EXPECT_LT(ticks, 1000) << "sweeping does not end";
    gas.run(500);
    EXPECT_EQ(gas.world.broadphase.mode(), Mode::predicting);
    const std::uint64_t before = gas.predictions();
    gas.run(500);
    EXPECT_LT(static_cast<double>(gas.predictions() - before) / 500 / gas.objects(), 1.0 / 20);
    EXPECT_EQ(gas.world.violated_invariant(), "");
}

TEST_F(Teleports, MayEndInStillness)
{
    ASSERT_LT(teleport_until_swept(), 100);
    const Pairs pairs = sorted_pairs(gas.world.report());
    for (int tick = 0; tick < 100; ++tick)
    {
        gas.world.broadphase.tick(gas.world);
        ASSERT_EQ(sorted_pairs(gas.world.report()), pairs);
    }
}

TEST_F(Teleports, LetObjectsComeAndGo)
{
    Random random(7);
    ASSERT_LT(teleport_until_swept(), 100);
    for (int tick = 0; tick < 200; ++tick)
    {
        gas.world.remove(static_cast<ProxyId>(tick));
        gas.world.broadphase.catch_up(gas.world);
        ASSERT_EQ(sorted_pairs(gas.world.report()), gas.world.overlapping()) << "tick " << tick;
        gas.world.add(ball(random.vector(2), 0.3, {0, 0, 0}));
        gas.world.broadphase.catch_up(gas.world);
        ASSERT_EQ(sorted_pairs(gas.world.report()), gas.world.overlapping()) << "tick " << tick;
        gas.scatter();
        ASSERT_EQ(sorted_pairs(gas.world.tick()), gas.world.overlapping()) << "tick " << tick;
    }
}

// The results of the old proximity test used to be kept while nothing moved.
TEST_F(Teleports, LetTheProximityTestChangeWhileTheSceneIsSwept)
{
    ASSERT_LT(teleport_until_swept(), 100);
    Broadphase &broadphase = gas.world.broadphase;
    std::size_t difference = 0;
    for (int tick = 0; tick < 20; ++tick)
    {
        gas.scatter();
        gas.world.tick();
        const std::size_t by_boxes = gas.world.overlapping().size();
        for (ProximityTest test : {ProximityTest::sphere, ProximityTest::box})
        {
            broadphase.set_proximity_test(test);
            ASSERT_EQ(sorted_pairs(gas.world.tick()), gas.world.overlapping());
            difference += by_boxes - gas.world.overlapping().size();
        }
    }
    EXPECT_GT(difference, 0u) << "the test needs pairs of which only the boxes overlap";
}

TEST_F(Teleports, LetRolesBeSetWhileTheSceneIsSwept)
{
    ASSERT_LT(teleport_until_swept(), 100);
    for (int tick = 0; tick < 300; ++tick)
    {
        gas.world.broadphase.set_role(static_cast<ProxyId>(tick % 200), Role::fixed_interactive);
        const Pairs reported = sorted_pairs(gas.tick());
        ASSERT_EQ(reported, gas.world.overlapping()) << "tick " << tick;
    }
    EXPECT_EQ(gas.world.violated_invariant(), "");
}
} // namespace
} // namespace ode_predictive_space
