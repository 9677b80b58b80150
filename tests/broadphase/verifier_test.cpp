#include "ode_predictive_space/broadphase/verify/verifier.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "tests/broadphase/support/proxies.h"

namespace ode_predictive_space
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// One object, wherever the test says.
struct OneObject : Scene
{
    Vector3 centre = Vector3::Zero();
    double radius = 1;
    int looks = 0;

    Box box() const { return Box(centre.array() - radius, centre.array() + radius); }

    void locate(const ProxyId *, std::size_t count, Location *locations) override
    {
        ++looks;
        std::fill_n(locations, count, Location{{centre.x(), centre.y(), centre.z()}, radius * radius});
    }
    void measure(const ProxyId *ids, std::size_t count, MeasuredBox *boxes) override
    {
        ++looks;
        for (std::size_t i = 0; i < count; ++i)
            boxes[ids[i]] = MeasuredBox(box());
    }
    Box bounds(ProxyId) override
    {
        ++looks;
        return box();
    }

    // Verification asks nothing else.
    void observe(const ProxyId *, std::size_t, const bool *, Observation *) override { ADD_FAILURE(); }
    std::optional<Vector3> pivot(ProxyId) override { return std::nullopt; }
    bool overlap(ProxyId, ProxyId) override { return false; }
    void find_disabled(const ProxyId *, std::size_t, std::vector<ProxyId> &) override { ADD_FAILURE(); }
};

// A verifier of the objects of a store.
class Verification
{
public:
    explicit Verification(const ProxyStore &store)
    {
        verifier.resize(store.size());
        boxes_.resize(store.size());
        batch_.resize(store.size());
        none_.resize(store.size());
    }

    // Is the only object found within its envelope at this tick, at which it has moved?
    bool holds(Scene &scene, const ProxyStore &store, Tick now)
    {
        verifier.mark_moved(0);
        return !find_broken(scene, store, now);
    }

    // Does the report of its move leave it without a closer look at the tick that was expected?
    template <typename Object> bool report_settles(ProxyStore &store, const Object &object, Tick expected)
    {
        verifier.report_move(store, 0, object, expected);
        OneObject scene;
        scene.centre = object.centre;
        scene.radius = object.radius;
        find_broken(scene, store, expected);
        return scene.looks == 0;
    }

    Verifier verifier;

private:
    bool find_broken(Scene &scene, const ProxyStore &store, Tick now)
    {
        boxes_.invalidate(verifier.collect_moves());
        batch_.clear();
        const Verifier::Outcome outcome = verifier.find_broken(
            scene, store, boxes_, {now, verifier.collect_moves().size(), true, true, none_, none_}, batch_);
        verifier.clear_moves();
        EXPECT_EQ(outcome.verified, 1u);
        EXPECT_EQ(outcome.broken, batch_.size() - (store.predicted(0) ? 0 : 1));
        return batch_.contains(0);
    }

    MeasuredBoxes boxes_;
    Batch batch_;
    IdSet none_;
};

bool holds(Scene &scene, const ProxyStore &store, Tick now)
{
    return Verification(store).holds(scene, store, now);
}

const Path straight = {{1, 2, 3}, {0.5, 0, 0}, {0, 0.25, 0}};
const Deviation some = {0.25, 0.125, 0};

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

// An object at the moment at which its move is reported.
struct JustMoved
{
    Vector3 centre = Vector3::Zero();
    double radius = 1;
    std::uint32_t pose = 1;
    mutable int sizes_asked = 0;
    bool pose_is_known = true;
    bool turns_about_centre = true;
    bool has_room = true; // to remember its pose
    bool watched = true;
    mutable double remembered_radius = 0;
    mutable std::uint32_t remembered_pose = 0;
    mutable Vector3 remembered_centre = Vector3::Zero();

    bool has_pose() const { return pose_is_known; }
    bool is_watched() const { return watched; }
    std::uint32_t pose_digest() const { return 4 * (pose % 1000); } // others may have the same
    bool remember(ProxyId) const
    {
        remembered_radius = radius;
        remembered_pose = pose;
        remembered_centre = centre;
        return has_room;
    }
    bool is_as_remembered(ProxyId) const
    {
        return pose == remembered_pose && radius == remembered_radius && centre == remembered_centre;
    }
    bool has_centre() const { return pose_is_known && turns_about_centre; }
    const double *coordinates() const { return centre.data(); }
    bool has_grown(float allowed) const
    {
        ++sizes_asked;
        return !(radius <= allowed);
    }
};

TEST(ReportOfAMove, HoldsWhileTheCentreIsNearItsPath)
{
    ProxyStore store;
    add_proxy(store, straight, some, 1, 100, 50);
    Verification verification(store);
    JustMoved object;
    object.centre = straight.at(10);
    EXPECT_TRUE(verification.report_settles(store, object, 110));
    EXPECT_FALSE(verification.report_settles(store, object, 130)) << "it should be elsewhere by then";
    object.centre.z() += 2;
    EXPECT_FALSE(verification.report_settles(store, object, 110));
    object.centre.z() = nan;
    EXPECT_FALSE(verification.report_settles(store, object, 110));
}

TEST(ReportOfAMove, LooksAtTheSizeWhenThePoseIsTheSameOrNotKnown)
{
    ProxyStore store;
    add_proxy(store, straight, some, 1, 100, 50);
    Verification verification(store);
    JustMoved object;
    object.centre = straight.at(10);
    EXPECT_TRUE(verification.report_settles(store, object, 110));
    EXPECT_EQ(object.sizes_asked, 1) << "the pose before is not known";
    object.pose = 2;
    EXPECT_TRUE(verification.report_settles(store, object, 110));
    EXPECT_EQ(object.sizes_asked, 1) << "only the pose has changed";
    object.radius = 2;
    EXPECT_FALSE(verification.report_settles(store, object, 110)) << "the pose is the same: the size has changed";
}

TEST(ReportOfAMove, LeavesDoubtWhereItTakesACloserLook)
{
    ProxyStore store;
    add_proxy(store, straight, some, 1, 100, 50);
    Verification verification(store);
    JustMoved object;
    object.centre = straight.at(10);
    object.pose_is_known = false;
    EXPECT_FALSE(verification.report_settles(store, object, 110)) << "the position has to be computed first";
    object.pose_is_known = true;
    object.turns_about_centre = false;
    EXPECT_FALSE(verification.report_settles(store, object, 110)) << "its sphere may turn about another point";
    object.turns_about_centre = true;
    object.pose_is_known = false;
    EXPECT_FALSE(verification.report_settles(store, object, 110));
    object.pose_is_known = true;
    object.pose = 7;
    object.radius = 2;
    EXPECT_FALSE(verification.report_settles(store, object, 110)) << "the pose before is not known";
    check_by_bounds(store, 0);
    store.stamps[0] = Stamp{};
    object.radius = 1;
    EXPECT_FALSE(verification.report_settles(store, object, 110)) << "it is checked by its bounds";
}

// Reports of one object, one after the other.
class Reports
{
public:
    bool is_move(const JustMoved &object)
    {
        const bool result = verification_.verifier.report_move(store_, 0, object, 110);
        EXPECT_EQ(verification_.verifier.collect_moves().contains(0), result);
        verification_.verifier.clear_moves();
        return result;
    }

private:
    static ProxyStore store_of_one()
    {
        ProxyStore store;
        add_proxy(store, straight, some, 1, 100, 50);
        return store;
    }

    ProxyStore store_ = store_of_one();
    Verification verification_{store_};
};

TEST(ReportOfAMove, IsNoneWhenNothingHasChanged)
{
    Reports reports;
    JustMoved object;
    object.centre = straight.at(10);
    EXPECT_TRUE(reports.is_move(object));
    EXPECT_TRUE(reports.is_move(object)) << "the digest is the same, but it is not known whether the pose is";
    for (int i = 0; i < 3; ++i)
        EXPECT_FALSE(reports.is_move(object));
    object.radius = 0.5;
    EXPECT_TRUE(reports.is_move(object)) << "the size has changed";
    EXPECT_FALSE(reports.is_move(object));
    object.pose = 1001;
    EXPECT_TRUE(reports.is_move(object)) << "another pose with the same digest";
    EXPECT_FALSE(reports.is_move(object));
}

// Between two equal poses with the same digest there was another one: what was remembered is older.
TEST(ReportOfAMove, IsComparedWithTheLastReportOnly)
{
    Reports reports;
    JustMoved object;
    object.centre = straight.at(10);
    for (int i = 0; i < 3; ++i)
        reports.is_move(object);
    object.pose = 2;
    EXPECT_TRUE(reports.is_move(object));
    object.pose = 1001;
    EXPECT_TRUE(reports.is_move(object));
    object.pose = 1;
    EXPECT_TRUE(reports.is_move(object)) << "it was at 1001 a moment ago, whose digest is that of 1";
}

TEST(ReportOfAMove, CountsAlwaysWithoutRoomToRemember)
{
    Reports reports;
    JustMoved object;
    object.centre = straight.at(10);
    object.has_room = false;
    for (int i = 0; i < 5; ++i)
        EXPECT_TRUE(reports.is_move(object));
}

TEST(ReportOfAMove, CountsAlwaysWithoutAPose)
{
    Reports reports;
    JustMoved object;
    object.centre = straight.at(10);
    object.pose_is_known = false;
    for (int i = 0; i < 5; ++i)
        EXPECT_TRUE(reports.is_move(object));
}

// While poses are not compared, an object without a centre may go anywhere and return.
TEST(ReportOfAMove, CountsAfterATimeInWhichPosesWereNotWatched)
{
    Reports reports;
    JustMoved object;
    object.turns_about_centre = false;
    for (int i = 0; i < 3; ++i)
        reports.is_move(object);
    EXPECT_FALSE(reports.is_move(object));
    object.watched = false;
    EXPECT_FALSE(reports.is_move(object)) << "it is known still";
    object.pose = 2;
    EXPECT_TRUE(reports.is_move(object));
    EXPECT_TRUE(reports.is_move(object));
    object.pose = 1001;
    EXPECT_TRUE(reports.is_move(object));
    object.watched = true;
    object.pose = 1;
    EXPECT_TRUE(reports.is_move(object));
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
