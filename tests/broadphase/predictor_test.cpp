#include "ode_predictive_space/broadphase/predict/predictor.h"

#include <cmath>
#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
constexpr double step = World::step;
constexpr double radius = 0.1;

class Lone
{
public:
    explicit Lone(const Object &object)
    {
        world.add(object);
        for (int i = 0; i < others; ++i)
            world.add(ball({-1000, -1000, 1.0 * i}, radius, {0, 0, 0}));
        world.tick();
        begun_ = world.broadphase.counters().repredictions;
        forecast(); // starts the sampling of its motion
    }

    void tick()
    {
        world.touch(0);
        world.tick();
        ASSERT_EQ(world.violated_invariant(), "");
    }

    // Moves it as ODE moves a body: with the velocity at the end of the step, which is length() times as long as usual.
    void fly(
        int ticks, const Vector3 &gravity = Vector3::Zero(), const std::function<double()> &length = [] { return 1; })
    {
        for (int i = 0; i < ticks; ++i)
        {
            Object &ball = object();
            const double seconds = length() * step;
            *ball.velocity += seconds * gravity;
            ball.centre += seconds * *ball.velocity;
            ASSERT_NO_FATAL_FAILURE(tick()) << i;
        }
    }

    Object &object() { return world.object(0); }
    const ProxyRecord &record() const { return world.broadphase.proxies().records[0]; }
    FloatBox envelope() const { return world.broadphase.proxies().places[0].envelope(); }
    std::uint64_t predictions() const { return world.broadphase.counters().repredictions - begun_; }
    Forecast forecast()
    {
        world.broadphase.catch_up(world);
        return world.broadphase.forecast(world, 0, 0);
    }

    World world;

private:
    static constexpr int others = 16;
    std::uint64_t begun_ = 0; // predictions before its first move
};

Object moving_ball(const Vector3 &velocity)
{
    return ball({0, 0, 0}, radius, step * velocity);
}

Object alone(const Vector3 &centre)
{
    Object object = ball(centre, radius, {0, 0, 0});
    object.velocity.reset();
    return object;
}

// An extrapolated leap would be an envelope across the room, which meets everything.
TEST(Predictor, ALeapIsNotExtrapolated)
{
    Lone lone(alone({0, 0, 0}));
    for (int tick = 1; tick < 20; ++tick)
    {
        lone.object().centre = Vector3::Constant(10 * (tick * 7 % 20));
        lone.tick();
        const FloatBox box = lone.envelope();
        for (int axis = 0; axis < 3; ++axis)
            ASSERT_LT(box.high[axis] - box.low[axis], 0.25) << "tick " << tick;
    }
}

// The path would be many sizes long, and used up at the next tick.
TEST(Predictor, WhatGoesFartherInATickThanAnEnvelopeReachesIsNotExtrapolated)
{
    for (const Object &object : {moving_ball({2000, 0, 0}), alone({0, 0, 0})})
    {
        Lone lone(object);
        for (int tick = 1; tick < 40; ++tick)
        {
            lone.object().centre += Vector3(2000 * step, 0, 0);
            lone.tick();
            const FloatBox box = lone.envelope();
            ASSERT_LT(box.high[0] - box.low[0], 0.25) << "tick " << tick;
        }
    }
}

TEST(Predictor, JitterEndsInSlack)
{
    Random random(1);
    Lone lone(moving_ball({0, 0, 0}));
    const auto jitter = [&](int ticks) {
        for (int tick = 0; tick < ticks; ++tick)
        {
            lone.object().centre = random.vector(1e-4 * radius);
            lone.object().velocity = random.vector(0.01 * radius);
            lone.tick();
        }
    };
    jitter(500);
    const std::uint64_t before = lone.predictions();
    jitter(5000);
    EXPECT_EQ(lone.predictions(), before);
}

TEST(Predictor, AVelocityThatExplainsNothingIsNotTrusted)
{
    Lone lone(moving_ball({-3, 0, 0}));
    const auto run = [&](int ticks) {
        for (int tick = 0; tick < ticks; ++tick)
        {
            lone.object().centre += Vector3(0, 0.0005, 0);
            lone.tick();
        }
    };
    run(300);
    const std::uint64_t before = lone.predictions();
    run(2000);
    EXPECT_LT(lone.predictions() - before, 2000u / 50);
}

Vector3 hand(Random &random, int tick, Vector3 &from, Vector3 &to)
{
    constexpr int reach = 700;
    if (tick % reach == 0)
    {
        from = to;
        to = random.vector(0.3);
    }
    const double s = static_cast<double>(tick % reach) / reach;
    const double progress = s * s * s * (10 - 15 * s + 6 * s * s);
    return from + progress * (to - from) + Vector3::Constant(5e-5 * std::sin(0.06 * tick));
}

TEST(Predictor, AHandIsRecognisedAndPredictedFromItsPositions)
{
    Random random(2);
    Object object = alone({0, 0, 0});
    object.half = Vector3::Constant(0.02);
    object.radius = 0.02;
    Lone lone(object);
    Vector3 from = Vector3::Zero(), to = Vector3::Zero();
    constexpr int ticks = 20000;
    for (int tick = 0; tick < ticks; ++tick)
    {
        lone.object().centre = hand(random, tick, from, to);
        ASSERT_NO_FATAL_FAILURE(lone.tick());
        if (tick % 10 == 0)
            lone.forecast();
    }
    EXPECT_EQ(lone.record().role, Role::interactive);
    EXPECT_LT(lone.predictions(), ticks / 10u);
    const Vector3 before = lone.object().centre;
    const Forecast forecast = lone.forecast();
    for (int tick = ticks; tick < ticks + 10; ++tick)
    {
        lone.object().centre = hand(random, tick, from, to);
        lone.tick();
    }
    const Vector3 expected = forecast.envelope.path.at(10), seen = lone.object().centre;
    EXPECT_LT((expected - seen).norm(), 0.1 * (seen - before).norm());
}

// Jitter bends the path through the last three positions.
TEST(Predictor, AHandOfWhichTheProgramTellsIsPredictedFromAllOfItsLastPositions)
{
    Lone lone(alone({0, 0, 0}));
    lone.world.broadphase.set_role(0, Role::fixed_interactive);
    constexpr double jitter = 1e-5;
    for (int tick = 1; tick <= 30; ++tick)
    {
        lone.object().centre = Vector3(0.001 * tick, tick % 2 ? jitter : -jitter, 0);
        lone.tick();
    }
    const Forecast forecast = lone.forecast();
    EXPECT_TRUE(forecast.known());
    EXPECT_LT(std::abs(forecast.envelope.path.at(10).y()), 10 * jitter);
}

TEST(Predictor, AFixedDeviationIsThatOfTheRole)
{
    PredictionSettings settings;
    settings.deviation[0] = Deviation{0.5, 0, 0};
    settings.deviation[1] = Deviation{0.0625, 0, 0};
    for (Role role : {Role::fixed_environment, Role::fixed_interactive})
    {
        const double expected = settings.deviation[is_interactive(role) ? 1 : 0]->a;
        Lone lone(moving_ball({0.5, 0, 0}));
        lone.world.broadphase.set_settings(settings);
        lone.world.broadphase.set_role(0, role);
        lone.fly(50);
        lone.world.broadphase.set_role(0, role); // forces a new prediction
        lone.world.broadphase.catch_up(lone.world);
        const double y = lone.object().centre.y();
        EXPECT_NEAR(lone.envelope().high[1], y + radius + expected, 1e-4);
        EXPECT_NEAR(lone.envelope().low[1], y - radius - expected, 1e-4);
        EXPECT_EQ(lone.forecast().envelope.deviation.a, expected);
        PredictionSettings wide;
        wide.deviation = {Deviation{2, 0, 0}, Deviation{2, 0, 0}};
        lone.world.broadphase.set_settings(wide);
        lone.world.broadphase.catch_up(lone.world);
        EXPECT_NEAR(lone.envelope().high[1], y + radius + 2, 1e-4) << "new settings make new envelopes";
    }
}

TEST(Predictor, ObjectsThatWereAddedTogetherDoNotLeaveTheirEnvelopesTogether)
{
    World world;
    for (int i = 0; i < 100; ++i)
        world.add(ball({1.0 * i, 0, 0}, radius, {0, 0.001, 0}));
    world.tick();
    std::set<float> reaches;
    for (const ProxyRecord &record : world.broadphase.proxies().records)
        reaches.insert(record.reach);
    EXPECT_GT(reaches.size(), 90u);
}

TEST(Predictor, AnEnvelopeHoldsItsObjectWhenItIsMade)
{
    Random random(4);
    for (int i = 0; i < 30000; ++i)
    {
        const double far = std::pow(10, random.uniform(-6, 12)), size = std::pow(10, random.uniform(-6, 6));
        const double exact = std::exp2(static_cast<double>(random.index(20)) - 10);
        const Vector3 centre = random.vector(far),
                      half = i % 4 == 1 ? Vector3::Constant(exact).eval() : random.vector(size).cwiseAbs().eval();
        const Vector3 velocity = random.vector(far);
        Lone lone(i % 5 == 0   ? ball(centre, size, step * velocity)
                  : i % 5 == 1 ? capsule(centre, half.x(), half.z(), step * velocity)
                  : i % 5 == 2 ? box(centre, half, step * velocity, random.chance(0.5))
                               : block(centre, half, step * velocity, random.chance(0.5)));
        for (int tick = 0; tick < 3; ++tick)
        {
            lone.object().centre += random.vector(random.chance(0.5) ? far : size);
            ASSERT_NO_FATAL_FAILURE(lone.tick()) << i;
            if (random.chance(0.5))
                lone.world.turn(0, random.vector(1) + Vector3(2, 0, 0), random.uniform(-3, 3));
            lone.world.broadphase.set_role(0, Role::fixed_environment);
            lone.world.broadphase.find_new_pairs(lone.world);
            ASSERT_EQ(lone.world.violated_invariant(), "") << i;
        }
    }
}

float farthest_side(const World &world)
{
    float farthest = 0;
    for (ProxyId id : world.members())
    {
        const FloatBox tight = FloatBox::around(bounds_of(world.object(id)));
        for (int axis = 0; axis < 3; ++axis)
            farthest = std::max({farthest, std::abs(tight.low[axis]), std::abs(tight.high[axis])});
    }
    return farthest;
}

// Adds so many objects that a tick reviews only a few of them.
void add_row(World &world)
{
    for (int i = 0; i < 300; ++i)
        world.add(ball({0.5 * i, 0, 0}, radius, {0, 0, 0}));
}

TEST(Predictor, TheFarthestPlaceIsThatOfAnObjectThatLeapsAndLeaps)
{
    World world;
    add_row(world);
    const ProxyId visitor = world.add(ball({0, 3, 0}, radius, {0, 0, 0}));
    for (double height = 10; height < 1e9; height *= 2)
    {
        world.place(visitor, {0, height, 0});
        world.tick();
        ASSERT_GE(world.broadphase.farthest(), farthest_side(world));
    }
}

TEST(Predictor, TheFarthestPlaceMayBeInAnEnvelopeWithoutEnd)
{
    World world;
    PredictionSettings settings;
    settings.deviation[0] = Deviation{1e39, 0, 0};
    world.broadphase.set_settings(settings);
    add_row(world);
    const ProxyId far = world.add(ball({1e6, 0, 0}, radius, {0.01, 0, 0}));
    world.tick();
    EXPECT_FALSE(world.broadphase.proxies().places[far].has_end());
    EXPECT_GE(world.broadphase.farthest(), farthest_side(world));
    world.place(far, {1e7, 0, 0});
    world.broadphase.note_disabled(far); // gives it another envelope
    world.tick();
    EXPECT_GE(world.broadphase.farthest(), farthest_side(world)) << "before it is reviewed";
}

// A distant object makes the comparisons of all others less certain. This must end when it is back or removed.
TEST(Predictor, TheFarthestPlaceFollowsTheObjectsThatAreThere)
{
    for (const bool is_removed : {false, true})
    {
        World world;
        add_row(world);
        const ProxyId visitor = world.add(ball({0, 3, 0}, radius, {0, 0, 0}));
        world.tick();
        world.place(visitor, {1e9, 0, 0});
        world.tick();
        EXPECT_GE(world.broadphase.farthest(), 1e9f);
        if (is_removed)
            world.remove(visitor);
        else
            world.place(visitor, {0, 3, 0});
        for (int tick = 0; tick < 100; ++tick)
        {
            world.place(static_cast<ProxyId>(tick), {0.5 * tick, tick % 2 ? 0.01 : 0, 0});
            world.tick();
            ASSERT_GE(world.broadphase.farthest(), farthest_side(world)) << tick;
        }
        EXPECT_LE(world.broadphase.farthest(), 2 * farthest_side(world));
        world.place(0, {-1e6, 0, 0});
        world.tick();
        EXPECT_GE(world.broadphase.farthest(), 1e6f);
        for (int tick = 0; tick < 200; ++tick)
        {
            world.place(1, {0.5, tick % 2 ? 0.01 : 0, 0});
            world.tick();
            ASSERT_GE(world.broadphase.farthest(), 1e6f) << "it is still there, and does not move";
        }
    }
}
} // namespace
} // namespace ode_predictive_space
