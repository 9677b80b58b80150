// Update numbers are used again after some time. Neither a number nor its reuse may be visible from outside.

#include <cfenv>

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/shape/convex_shape.h"
#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
constexpr UpdateNumber count_of_numbers = Place::last_update + 1;

// One object moves in each update, so that each is a tick.
class UpdateNumberTest : public testing::Test
{
protected:
    UpdateNumberTest() { mover = world.add(ball({0, 0, 100}, 0.1, {0.0001, 0, 0})); }

    void tick()
    {
        world.advance();
        ASSERT_EQ(sorted_pairs(world.tick()), sorted_pairs(world.overlapping()));
        ++collisions;
        ASSERT_EQ(world.violated_invariant(), "");
    }

    void run(int ticks)
    {
        for (int i = 0; i < ticks; ++i)
            tick();
    }

    bool is_still(ProxyId id) { return world.broadphase.forecast(world, id, collisions).still(); }

    // Skips numbers, as if nothing had moved for many updates.
    void pass(UpdateNumber next)
    {
        world.broadphase.number_updates_from(next & Place::last_update);
        run(3);
    }

    World world;
    ProxyId mover;
    std::uint64_t collisions = 0;
};

// The next move of the object has the number of its last one.
TEST_F(UpdateNumberTest, AMoveCountsAndTimePassesWhateverItsNumber)
{
    const ProxyId seldom = world.add(ball({0, 0, 0}, 0.1, {0, 0, 0}));
    tick();
    for (bool asked : {false, true})
        for (UpdateNumber number = 4; number < 12; ++number)
        {
            world.broadphase.number_updates_from(number);
            world.place(seldom, world.object(seldom).centre + Vector3(1e-5, 0, 0));
            tick();
            world.broadphase.number_updates_from(Place::last_update);
            world.advance();
            if (asked)
                world.broadphase.find_new_pairs(world);
            world.tick();
            run(3);
            const Tick now = world.broadphase.now();
            const std::uint64_t moved = world.broadphase.counters().moved;
            world.broadphase.number_updates_from(number);
            world.place(seldom, world.object(seldom).centre + Vector3(1e-5, 0, 0));
            world.tick();
            ASSERT_EQ(world.broadphase.now(), now + 1) << number;
            ASSERT_EQ(world.broadphase.counters().moved, moved + 1) << number;
            ASSERT_FALSE(is_still(seldom)) << number;
        }
}

TEST_F(UpdateNumberTest, WhatStandsStillIsForeseenToStandStillHoweverLong)
{
    const ProxyId stopped = world.add(box({0, 0, 0}, Vector3::Constant(0.1), {0, 0, 0}, false));
    for (int i = 0; i < 20; ++i)
    {
        world.place(stopped, world.object(stopped).centre + Vector3(0.01, 0, 0));
        tick();
    }
    EXPECT_FALSE(is_still(stopped));
    run(20);
    EXPECT_TRUE(is_still(stopped));
    constexpr UpdateNumber part = count_of_numbers / 16;
    for (UpdateNumber next = part; next <= count_of_numbers; next += part)
    {
        pass(next - 2);
        is_still(stopped); // it may have to be followed again from here on
        run(20);
        ASSERT_TRUE(is_still(stopped)) << next;
    }
}

TEST_F(UpdateNumberTest, PairsThatStandStillComeToRestHoweverLong)
{
    for (int i = 0; i < 4; ++i)
        world.add(box({0.19 * i, 0, 0}, Vector3::Constant(0.1), {0, 0, 0}, true));
    constexpr UpdateNumber part = count_of_numbers / 16;
    for (UpdateNumber next = part; next <= count_of_numbers; next += part)
    {
        pass(next - 2);
        const ProxyId pushed = 1;
        world.place(pushed, world.object(pushed).centre + Vector3(0, next % 3 ? 1e-5 : -1e-5, 0));
        run(100);
        ASSERT_EQ(world.tested_pairs(), 0u) << next;
    }
}

// Vector comparisons carry the number in their fourth lane.
TEST_F(UpdateNumberTest, TicksAreExactAndInvalidOperationsNoneWhateverTheNumber)
{
    Random random(1);
    for (int i = 0; i < 40; ++i)
    {
        world.add(ball(random.vector(0.5), random.uniform(0.05, 0.2), random.vector(0.002)));
        world.add(box(random.vector(0.5), Vector3::Constant(random.uniform(0.05, 0.2)), random.vector(0.002), i % 2));
        world.add(block(random.vector(0.5), Vector3::Constant(random.uniform(0.05, 0.2)), random.vector(0.002), i % 2));
    }
    run(3);
    std::feclearexcept(FE_ALL_EXCEPT);
    for (UpdateNumber next : {0x1fc0001u, 0x1ffffffu, 0x2000000u, 0x2ffffffu, 0x3c00000u, 0x3f80001u, 0x3fc0000u,
                              Place::last_update, 0u, 0x0800000u, 0x1000000u})
    {
        pass(next - 2);
        run(3);
        ASSERT_EQ(std::fetestexcept(FE_INVALID | FE_DIVBYZERO), 0) << next;
    }
}

class WorldOfBalls : public World
{
public:
    void follow(const ProxyId *ids, std::size_t count, ConvexShape *const *shapes, double *moves) override
    {
        for (std::size_t i = 0; i < count; ++i)
        {
            ConvexShape &shape = *shapes[i];
            const ConvexShape before = shape;
            const Object &ball = object(ids[i]);
            shape.centre = ball.centre;
            shape.axes = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
            shape.kind = ShapeKind::rounded;
            shape.radius = ball.radius;
            shape.size = 2 * ball.radius;
            shape.group = shape.partners = 1;
            moves[i] = before.known() ? shape.moved_from(before) : std::numeric_limits<double>::infinity();
        }
    }
};

// Two balls whose bounding boxes overlap, and whose shapes decide.
class UpdateNumberByShape : public testing::Test
{
protected:
    UpdateNumberByShape()
    {
        world.broadphase.set_proximity_test(ProximityTest::shape);
        world.add(ball({0, 0, 100}, 0.1, {0.0001, 0, 0}));
        world.add(ball({0, 0, 0}, 0.1, {0, 0, 0}));
        other = world.add(ball(apart, 0.1, {0, 0, 0}));
        world.broadphase.set_role(other, Role::fixed_interactive);
    }

    Pairs tick()
    {
        world.advance();
        return sorted_pairs(world.tick());
    }

    const Pairs none, both = {{1, 2}};
    const Vector3 apart = Vector3(0.19, 0.19, 0), together = Vector3(0.14, 0.14, 0);
    WorldOfBalls world;
    ProxyId other;
};

TEST_F(UpdateNumberByShape, ShapesAreFollowedWhateverTheNumberOfTheirMove)
{
    for (int ticks_between : {1, 200})
        for (UpdateNumber number = 4; number < 8; ++number)
        {
            world.place(other, apart);
            tick();
            world.broadphase.number_updates_from(number);
            world.place(other, apart + Vector3(1e-6, 0, 0));
            for (int i = 0; i < ticks_between; ++i)
                ASSERT_EQ(tick(), none);
            world.broadphase.number_updates_from(Place::last_update);
            for (int i = 0; i < 3; ++i)
                ASSERT_EQ(tick(), none);
            world.broadphase.number_updates_from(number);
            world.place(other, together);
            ASSERT_EQ(tick(), both) << number;
        }
}

// No report lies between the two updates of the same number, because the program asks for nothing but forecasts in between.
TEST_F(UpdateNumberByShape, ShapesAreMeasuredAnewWhenNumbersStartAgain)
{
    constexpr UpdateNumber half = count_of_numbers / 2;
    for (UpdateNumber number : {UpdateNumber{0}, half})
    {
        world.broadphase.number_updates_from(number);
        world.place(other, apart);
        ASSERT_EQ(tick(), none) << number;
        world.broadphase.number_updates_from(number);
        world.place(other, together);
        ASSERT_EQ(tick(), both) << number;
    }
}
} // namespace
} // namespace ode_predictive_space
