// What the report of a move tells, and when it is none.

#include <limits>

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/verification.h"

namespace ode_predictive_space
{
namespace
{
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
} // namespace
} // namespace ode_predictive_space
