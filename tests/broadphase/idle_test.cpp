// Idle objects: disabled objects are in no reported pair, so their pairs are neither searched nor kept.

#include "ode_predictive_space/broadphase/objects/idle_objects.h"

#include <gtest/gtest.h>

#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
class CountingWorld : public World
{
public:
    void measure(const ProxyId *ids, std::size_t count, Place *places, const Origin &origin) override
    {
        measured += count;
        World::measure(ids, count, places, origin);
    }
    void observe(const ProxyId *ids, std::size_t count, Observation *seen, const Origin &origin) override
    {
        observed += count;
        World::observe(ids, count, seen, origin);
    }
    Box bounds(ProxyId id) override
    {
        ++measured;
        return World::bounds(id);
    }
    bool overlap(ProxyId first, ProxyId second) override
    {
        ++compared;
        return World::overlap(first, second);
    }
    void find_disabled(const ProxyId *ids, std::size_t count, std::vector<ProxyId> &disabled) override
    {
        polled += count;
        World::find_disabled(ids, count, disabled);
    }

    void reset_counts() { measured = observed = compared = polled = 0; }

    std::size_t measured = 0, observed = 0, compared = 0, polled = 0;
};

// Many disabled spheres in one place, and a few others that move far apart, so that time passes. The envelopes are in a tree
// or, for a small crowd, in a list.
class Idle : public testing::TestWithParam<ProxyId>
{
protected:
    static constexpr ProxyId movers = 4;

    Idle() : crowd(GetParam())
    {
        for (ProxyId id = 0; id < crowd; ++id)
        {
            Object object = ball({1, 2, 3}, 0.1, {0, 0, 0});
            object.enabled = false;
            world.add(object);
        }
        for (int i = 0; i < static_cast<int>(movers); ++i)
            world.add(ball({10.0 * i, 50, 0}, 0.1, {0, 0, 0.001}));
        tick();
    }

    void tick()
    {
        world.advance();
        ASSERT_EQ(sorted_pairs(world.tick()), world.overlapping());
    }

    void set_enabled(ProxyId begin, ProxyId end, bool enabled)
    {
        for (ProxyId id = begin; id < end; ++id)
            world.object(id).enabled = enabled;
    }

    void expect_no_pairs()
    {
        EXPECT_EQ(world.broadphase.near_pairs(), 0u);
        EXPECT_EQ(world.tested_pairs(), 0u);
    }

    const ProxyId crowd;
    CountingWorld world;
};

INSTANTIATE_TEST_SUITE_P(Crowds, Idle, testing::Values(100, 3000), testing::PrintToStringParamName());

TEST_P(Idle, ObjectsOnOneSpotFormNoPairs)
{
    for (int ticks = 0; ticks < 40; ++ticks)
    {
        expect_no_pairs();
        world.advance();
        ASSERT_TRUE(world.tick().empty());
    }
    EXPECT_EQ(world.compared, 0u);
    EXPECT_LT(world.broadphase.bytes(), std::size_t{1024} * crowd);
    EXPECT_EQ(world.violated_invariant(), "");
}

TEST_P(Idle, ObjectsArePolledAndNothingElse)
{
    for (int ticks = 0; ticks < 40; ++ticks)
        tick();
    world.reset_counts();
    constexpr std::size_t ticks = 10;
    for (std::size_t i = 0; i < ticks; ++i)
    {
        world.advance();
        world.tick();
    }
    EXPECT_GE(world.polled, ticks * crowd);
    EXPECT_LE(world.polled, ticks * (crowd + movers));
    EXPECT_LE(world.measured + world.observed, 3 * ticks * movers);
    EXPECT_EQ(world.compared, 0u);
}

TEST_P(Idle, ObjectsThatMoveAreVerifiedAndFormNoPairs)
{
    for (int ticks = 0; ticks < 40; ++ticks)
    {
        world.reset_counts();
        for (ProxyId id = 0; id < crowd; ++id)
            world.place(id, world.object(id).centre + Vector3(0.01, 0, 0));
        world.advance();
        ASSERT_TRUE(world.tick().empty());
        expect_no_pairs();
        EXPECT_LE(world.measured + world.observed, 3 * (crowd + movers));
    }
    EXPECT_EQ(world.compared, 0u);
    EXPECT_LT(world.broadphase.bytes(), std::size_t{1024} * crowd);
}

TEST_P(Idle, DisablingDropsThePairs)
{
    set_enabled(0, 30, true);
    tick();
    EXPECT_GE(world.broadphase.near_pairs(), 435u);
    set_enabled(10, 30, false);
    tick(); // the report meets the disabled objects
    tick(); // the first of them are checked
    while (world.broadphase.near_pairs() > 45)
    {
        const std::size_t before = world.broadphase.near_pairs();
        tick();
        ASSERT_LT(world.broadphase.near_pairs(), before);
    }
    EXPECT_EQ(world.violated_invariant(), "");
    set_enabled(0, 10, false);
    for (int ticks = 0; ticks < 3; ++ticks)
        tick();
    expect_no_pairs();
}

TEST(IdleAtRandom, ReportsTheOverlappingPairsOfEnabledObjects)
{
    constexpr std::size_t count = 200;
    std::uint64_t sweeps = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
    {
        Random random(seed);
        World world;
        const auto anywhere = [&] {
            Object object = ball(random.vector(0.5), 0.1, random.chance(0.5) ? random.vector(0.001) : Vector3::Zero());
            object.enabled = random.chance(0.5);
            return object;
        };
        for (std::size_t i = 0; i < count; ++i)
            world.add(anywhere());
        for (int tick = 0; tick < 600; ++tick)
        {
            world.advance();
            const bool all = random.chance(0.02), scattered = tick % 200 > 180;
            for (ProxyId id : world.members())
            {
                if (random.chance(all ? 0.5 : 0.01))
                    world.object(id).enabled = !world.object(id).enabled;
                if (scattered || world.object(id).centre.cwiseAbs().maxCoeff() > 0.6)
                    world.place(id, random.vector(0.5));
            }
            const ProxyId id = static_cast<ProxyId>(random.index(count));
            if (random.chance(0.1) && world.present(id))
            {
                world.remove(id);
                world.add(anywhere());
            }
            if (random.chance(0.1))
                world.broadphase.catch_up(world);
            ASSERT_EQ(sorted_pairs(world.tick()), world.overlapping()) << "seed " << seed << ", tick " << tick;
            ASSERT_EQ(sorted_pairs(world.report()), world.overlapping()) << "seed " << seed << ", again " << tick;
        }
        sweeps += world.broadphase.counters().sweeps;
    }
    EXPECT_GT(sweeps, 100u) << "when all are scattered";
    EXPECT_LT(sweeps, 1200u) << "half of the ticks";
}
} // namespace
} // namespace ode_predictive_space
