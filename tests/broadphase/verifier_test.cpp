#include "ode_predictive_space/broadphase/verify/verifier.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/verification.h"

namespace ode_predictive_space
{
namespace
{
TEST(Verifier, TheCentreMayBeAsFarFromThePathAsTheDeviation)
{
    ProxyStore store;
    add_proxy(store, straight, some, 1, 100, 50);
    for (Tick now : {100u, 104u, 150u})
    {
        const double t = now - 100.0;
        for (int axis = 0; axis < 3; ++axis)
            for (double sign : {-1.0, 1.0})
            {
                Vector3 centre = straight.at(t);
                centre[axis] += sign * some.at(t);
                EXPECT_TRUE(centre_inside(store.paths[0], centre.data(), now));
                const double rounding = store.outer_envelope(0, now).deviation.at(0) - some.at(t);
                centre[axis] += sign * (rounding + 1e-9);
                EXPECT_FALSE(centre_inside(store.paths[0], centre.data(), now));
            }
    }
}

TEST(Verifier, NoCentreThatIsNotANumberIsInside)
{
    ProxyStore store;
    add_proxy(store, straight, some, 1, 100, 50);
    for (double bad : {nan, infinity, -infinity})
        EXPECT_FALSE(centre_inside(store.paths[0], Vector3(1, 2, bad).data(), 100));
}

// Envelopes, and boxes with sides near theirs: within, on and beyond them, by more or by less than single precision tells.
// What rounding adds is within what is allowed for it, also where the path has come far and where coordinates are large.
TEST(Verifier, ACentreInsideIsWithinTheOuterEnvelope)
{
    Random random(22);
    int inside = 0, beyond_the_path = 0;
    for (int i = 0; i < 100000; ++i)
    {
        ProxyStore store;
        const Tick begin = 100, now = begin + static_cast<Tick>(random.index(500));
        const double scale = std::pow(10, random.uniform(-3, 3));
        const Path path = {random.vector(random.chance(0.3) ? 1000 : 1), random.vector(scale),
                           random.vector(0.01 * scale)};
        add_proxy(store, path, {random.uniform(0, 0.01 * scale), random.uniform(0, 0.01 * scale), 0}, 1, begin, 600);
        const Envelope allowed = store.envelope(0, now), outer = store.outer_envelope(0, now);
        Vector3 centre = allowed.path.position;
        const auto axis = static_cast<Eigen::Index>(random.index(3));
        const double reach = allowed.deviation.at(0);
        centre[axis] += (random.chance(0.5) ? 1 : -1) * reach * (1 + random.uniform(-1, 1) * 1e-5);
        if (!centre_inside(store.paths[0], centre.data(), now))
            continue;
        const double off = std::abs(centre[axis] - outer.path.position[axis]);
        ASSERT_LE(off, outer.deviation.at(0) + 1e-15 * std::abs(centre[axis])) << i;
        ++inside;
        beyond_the_path += off > reach;
    }
    EXPECT_GT(inside, 40000);
    EXPECT_GT(beyond_the_path, 100) << "rounding is seen";
}

TEST(Verifier, ABoxThatIsSurelyInsideIsInside)
{
    Random random(21);
    int sure = 0, inside = 0;
    for (int i = 0; i < 40000; ++i)
    {
        ProxyStore store;
        const Vector3 place = Vector3::Constant(random.chance(0.3) ? 1000 : 0);
        const Tick begin = 100, now = begin + static_cast<Tick>(random.index(500));
        const Path path = {place + random.vector(1), random.vector(0.01), random.vector(1e-4)};
        add_proxy(store, path, {random.uniform(0, 0.1), random.uniform(0, 1e-3), 0}, random.uniform(0.01, 1), begin,
                  600);
        store.records[0].kind.still = random.chance(0.2);
        if (store.records[0].kind.still)
        {
            store.paths[0] = PackedPath{};
            std::copy_n(place.data(), 3, store.paths[0].position);
            store.paths[0].set_deviation({0.1, 0, 0});
            store.paths[0].since = begin;
        }
        Box box = store.envelope(0, now).at(0);
        const double margin = std::pow(10, random.uniform(-9, 0));
        for (int axis = 0; axis < 3; ++axis)
        {
            box.min()[axis] += margin * random.uniform(-0.1, 1);
            box.max()[axis] -= margin * random.uniform(-0.1, 1);
        }
        const bool surely = surely_inside(store.paths[0], store.records[0], MeasuredBox(box), now);
        const bool really = bounds_inside(store.paths[0], store.records[0], box, now);
        ASSERT_LE(surely, really) << i;
        sure += surely;
        inside += really;
    }
    EXPECT_GT(inside, 10000);
    EXPECT_LT(inside, 30000);
#if defined(__SSE2__)
    EXPECT_GT(sure, inside / 2);
#endif
}

TEST(Verifier, NothingIsSureOfABoxThatIsNotFinite)
{
    const Box good(Vector3(-0.5, -0.5, -0.5), Vector3(0.5, 0.5, 0.5));
    for (int axis = 0; axis < 3; ++axis)
        for (double bad : {nan, infinity, -infinity})
        {
            const auto number = static_cast<float>(bad);
            ProxyStore store;
            add_still_proxy(store, {0, 0, 0}, 1, 0);
            const auto sure = [&store](const Box &box) {
                return surely_inside(store.paths[0], store.records[0], MeasuredBox(box), 5);
            };
            Box box = good;
            box.min()[axis] = bad;
            EXPECT_FALSE(sure(box));
            box = good;
            box.max()[axis] = bad;
            EXPECT_FALSE(sure(box));
            const ProxyStore unspoilt = store;
            store.records[0].prediction.low[axis] = number;
            EXPECT_FALSE(sure(good));
            store = unspoilt;
            store.records[0].prediction.high[axis] = number;
            EXPECT_FALSE(sure(good));
            store = unspoilt;
            store.paths[0].position[axis] = bad;
            EXPECT_FALSE(sure(good));
            store = unspoilt;
            store.records[0].placement.unbounded = true;
            EXPECT_FALSE(sure(good)) << "the object is predicted anew whenever it moves";
        }
}

TEST(Verifier, BoundsMustBeInsideOnEverySide)
{
    const Envelope envelope = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {0.5, 0, 0}, {-1, -1, -1}, {1, 1, 1}, 2};
    const Box allowed = envelope.at(0);
    EXPECT_TRUE(bounds_inside(envelope, allowed)) << "closed";
    for (int axis = 0; axis < 3; ++axis)
    {
        Box lower = allowed, higher = allowed;
        lower.min()[axis] -= 1e-12;
        higher.max()[axis] += 1e-12;
        EXPECT_FALSE(bounds_inside(envelope, lower));
        EXPECT_FALSE(bounds_inside(envelope, higher));
        Box lost = allowed;
        lost.min()[axis] = nan;
        EXPECT_FALSE(bounds_inside(envelope, lost));
    }
}

TEST(Verifier, InfiniteSidesHoldInfiniteBounds)
{
    const Envelope floor = {
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {}, {-infinity, -infinity, -infinity}, {infinity, infinity, 0}, infinity};
    Box plane(Vector3::Constant(-infinity), Vector3(infinity, infinity, 0));
    EXPECT_TRUE(bounds_inside(floor, plane));
    plane.max().z() = 0.001;
    EXPECT_FALSE(bounds_inside(floor, plane));
}

TEST(Verifier, AnObjectCheckedByItsCentreMayTurnButNotGrow)
{
    ProxyStore store;
    add_proxy(store, straight, some, 1, 100, 50);
    OneObject object;
    object.centre = straight.at(10);
    EXPECT_TRUE(holds(object, store, 110));
    object.radius = 0.5;
    EXPECT_TRUE(holds(object, store, 110)) << "shrinking does no harm";
    object.radius = 1.001;
    EXPECT_FALSE(holds(object, store, 110));
    object.radius = nan;
    EXPECT_FALSE(holds(object, store, 110));
}

TEST(Verifier, AnObjectCheckedByItsBoundsMustHaveThemInside)
{
    ProxyStore store;
    add_proxy(store, straight, some, 1, 100, 50);
    check_by_bounds(store, 0);
    OneObject object;
    object.centre = straight.at(10);
    object.radius = 1 + some.at(10);
    EXPECT_TRUE(holds(object, store, 110));
    EXPECT_FALSE(holds(object, store, 108));
    object.radius += 1e-9;
    EXPECT_FALSE(holds(object, store, 110));
}

TEST(Verifier, AStillObjectMayStayForAnyTime)
{
    for (Check check : {Check::centre, Check::bounds})
    {
        ProxyStore store;
        add_still_proxy(store, {4, 5, 6}, 1, 0.25);
        if (check == Check::bounds)
            check_by_bounds(store, 0);
        OneObject object;
        object.centre = {4.25, 4.75, 6};
        for (Tick now : {0u, 1000u, 0x7fffffffu, 0x80000000u, 0xffffffffu})
            EXPECT_TRUE(holds(object, store, now));
        object.centre.z() += 0.2501;
        EXPECT_FALSE(holds(object, store, 1000));
    }
}

TEST(Verifier, NothingHoldsForAnObjectWithoutPrediction)
{
    ProxyStore store;
    store.add();
    OneObject object;
    EXPECT_FALSE(holds(object, store, 0));
}

TEST(Verifier, AnObjectThatNoTreeCanHoldIsPredictedAnewWheneverItMoves)
{
    ProxyStore store;
    add_still_proxy(store, {0, 0, 0}, 1, 0.25);
    check_by_bounds(store, 0);
    OneObject object;
    EXPECT_TRUE(holds(object, store, 0));
    store.records[0].placement.unbounded = true;
    EXPECT_FALSE(holds(object, store, 0));
}

TEST(Verifier, TimeMayWrapAround)
{
    ProxyStore store;
    const Tick since = 0xfffffffau;
    add_proxy(store, straight, some, 1, since, 50);
    EXPECT_TRUE(centre_inside(store.paths[0], straight.at(20).data(), since + 20));
    EXPECT_FALSE(centre_inside(store.paths[0], straight.at(0).data(), since + 20));
}

// An object that passes the check must lie in the box that the index has for it: to the last bit.
TEST(Verifier, AnObjectThatPassesIsInTheBoxOfTheIndex)
{
    Random random(1);
    int passed = 0;
    for (int i = 0; i < 300000; ++i)
    {
        ProxyStore store;
        const Tick now = 1000;
        add_random_proxy(store, random, i % 2 == 0 ? 2 : 1000, now);
        const bool still = store.records[0].kind.still;
        const std::int32_t t =
            still ? 0 : static_cast<std::int32_t>(random.index(static_cast<std::size_t>(store.remaining(0, now)) + 1));
        const Tick then = now + static_cast<Tick>(t);
        const Envelope predicted = store.envelope(0, then);
        OneObject object;
        object.centre = predicted.path.position;
        object.radius = store.records[0].prediction.radius;
        for (int axis = 0; axis < 3; ++axis)
        {
            object.centre[axis] += (random.chance(0.5) ? 1 : -1) * predicted.deviation.a;
            for (std::size_t steps = random.index(3); steps > 0; --steps)
                object.centre[axis] = std::nextafter(object.centre[axis], random.chance(0.5) ? infinity : -infinity);
        }
        if (!holds(object, store, then))
            continue;
        ++passed;
        const FloatBox indexed = store.swept_box(0, now);
        const Box bounds = object.box();
        for (int axis = 0; axis < 3; ++axis)
        {
            ASSERT_LE(indexed.low[axis], bounds.min()[axis]) << "object " << i << (still ? ", still" : "");
            ASSERT_GE(indexed.high[axis], bounds.max()[axis]) << "object " << i << (still ? ", still" : "");
        }
    }
    EXPECT_GT(passed, 30000);
}
} // namespace
} // namespace ode_predictive_space
