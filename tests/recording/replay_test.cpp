#include "ode_predictive_space/recording/replay.h"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include <unistd.h>

#include <gtest/gtest.h>

#include <ode/ode.h>

#include "ode_predictive_space/recording/check.h"
#include "ode_predictive_space/recording/child.h"
#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/ode_test.h"
#include "tests/recording/recorded.h"

namespace ode_predictive_space::recording
{
namespace
{

constexpr double no_limit = 1e9;

class Replay : public OdeTest
{
protected:
    ~Replay() override
    {
        dSpaceDestroy(space_);
        dGeomTriMeshDataDestroy(triangle_);
    }

    // A mesh of one triangle, whose box is twice as large.
    void add_triangle()
    {
        dGeomTriMeshDataBuildSingle(triangle_, corners_, 3 * sizeof(float), 3, indices_, 3, 3 * sizeof(dTriIndex));
        dCreateTriMesh(space_, triangle_, nullptr, nullptr, nullptr);
    }

    dGeomID ball_at(dReal x, dReal y, dReal z)
    {
        const dGeomID ball = dCreateSphere(space_, 1);
        dGeomSetPosition(ball, x, y, z);
        return ball;
    }

    Recording collided(int times)
    {
        Recorded recorded;
        for (int i = 0; i < times; ++i)
            recorded.collide(space_);
        return recorded.end();
    }

    const dSpaceID space_ = dHashSpaceCreate(nullptr);

private:
    const float corners_[9] = {-5, -5, 0, 5, -5, 0, -5, 5, 0};
    const dTriIndex indices_[3] = {0, 1, 2};
    const dTriMeshDataID triangle_ = dGeomTriMeshDataCreate();
};

TEST_F(Replay, MeasuresNoMoreEventsThanItIsTold)
{
    ball_at(0, 0, 0);
    ball_at(1, 0, 0);
    const Recording recording = collided(5);
    for (const std::size_t most : {std::size_t{0}, std::size_t{3}, std::size_t{5}, std::size_t{9}})
    {
        const Cost cost = measure(recording, SpaceKind::box, most, no_limit);
        EXPECT_EQ(cost.failure, "");
        EXPECT_EQ(cost.events.size(), std::min<std::size_t>(most, 5));
        for (const MeasuredEvent &event : cost.events)
            EXPECT_EQ(event.callbacks, 1u);
        if (most == 0)
            EXPECT_EQ(cost.processor_time, 0);
        else
            EXPECT_EQ(cost.events[0].notices, 0) << "the making of the geoms does not count";
    }
    EXPECT_EQ(measure(recording, SpaceKind::box, 5, -1).events.size(), 0u) << "its time is over";
    Callbacks callbacks;
    EXPECT_EQ(judge_callbacks(recording, 5, -1, callbacks), "");
    EXPECT_EQ(callbacks.all, 0u);
}

TEST(Cost, IsTheLeastOfTwoReplays)
{
    Cost cost, again;
    cost.events = {{1, 5, 0}, {4, 2, 0}, {3, 3, 0}};
    again.events = {{2, 4, 0}, {3, 3, 0}};
    take_least(again, cost);
    const float collides[] = {1, 3, 3}, notices[] = {4, 2, 3};
    for (std::size_t i = 0; i < 3; ++i)
    {
        EXPECT_EQ(cost.events[i].collide, collides[i]) << i;
        EXPECT_EQ(cost.events[i].notices, notices[i]) << i;
    }
}

TEST_F(Replay, JudgesCallbacksByTheirContacts)
{
    ball_at(0, 0, 0);
    ball_at(dReal(1.9), dReal(1.9), 0); // the boxes overlap, the balls do not
    ball_at(20, 0, 0);
    ball_at(21, 0, 0); // a contact
    dGeomSetPosition(create_geom(GeomKind::user, 1, space_), 40, 0, 0);
    ball_at(40, 0, 0); // the other one is known by its box only
    const float heights[4] = {0, 0, 0, 0};
    const dHeightfieldDataID field = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildSingle(field, heights, 0, 4, 4, 2, 2, 1, 0, 1, 0);
    const dGeomID ground = dCreateHeightfield(space_, field, 1);
    dGeomSetPosition(ground, 60, 0, 0);
    ball_at(60, 0, 0); // a contact
    const Recording recording = collided(2);
    Callbacks callbacks;
    EXPECT_EQ(judge_callbacks(recording, recording.events().size(), no_limit, callbacks), "");
    EXPECT_EQ(callbacks.all, 2 * 4u);
    EXPECT_EQ(callbacks.nothing, 2 * 1u);
    EXPECT_EQ(callbacks.unknown, 2 * 1u);
    EXPECT_EQ(callbacks.seconds_spared, 0) << "two balls are told apart by box by shape, too";
    EXPECT_EQ(judge_callbacks(recording, 1, no_limit, callbacks), "");
    EXPECT_EQ(callbacks.all, 4u);
    dGeomDestroy(ground);
    dGeomHeightfieldDataDestroy(field);
}

TEST_F(Replay, CountsTheTimeOfSparedCallbacksAlone)
{
    add_triangle();
    ball_at(4, 4, 0);
    ball_at(20, 0, 0);
    ball_at(dReal(21.9), dReal(1.9), 0); // the boxes overlap, the balls do not: by shape, too
    const Recording recording = collided(2);
    Callbacks callbacks;
    EXPECT_EQ(judge_callbacks(recording, recording.events().size(), no_limit, callbacks), "");
    EXPECT_EQ(callbacks.nothing, 2 * 2u);
    EXPECT_GT(callbacks.seconds_spared, 0);
}

TEST_F(Replay, LeavesOutPairsByShapeAndSaysSo)
{
    add_triangle();
    ball_at(4, 4, 0);
    ball_at(0, 0, 0);
    ball_at(1, 0, 0);
    const Recording recording = collided(3);
    const Pairs simple = find_pairs(recording, SpaceKind::simple), shape = find_pairs(recording, SpaceKind::shape);
    EXPECT_EQ(shape.lost_contacts, 0u);
    EXPECT_EQ(shape.strange, 0u);
    const Verdict verdict = compare(recording, SpaceKind::shape, shape, simple);
    EXPECT_TRUE(verdict.agrees);
    EXPECT_NE(verdict.text.find(" without one are left out"), std::string::npos) << verdict.text;
    EXPECT_EQ(verdict.text.find("; 0 without"), std::string::npos) << verdict.text;
}

// ODE's sweep-and-prune space reports the plane with everything.
TEST_F(Replay, NamesThePairsThatDiffer)
{
    ball_at(0, 0, 50);
    dCreatePlane(space_, 0, 0, 1, 0);
    const Recording of_two = collided(2);
    EXPECT_EQ(differing_pairs(of_two, SpaceKind::sap, SpaceKind::simple, 1), ": geoms 1 and 2 only in sap");
    EXPECT_EQ(differing_pairs(of_two, SpaceKind::simple, SpaceKind::sap, 1), ": geoms 1 and 2 only in sap");
    for (const int z : {60, 70, 80})
        ball_at(0, 0, dReal(z));
    const Recording recording = collided(2);
    EXPECT_EQ(differing_pairs(recording, SpaceKind::sap, SpaceKind::simple, 1),
              ": geoms 1 and 2 only in sap, 2 and 3 only in sap, 2 and 4 only in sap, \xe2\x80\xa6");
    EXPECT_EQ(differing_pairs(recording, SpaceKind::box, SpaceKind::simple, 1), "");
}

// For ODE's spaces a space within them reaches anywhere.
TEST_F(Replay, PairsWithASpaceAreOfWhatHasNoBounds)
{
    const dSpaceID inner = dHashSpaceCreate(space_);
    dGeomSetPosition(dCreateSphere(inner, 1), 0, 0, 50);
    ball_at(0, 0, 50);
    EXPECT_EQ(find_pairs(collided(1), SpaceKind::simple).events[0].unbounded, 1u);
}

TEST_F(Replay, OnlyOdesOwnSpacesMayHaveMoreOfWhatHasNoBounds)
{
    ball_at(0, 0, 0);
    ball_at(1, 0, 0);
    const Recording recording = collided(1);
    const Pairs simple = find_pairs(recording, SpaceKind::simple);
    Pairs more = simple, other = simple;
    more.events[0].count += 2;
    more.events[0].hash += 77;
    more.events[0].unbounded += 2;
    more.events[0].hash_of_unbounded += 77;
    other.events[0].count += 2;
    other.events[0].hash += 77;
    for (const SpaceKind kind : all_kinds)
    {
        if (leaves_out_pairs(kind))
            continue;
        const bool may = kind == SpaceKind::own || kind == SpaceKind::quadtree || kind == SpaceKind::sap;
        EXPECT_EQ(compare(recording, kind, more, simple).agrees, may) << name_of(kind);
        EXPECT_FALSE(compare(recording, kind, other, simple).agrees) << name_of(kind) << ": of what has bounds";
        EXPECT_FALSE(compare(recording, kind, simple, more).agrees) << name_of(kind) << ": less of it";
        EXPECT_TRUE(compare(recording, kind, simple, simple).agrees) << name_of(kind);
    }
}

TEST_F(Replay, SaysWhyAChildDidNotGetToItsEnd)
{
    EXPECT_EQ(do_in_child([] {}), "");
    EXPECT_EQ(do_in_child([] { throw std::runtime_error("an exception"); }), "an exception");
    EXPECT_EQ(do_in_child([] { dError(d_ERR_UASSERT, "an error of %s", "ODE"); }), "an error of ODE");
    EXPECT_EQ(do_in_child([] { dDebug(d_ERR_IASSERT, "an assertion"); }), "an assertion");
    EXPECT_EQ(do_in_child([] { std::raise(SIGKILL); }), strsignal(SIGKILL));
    EXPECT_EQ(do_in_child([] { _exit(3); }), "the process ended without a message");
    EXPECT_EQ(do_in_child([] { dMessage(0, "a message ends nothing"); }), "");
}

TEST(CountedEvents, AreThoseThatWereChosen)
{
    const CountedEvents all, some{2, 9, 3};
    EXPECT_TRUE(all.has(0));
    EXPECT_EQ(all.count_of(5), 5u);
    for (const std::size_t event : {2, 5, 8})
        EXPECT_TRUE(some.has(event)) << event;
    for (const std::size_t event : {0, 1, 3, 4, 9, 11})
        EXPECT_FALSE(some.has(event)) << event;
    EXPECT_EQ(some.count_of(100), 3u);
    EXPECT_EQ(some.count_of(8), 2u);
    EXPECT_EQ(some.count_of(2), 0u);
}
} // namespace
} // namespace ode_predictive_space::recording
