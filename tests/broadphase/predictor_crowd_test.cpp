#include "ode_predictive_space/broadphase/predict/predictor.h"

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
constexpr double ball_radius = 0.1;

TEST(Predictor, TheReachShrinksWhereNeighboursAreTestedInVainAndGrowsWhereThereAreNone)
{
    World world;
    for (int i = 0; i < 64; ++i)
        world.add(ball(0.22 * Vector3(i % 4, i / 4 % 4, i / 16), ball_radius, {0.001, 0, 0}));
    const auto mean_reach_after = [&](int ticks) {
        for (int i = 0; i < ticks; ++i)
        {
            world.advance();
            EXPECT_TRUE(world.tick().empty());
        }
        double sum = 0;
        for (const ProxyRecord &record : world.broadphase.proxies().records)
            sum += record.reach;
        return sum / 64;
    };
    const double at_first = mean_reach_after(1);
    EXPECT_LT(mean_reach_after(1000), 0.5 * at_first);
    for (ProxyId id : world.members())
        world.place(id, 50 * world.object(id).centre);
    EXPECT_GT(mean_reach_after(1000), at_first);
}

class Flock
{
public:
    Flock(double variation, double falling) : variation_(variation)
    {
        for (int i = 0; i < 400; ++i)
        {
            world.add(ball(random_.vector(3), ball_radius, random_.vector(0.003)));
            falls_.push_back(random_.chance(falling));
        }
    }

    std::uint64_t predictions_of(int ticks)
    {
        const std::uint64_t before = world.broadphase.counters().repredictions;
        for (int i = 0; i < ticks; ++i)
            tick();
        return world.broadphase.counters().repredictions - before;
    }

    World world;

private:
    void tick()
    {
        const double seconds = World::step * (1 + random_.uniform(-variation_, variation_));
        for (ProxyId id : world.members())
        {
            Object &object = world.object(id);
            if (falls_[id])
                object.velocity->z() -= 9.81 * seconds;
            world.place(id, object.centre + seconds * *object.velocity);
        }
        ASSERT_EQ(sorted_pairs(world.tick()), world.overlapping());
        ASSERT_EQ(world.violated_invariant(), "");
    }

    double variation_;
    Random random_{3};
    std::vector<bool> falls_;
};

TEST(Predictor, StepsOfAnyLengthBreakNoPredictions)
{
    for (double falling : {0.0, 0.2})
    {
        const std::uint64_t fixed = Flock(0, falling).predictions_of(200);
        const std::uint64_t varying = Flock(0.8, falling).predictions_of(200);
        EXPECT_LE(varying, 1.25 * static_cast<double>(fixed)) << falling;
        EXPECT_LT(fixed, 400u * 200 / 20) << "predictions last";
    }
}

TEST(Predictor, WhatFallsIsPredictedAlmostAsSeldomAsWhatFlies)
{
    EXPECT_LE(Flock(0, 1).predictions_of(200), 2 * Flock(0, 0).predictions_of(200));
}
class Cloud
{
public:
    Cloud()
    {
        Random random(7);
        for (ProxyId i = 0; i < objects; ++i)
            world.add(ball(random.vector(20), ball_radius, random.vector(0.001)));
    }

    void fly(int ticks)
    {
        for (int i = 0; i < ticks; ++i)
        {
            world.advance();
            world.tick();
            ASSERT_EQ(world.violated_invariant(), "") << i;
        }
    }

    std::uint64_t predictions_in(int ticks)
    {
        const std::uint64_t before = world.broadphase.counters().repredictions;
        fly(ticks);
        return world.broadphase.counters().repredictions - before;
    }

    static constexpr ProxyId objects = 200;
    World world;
};

// The velocities hold from the first tick on, but the step size has to be guessed.
TEST(Predictor, FewObjectsLeaveTheirFirstEnvelopesAtOnce)
{
    Cloud cloud;
    EXPECT_EQ(cloud.predictions_in(1), Cloud::objects);
    EXPECT_EQ(cloud.predictions_in(5), 0u);
}

TEST(Predictor, ASceneThatGetsAnotherOriginGoesOnAsBefore)
{
    Cloud cloud;
    cloud.fly(300);
    const std::uint64_t usual = cloud.predictions_in(5);
    for (ProxyId id = 0; id < Cloud::objects; ++id)
        cloud.world.place(id, cloud.world.object(id).centre + Vector3(1000, 0, 0));
    EXPECT_GE(cloud.predictions_in(1), Cloud::objects);
    EXPECT_LE(cloud.predictions_in(5), usual + Cloud::objects / 10);
}

// A step of seconds would explain a leap along the velocity.
TEST(Predictor, LeapsDoNotTellHowLongAStepIs)
{
    Cloud cloud;
    for (int tick = 0; tick < 40; ++tick)
    {
        for (ProxyId id = tick % 10; id < Cloud::objects; id += 10)
        {
            const Object &object = cloud.world.object(id);
            cloud.world.place(id, object.centre + 10 * object.velocity->normalized());
        }
        cloud.fly(1);
    }
    for (ProxyId id : cloud.world.members())
    {
        const FloatBox envelope = cloud.world.broadphase.proxies().places[id].envelope();
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_LT(envelope.high[axis] - envelope.low[axis], 5 * ball_radius) << id;
    }
}

// An envelope that leaps with the object would still be that of the old role.
TEST(Predictor, AnObjectThatLeapsAndGetsAnotherRoleIsPredictedByThat)
{
    Cloud cloud;
    PredictionSettings settings;
    settings.deviation[1] = Deviation{5, 0, 0};
    cloud.world.broadphase.set_settings(settings);
    cloud.fly(300);
    cloud.world.broadphase.set_role(0, Role::fixed_interactive);
    cloud.world.place(0, {0, 100, 0});
    cloud.fly(1);
    const FloatBox envelope = cloud.world.broadphase.proxies().places[0].envelope();
    EXPECT_GE(envelope.high[1], 105);
}

// The envelope does not allow for this turn.
TEST(Predictor, AnObjectThatLeapsAndHasTurnedGetsAnotherEnvelope)
{
    Cloud cloud;
    const ProxyId plank = cloud.world.add(box({0, 50, 0}, {5, 0.1, 0.1}, {0.001, 0, 0}, true));
    cloud.world.object(plank).radius = std::numeric_limits<double>::infinity();
    cloud.fly(100);
    cloud.world.turn(plank, {0, 0, 1}, 1.5);
    cloud.world.place(plank, {0, 200, 0});
    cloud.fly(1);
}
} // namespace
} // namespace ode_predictive_space
