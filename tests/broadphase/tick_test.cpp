// The tick as a whole: when time passes, what is counted, how the work is spread.

#include <gtest/gtest.h>

#include "tests/broadphase/support/calm_gas.h"
#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
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
    EXPECT_EQ(gas.predictions(), predictions) << "nothing leaves its envelope while nothing moves";
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
    EXPECT_EQ(asked.world.broadphase.now(), untouched.world.broadphase.now());
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
    gas.world.broadphase.find_new_pairs(gas.world);
    EXPECT_EQ(gas.world.broadphase.now(), before);
    EXPECT_LE(gas.world.broadphase.counters().violations, violations + 1)
        << "the others were not expected to have moved";
    EXPECT_EQ(gas.world.violated_invariant(), "");
}

TEST(Tick, DoesNotDependOnTheOrderOfReports)
{
    CalmGas forwards(150), backwards(150);
    for (int tick = 0; tick < 300; ++tick)
    {
        const Pairs expected = forwards.tick();
        ASSERT_EQ(backwards.tick_backwards(), expected) << "tick " << tick;
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
    gas.world.place(0, {100, 0, 0});
    const std::uint64_t before = counters.violations;
    gas.world.tick();
    EXPECT_GE(counters.violations, before + 1);
    EXPECT_LE(counters.sweeps, 3u) << "until it is known how far velocities carry";
}

TEST(Tick, PredictsOnceWhatWasAskedFor)
{
    World world;
    const ProxyId id =
        world.add(block({0, 0, 0}, Vector3::Constant(1), {1e-6, 0, 0}, false)); // measured after each move
    const auto tick = [&] {
        world.advance();
        world.tick();
    };
    for (int i = 0; i < 10; ++i)
        tick();
    const std::uint64_t before = world.broadphase.counters().repredictions;
    world.broadphase.set_role(id, Role::fixed_environment);
    for (int i = 0; i < 10; ++i)
        tick();
    EXPECT_EQ(world.broadphase.counters().repredictions, before + 1);
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
    EXPECT_LE(gas.world.broadphase.counters().sweeps, 3u) << "until it is known how far velocities carry";
    EXPECT_EQ(gas.world.violated_invariant(), "");
}

// Without ticks, only queries can show the space that time passes.
TEST(Tick, PredictsWhatIsOnlyAskedAbout)
{
    CalmGas gas(500);
    std::uint64_t before = 0;
    for (int question = 0; question < 400; ++question)
    {
        if (question == 200)
            before = gas.predictions();
        gas.move();
        gas.world.broadphase.catch_up(gas.world);
    }
    EXPECT_LT(static_cast<double>(gas.predictions() - before) / 200 / gas.objects(), 1.0 / 20);
    EXPECT_GT(gas.world.broadphase.now(), 300u);
}

// Objects that were predicted together must not leave their envelopes together: haptics depends on the slowest tick.
TEST(Tick, SpreadsThePredictions)
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

class Teleports : public testing::TestWithParam<std::size_t>
{
protected:
    Teleports() : gas(GetParam())
    {
        gas.run(50);
        for (int tick = 0; tick < 10; ++tick)
            teleport();
    }

    void teleport()
    {
        gas.scatter();
        ASSERT_EQ(sorted_pairs(gas.world.tick()), gas.world.overlapping());
    }

    CalmGas gas;
};

INSTANTIATE_TEST_SUITE_P(OfObjects, Teleports, testing::Values(60, 300), testing::PrintToStringParamName());

TEST_P(Teleports, AreForgottenWhenCalmReturns)
{
    for (int tick = 0; tick < 500; ++tick)
    {
        const Pairs reported = sorted_pairs(gas.tick());
        ASSERT_EQ(reported, gas.world.overlapping()) << "tick " << tick;
    }
    const std::uint64_t before = gas.predictions();
    gas.run(500);
    EXPECT_LT(static_cast<double>(gas.predictions() - before) / 500 / gas.objects(), 1.0 / 20);
    EXPECT_EQ(gas.world.violated_invariant(), "");
}

TEST_P(Teleports, MayEndInStillness)
{
    const Pairs pairs = sorted_pairs(gas.world.report());
    for (int tick = 0; tick < 100; ++tick)
    {
        gas.world.broadphase.tick(gas.world);
        ASSERT_EQ(sorted_pairs(gas.world.report()), pairs);
    }
}

TEST_P(Teleports, LetObjectsComeAndGo)
{
    Random random(7);
    for (ProxyId tick = 0; tick < 200; ++tick)
    {
        gas.world.remove(tick % static_cast<ProxyId>(GetParam()));
        gas.world.broadphase.find_new_pairs(gas.world);
        ASSERT_EQ(sorted_pairs(gas.world.report()), gas.world.overlapping()) << "tick " << tick;
        gas.world.add(ball(random.vector(2), 0.3, {0, 0, 0}));
        gas.world.broadphase.find_new_pairs(gas.world);
        ASSERT_EQ(sorted_pairs(gas.world.report()), gas.world.overlapping()) << "tick " << tick;
        gas.scatter();
        ASSERT_EQ(sorted_pairs(gas.world.tick()), gas.world.overlapping()) << "tick " << tick;
    }
}

TEST_P(Teleports, LetTheProximityTestChange)
{
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

TEST_P(Teleports, LetRolesBeSet)
{
    for (int tick = 0; tick < 300; ++tick)
    {
        gas.world.broadphase.set_role(static_cast<ProxyId>(tick) % static_cast<ProxyId>(GetParam()),
                                      Role::fixed_interactive);
        const Pairs reported = sorted_pairs(gas.tick());
        ASSERT_EQ(reported, gas.world.overlapping()) << "tick " << tick;
    }
    EXPECT_EQ(gas.world.violated_invariant(), "");
}
} // namespace
} // namespace ode_predictive_space
