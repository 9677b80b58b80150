// Reports of moves, and reports that count as none.

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
enum class Watched
{
    alone,        ///< watched by its centre
    near_another, ///< watched by its bounding box
};

class ReportOfAMove : public testing::TestWithParam<Watched>
{
protected:
    ProxyId add(const Object &object)
    {
        const ProxyId id = world.add(object);
        if (GetParam() == Watched::near_another)
            world.add(object);
        for (int tick = 0; tick < 3; ++tick)
        {
            world.tick();
            world.advance();
        }
        world.tick();
        return id;
    }

    // Whether the report is enough without a closer check.
    bool settles(ProxyId id)
    {
        return world.broadphase.notify_at_once(id, Noticed(world.object(id))) == Followed::moved;
    }

    // As above, for a report before a tick that is checked.
    bool counts_in_tick(ProxyId id)
    {
        const std::uint64_t before = world.broadphase.counters().moved;
        const bool result = world.touch(id);
        EXPECT_EQ(sorted_pairs(world.tick()), world.overlapping());
        EXPECT_EQ(world.violated_invariant(), "");
        EXPECT_EQ(world.broadphase.counters().moved - before, result ? 1u : 0u);
        return result;
    }

    static std::vector<Object> solids()
    {
        return {ball({0, 0, 0}, 0.1, {0.0005, 0, 0}), capsule({0, 0, 0}, 0.1, 0.2, {0.0005, 0, 0}),
                box({0, 0, 0}, {0.1, 0.2, 0.3}, {0.0005, 0, 0}, true)};
    }

    World world;
};

std::string name_of_watch(const testing::TestParamInfo<Watched> &info)
{
    return info.param == Watched::alone ? "alone" : "near_another";
}

INSTANTIATE_TEST_SUITE_P(Watched, ReportOfAMove, testing::Values(Watched::alone, Watched::near_another), name_of_watch);

TEST_P(ReportOfAMove, IsEnoughWhileTheObjectIsInItsEnvelope)
{
    for (const Object &solid : solids())
    {
        const ProxyId id = add(solid);
        const Watch watch = world.broadphase.proxies().places[id].watch();
        EXPECT_EQ(watch, GetParam() == Watched::alone ? Watch::centre : solid.formula);
        world.object(id).centre.x() += 0.0005;
        EXPECT_TRUE(settles(id));
        world.object(id).centre.x() += 100;
        EXPECT_EQ(settles(id), GetParam() == Watched::near_another) << "where it is known, so is how to go on";
        world.object(id).centre.x() = nan;
        EXPECT_FALSE(settles(id));
        for (ProxyId member : world.members())
            world.remove(member);
    }
}

TEST_P(ReportOfAMove, IsNotEnoughWithoutAPoseOrAFormula)
{
    for (Object object : solids())
    {
        object.has_pose = false;
        const ProxyId id = add(object);
        world.object(id).centre.x() += 0.0005;
        EXPECT_FALSE(settles(id)) << "the position has to be computed first";
    }
}

TEST_P(ReportOfAMove, IsNoneWhenNothingHasChanged)
{
    for (const Object &solid : solids())
    {
        const ProxyId id = add(solid);
        for (int i = 0; i < 3; ++i)
            EXPECT_FALSE(counts_in_tick(id));
        world.object(id).centre.x() += 0.0005;
        EXPECT_TRUE(counts_in_tick(id));
        for (int i = 0; i < 3; ++i)
            EXPECT_FALSE(counts_in_tick(id));
    }
}

// Each change is reported; the second report has the pose of the first.
TEST_P(ReportOfAMove, CountsWhenTheSizeHasChangedAndThePoseHasNot)
{
    for (const Object &solid : solids())
        for (double factor : {1.5, 1.0001})
            for (double way : {0.0005, 100.0})
            {
                const ProxyId id = add(solid);
                world.object(id).centre.x() += way;
                EXPECT_TRUE(world.touch(id));
                world.object(id).half *= factor;
                world.object(id).radius *= factor;
                EXPECT_TRUE(counts_in_tick(id));
                EXPECT_FALSE(counts_in_tick(id));
            }
}

TEST_P(ReportOfAMove, AnObjectThatGrowsMeetsItsNeighbour)
{
    for (const Object &solid : solids())
    {
        const ProxyId id = add(solid);
        Object other = solid;
        other.centre = {0, 0, 5};
        world.add(other);
        world.tick();
        world.object(id).half *= 100;
        world.object(id).radius *= 100;
        world.touch(id);
        EXPECT_EQ(sorted_pairs(world.tick()), world.overlapping());
        EXPECT_EQ(world.violated_invariant(), "");
    }
}

TEST_P(ReportOfAMove, AMoveThatSinglePrecisionDoesNotTellIsSeenByThePairs)
{
    const ProxyId one = add(box({0, 0, 0}, {0.5, 0.5, 0.5}, {0, 0, 0}, true));
    const ProxyId other = world.add(box({1 + 1e-12, 0, 0}, {0.5, 0.5, 0.5}, {0, 0, 0}, true));
    const auto touches = [&] {
        const Pairs pairs = sorted_pairs(world.tick());
        EXPECT_EQ(pairs, world.overlapping());
        return std::find(pairs.begin(), pairs.end(), std::make_pair(one, other)) != pairs.end();
    };
    EXPECT_FALSE(touches());
    for (int i = 0; i < 100; ++i)
    {
        // Pauses let the pair come to rest.
        world.object(other).centre.x() = i % 2 ? 1 + 1e-12 : 1 - 1e-12;
        EXPECT_EQ(world.touch(other), i % 10 == 1) << "after a rest it is not known how it was";
        EXPECT_EQ(touches(), i % 2 == 0);
        for (int pause = i % 10 == 0 ? 100 : 0; pause > 0; --pause)
            EXPECT_EQ(touches(), i % 2 == 0);
    }
}

// The box turns about its centre, in an envelope that holds it in every orientation.
TEST_P(ReportOfAMove, WhatTurnsMeetsWhatItTurnsTo)
{
    const ProxyId bar = add(box({0, 0, 0}, {1, 0.01, 0.01}, {0, 0, 0}, true));
    const ProxyId above = world.add(ball({0, 0.9, 0}, 0.05, {0, 0, 0}));
    EXPECT_EQ(sorted_pairs(world.tick()), world.overlapping());
    for (int i = 0; i < 100; ++i)
    {
        world.turn(bar, {0, 0, 1}, 0.05 * i);
        const Pairs pairs = sorted_pairs(world.tick());
        ASSERT_EQ(pairs, world.overlapping()) << i;
        ASSERT_EQ(world.violated_invariant(), "");
        if (i == 30)
        {
            EXPECT_TRUE(std::binary_search(pairs.begin(), pairs.end(), std::make_pair(bar, above)));
        }
    }
}
} // namespace
} // namespace ode_predictive_space
