#include "ode_predictive_space/broadphase/base/origin.h"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"
#include "tests/broadphase/support/world.h"

namespace ode_predictive_space
{
namespace
{
Vector3 far_place(Random &random)
{
    return random.vector(std::pow(10, random.uniform(0, 9)));
}

Object near_object(Random &random, const Vector3 &origin)
{
    const double size = std::pow(10, random.uniform(-6, 2));
    const Vector3 centre = origin + random.vector(size * std::pow(10, random.uniform(-2, 3)));
    return random.chance(0.5) ? ball(centre, size, {0, 0, 0}) : box(centre, Vector3::Constant(size), {0, 0, 0}, true);
}

bool holds_from(const Vector3 &origin, const FloatBox &outer, const Box &inner)
{
    for (int axis = 0; axis < 3; ++axis)
    {
        const long double place = origin[axis], lost = 1e-18L * std::abs(place);
        if (!(outer.low[axis] <= inner.min()[axis] - place + lost &&
              inner.max()[axis] - place - lost <= outer.high[axis]))
            return false;
    }
    return true;
}

TEST(Origin, ATightBoxHoldsTheBoundingBoxWhereverItIsCountedFrom)
{
    Random random(1);
    for (int i = 0; i < 300000; ++i)
    {
        const Vector3 place = far_place(random);
        const Origin origin(place);
        const Object object = near_object(random, place);
        const Box bounds = bounds_of(object);
        Place measured, given;
        ASSERT_TRUE(measured.measure(solid_of(object), object.centre.data(), object.rotation.data(), origin));
        given.set_tight(origin.around(bounds));
        ASSERT_TRUE(holds_from(place, measured.tight(), bounds)) << i;
        ASSERT_TRUE(holds_from(place, given.tight(), bounds)) << i;
    }
}

TEST(Origin, WhatSeemsToOverlapDoes)
{
    Random random(2);
    int sure = 0, unsure = 0;
    for (int i = 0; i < 300000; ++i)
    {
        const Vector3 place = far_place(random);
        const Origin origin(place);
        const Object one = near_object(random, place);
        Object other = one;
        const double touching = 2 * one.half.x() + place.norm() * random.uniform(-4e-15, 4e-15);
        other.centre.x() += random.chance(0.5) ? touching : -touching;
        Place places[2];
        for (const auto &[object, at] : {std::pair(one, &places[0]), std::pair(other, &places[1])})
            ASSERT_TRUE(at->measure(solid_of(object), object.centre.data(), object.rotation.data(), origin));
        const bool surely = surely_overlap(places[0], places[1], origin.doubt());
        const bool overlap = bounds_of(one).intersects(bounds_of(other));
        ASSERT_FALSE(surely && !overlap) << i;
        ASSERT_FALSE(surely_apart(places[0], places[1]) && overlap) << i;
        sure += surely;
        unsure += !surely;
    }
    EXPECT_GT(sure, 1000);
    EXPECT_GT(unsure, 1000);
}

TEST(Origin, TheWatchOfTheCentreLetsNoObjectPassThatLeavesItsEnvelope)
{
    Random random(3);
    int passed = 0, left = 0;
    for (int i = 0; i < 300000; ++i)
    {
        const Vector3 place = random.vector(1e9);
        const Origin origin(place);
        const double size = std::pow(10, random.uniform(-6, -3));
        Object object = ball(place + random.vector(size), size, {0, 0, 0});
        const float radius = round_up(size);
        const Float4 centre = origin.nearest_of_stored(object.centre.data());
        const TightBox sphere = TightBox::around(centre, Float4::all(radius), origin.doubt());
        const Float4 slack = Float4::all(static_cast<float>(size * random.uniform(0.5, 2)));
        Place watched;
        watched.set_envelope({sphere.low - slack, sphere.high + slack});
        float start[4];
        centre.store(start);
        watched.watch_centre(start, radius, origin.doubt());
        const double out = watched.envelope().high[0] - size;
        object.centre.x() = place.x() + out + std::abs(place.x()) * random.uniform(-2e-15, 2e-15);
        const bool inside = holds_from(place, watched.envelope(), bounds_of(object));
        const bool pass = watched.follow(object.centre.data(), object.rotation.data(), origin) != Followed::left;
        ASSERT_FALSE(pass && !inside) << i;
        passed += pass;
        left += !inside;
    }
    EXPECT_GT(passed, 1000);
    EXPECT_GT(left, 1000);
}

class Swarm
{
public:
    explicit Swarm(const Vector3 &place)
    {
        Random random(4);
        for (int i = 0; i < 300; ++i)
        {
            const Vector3 centre = place + random.vector(3), displacement = random.vector(0.01);
            Object object =
                i % 3 ? ball(centre, 0.1, displacement) : block(centre, {0.1, 0.2, 0.1}, displacement, true);
            if (i % 2)
                object.velocity.reset();
            world.add(object);
            displacements.push_back(displacement);
        }
    }

    void fly(int ticks, const Vector3 &drift = Vector3::Zero())
    {
        for (int tick = 0; tick < ticks; ++tick)
        {
            for (ProxyId id : world.members())
                world.place(id, world.object(id).centre + displacements[id] + drift);
            ASSERT_EQ(sorted_pairs(world.tick()), world.overlapping()) << tick;
            ASSERT_EQ(world.violated_invariant(), "") << tick;
        }
    }

    std::uint64_t predictions() const { return world.broadphase.counters().repredictions; }

    World world;
    std::vector<Vector3> displacements;
};

TEST(Origin, AWorldFarAwayCostsNoMoreThanOneAtTheOrigin)
{
    for (const Vector3 &place : {Vector3(5e6, 0, 0), Vector3(0, -4e5, 6e6), Vector3(1e9, 1e9, 1e9)})
    {
        Swarm near(Vector3::Zero()), far(place);
        near.fly(60);
        far.fly(60);
        EXPECT_LT((far.world.broadphase.origin().place() - place).norm(), 10);
        EXPECT_EQ(near.world.broadphase.origin().place(), Vector3::Zero());
        EXPECT_LE(far.world.broadphase.near_pairs(), 1.2 * static_cast<double>(near.world.broadphase.near_pairs()));
        const std::uint64_t near_before = near.predictions(), far_before = far.predictions();
        near.fly(60);
        far.fly(60);
        EXPECT_LE(far.predictions() - far_before, 1.2 * static_cast<double>(near.predictions() - near_before));
    }
}

TEST(Origin, FollowsObjectsThatAllGoFarAway)
{
    Swarm swarm(Vector3::Zero());
    swarm.fly(20);
    for (int leap = 0; leap < 5; ++leap)
    {
        swarm.fly(1, Vector3(0, 0, 2e6));
        swarm.fly(100);
        EXPECT_NEAR(swarm.world.broadphase.origin().place().z(), 2e6 * (leap + 1), 10);
    }
    swarm.fly(1, Vector3(0, 0, -1e7));
    swarm.fly(100);
    EXPECT_LT(swarm.world.broadphase.origin().place().norm(), 10);
}

// A world has an infinite ground, which must not hold the origin back.
TEST(Origin, WhatHasNoEndDoesNotHoldIt)
{
    Swarm swarm(Vector3(5e6, 0, 0));
    swarm.world.add(floor_below(-5));
    const ProxyId still = swarm.world.add(block({5e6, 0, 4}, Vector3::Constant(0.1), Vector3::Zero(), false));
    swarm.displacements.insert(swarm.displacements.end(), 2, Vector3::Zero());
    swarm.fly(60);
    EXPECT_NEAR(swarm.world.broadphase.origin().place().x(), 5e6, 10);
    EXPECT_EQ(swarm.world.broadphase.proxies().records[still].role, Role::environment) << "only the origin has moved";
}
} // namespace
} // namespace ode_predictive_space
