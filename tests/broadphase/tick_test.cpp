#include <cmath>

#include <gtest/gtest.h>

#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
// Balls in uniform motion that bounce off the walls of a cube. Most have no near neighbour.
class CalmGas
{
public:
    explicit CalmGas(std::size_t count) : half_(std::cbrt(0.4 * static_cast<double>(count)))
    {
        for (std::size_t i = 0; i < count; ++i)
            world.add(ball(random_.vector(half_), 0.1, random_.vector(0.001)));
    }

    void move()
    {
        world.advance();
        bounce();
    }

    Pairs tick()
    {
        move();
        return world.tick();
    }

    void run(int ticks)
    {
        for (int i = 0; i < ticks; ++i)
            tick();
    }

    void scatter()
    {
        for (ProxyId id : world.members())
            world.place(id, random_.vector(half_));
    }

    double objects() const { return static_cast<double>(world.members().size()); }
    std::uint64_t predictions() const { return world.broadphase.counters().repredictions; }

    World world;

private:
    void bounce()
    {
        for (ProxyId id : world.members())
            bounce(world.object(id));
    }

    void bounce(Object &object) const
    {
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(object.centre[axis]) > half_ && object.centre[axis] * object.displacement[axis] > 0)
                object.displacement[axis] = -object.displacement[axis];
        object.velocity = object.displacement / World::step;
    }

    Random random_{1};
    double half_;
};
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
        << "a query must not break predictions";
}

TEST(Tick, ASingleMoveBetweenTicksIsNoTick)
{
    CalmGas gas(100);
    gas.world.tick();
    EXPECT_EQ(gas.world.broadphase.counters().violations, 0u) << "new objects have no envelopes that they could leave";
    gas.run(100);
    const Tick before = gas.world.broadphase.now();
    const std::uint64_t violations = gas.world.broadphase.counters().violations;
    gas.world.place(0, {0, 0, 0});
    gas.world.broadphase.find_new_pairs(gas.world);
    EXPECT_EQ(gas.world.broadphase.now(), before);
    EXPECT_EQ(gas.world.broadphase.counters().violations, violations + 1)
        << "the others were not expected to have moved";
    EXPECT_EQ(gas.world.violated_invariant(), "");
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

// Without ticks, only queries can show the space that time passes.
TEST(Tick, PredictsWhatIsOnlyAskedAbout)
{
    CalmGas gas(500);
    std::uint64_t before = 0;
    for (int query = 0; query < 400; ++query)
    {
        if (query == 200)
            before = gas.predictions();
        gas.move();
        gas.world.broadphase.catch_up(gas.world);
    }
    EXPECT_LT(static_cast<double>(gas.predictions() - before) / 200 / gas.objects(), 1.0 / 20);
    EXPECT_EQ(gas.world.broadphase.now(), 392u) << "the first eight in a row are no ticks";
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

TEST(Tick, TeleportsAreForgottenWhenCalmReturns)
{
    CalmGas gas(300);
    gas.run(50);
    for (int tick = 0; tick < 10; ++tick)
    {
        gas.scatter();
        ASSERT_EQ(sorted_pairs(gas.world.tick()), gas.world.overlapping());
    }
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
} // namespace
} // namespace ode_predictive_space
