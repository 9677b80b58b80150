#include <cstdlib>
#include <fstream>

#include <unistd.h>

#include <ode/ode.h>

#include <gtest/gtest.h>

#include "ode_predictive_space/history.h"
#include "ode_predictive_space/recording/check.h"
#include "ode_predictive_space/recording/replay.h"
#include "tests/faults/allocation_faults.h"
#include "tests/recording/recorded.h"
#include "tests/recording/recorder_fixture.h"
#include "tests/support/effort.h"
#include "tests/support/scratch.h"

namespace ode_predictive_space::recording
{
namespace
{
// All limits within the size of a tick: there is always room for the end, and for the pairs of a collide that has begun.
TEST_F(RecorderTest, NoLimitIsExceeded)
{
    const dGeomID ball = dCreateSphere(space_, 1);
    dCreateSphere(space_, 1);
    const EventTimes times{}; // with them, an event takes all the room that is kept for it
    for (std::uint64_t limit = 2000; limit < 2150; ++limit)
    {
        Recorded recorded(limit);
        for (int i = 0; i < 20 && !recorded.recorder().is_over(); ++i)
        {
            dGeomSetPosition(ball, dReal(0.1) * static_cast<dReal>(i), 0, 0);
            recorded.collide(space_, &times);
        }
        const Recording recording = recorded.end();
        EXPECT_LE(recording.bytes(), limit);
        EXPECT_GT(recording.bytes(), limit - 200) << "one event more does not fit";
        EXPECT_TRUE(recording.reached_limit());
        EXPECT_TRUE(recording.events().back().has_pairs);
    }
}

// A callback may collide, too.
TEST_F(RecorderTest, NoLimitIsExceededByCollidesWithinACollide)
{
    dCreateSphere(space_, 1);
    const EventTimes times{};
    for (std::uint64_t limit = 2000; limit < 2150; ++limit)
    {
        Recorded recorded(limit);
        while (!recorded.recorder().is_over())
        {
            Recorder::Event outer = recorded.recorder().begin_collide(space_),
                            inner = recorded.recorder().begin_collide(space_);
            inner.end(&times);
            outer.end(&times);
        }
        EXPECT_LE(recorded.end().bytes(), limit);
    }
}

TEST_F(RecorderTest, WithoutAnEndTheLastCollideIsThere)
{
    dCreateSphere(space_, 1);
    Recorded recorded;
    recorded.recorder().begin_collide(space_);
    const Recording recording = recorded.so_far();
    ASSERT_EQ(recording.events().size(), 1u);
    EXPECT_FALSE(recording.events()[0].has_pairs) << "the program did not survive it";
    EXPECT_FALSE(recording.has_end());
}

// Once, it was closed as whole and then refused, as it contained half of an event.
TEST_F(RecorderTest, WithoutMemoryItIsCutAfterItsLastWholeRecord)
{
    Tetrahedron tetrahedron;
    const dTriMeshDataID mesh = tetrahedron.make_mesh();
    bool struck = true;
    for (long spared = 0; struck; ++spared)
    {
        SCOPED_TRACE(spared);
        const dSpaceID space = dSimpleSpaceCreate(nullptr);
        dCreateSphere(space, 1);
        Recorded recorded;
        recorded.collide(space);
        dCreateTriMesh(space, mesh, nullptr, nullptr, nullptr);
        for (int i = 0; i < 30; ++i)
            dGeomSetPosition(dCreateBox(space, 1, 1, 1), dReal(i), 0, 0);
        {
            const AllocationFault fault(spared);
            EXPECT_GT(recorded.collide(space), 0) << "the program goes on";
            struck = fault.struck();
        }
        recorded.collide(space);
        const bool is_whole = recorded.recorder().close();
        EXPECT_EQ(is_whole, !struck);
        const Recording recording = recorded.so_far();
        EXPECT_EQ(recording.has_end(), is_whole);
        EXPECT_EQ(recording.whole_bytes(), recording.bytes()) << "nothing of a record that is not whole";
        EXPECT_TRUE(recording.events()[0].has_pairs) << "what was recorded before is there";
        EXPECT_EQ(find_pairs(recording, SpaceKind::box).events.size(), recording.events().size());
        dSpaceDestroy(space);
    }
    dGeomTriMeshDataDestroy(mesh);
}

TEST_F(RecorderTest, ASpaceRecordsItselfAndFindsTheSamePairs)
{
    const ScratchFile file;
    const dSpaceID twin = dPredictiveSpaceCreate(nullptr);
    std::vector<std::array<dGeomID, 2>> geoms;
    for (int i = 0; i < 40; ++i)
        geoms.push_back({dCreateSphere(space_, 1), dCreateSphere(twin, 1)});
    ASSERT_EQ(dPredictiveSpaceRecord(space_, file.path().c_str(), 0), 1);
    EXPECT_TRUE(dSpaceIsPredictive(space_));
    for (int tick = 0; tick < 30; ++tick)
    {
        for (std::size_t i = 0; i < geoms.size(); ++i)
            for (const dGeomID geom : geoms[i])
                dGeomSetPosition(geom, dReal(i % 7) * dReal(1.3), dReal(i) * dReal(0.4), dReal(tick * (i % 3)) / 10);
        int pairs = 0, expected = 0;
        dSpaceCollide(space_, &pairs, count);
        dSpaceCollide(twin, &expected, count);
        EXPECT_EQ(pairs, expected);
    }
    const dGeomID probe = dCreateSphere(nullptr, 1);
    int pairs = 0;
    dSpaceCollide2(probe, reinterpret_cast<dGeomID>(space_), &pairs, count);
    EXPECT_EQ(dPredictiveSpaceValidate(space_), 1);
    EXPECT_EQ(dPredictiveSpaceRecord(space_, nullptr, 0), 1);
    dSpaceCollide(space_, &pairs, count);
    dGeomDestroy(probe);
    const Recording recording = Recording::read(file.path());
    EXPECT_EQ(recording.events().size(), 31u) << "what came afterwards is not in it";
    EXPECT_TRUE(recording.has_end());
    for (const EventSummary &event : recording.events())
        EXPECT_TRUE(event.has_pairs);
    expect_pairs_agree(recording);
    dSpaceDestroy(twin);
}

TEST_F(RecorderTest, ASpaceRecordsItselfUpToTheLimitThatItIsTold)
{
    const ScratchFile file;
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    const dGeomID ball = dCreateSphere(space, 1);
    ASSERT_EQ(dPredictiveSpaceRecord(space, file.path().c_str(), 3000), 1);
    for (int i = 0; i < 100; ++i)
    {
        dGeomSetPosition(ball, dReal(i), 0, 0);
        dSpaceCollide(space, nullptr, ignore);
    }
    dSpaceDestroy(space);
    const Recording recording = Recording::read(file.path());
    EXPECT_TRUE(recording.reached_limit());
    EXPECT_LE(recording.bytes(), 3000u);
}

void expect_not_recorded(dSpaceID space, const std::string &path, const std::string &reason)
{
    int result = 1;
    const auto record = [&] { result = dPredictiveSpaceRecord(space, path.empty() ? nullptr : path.c_str(), 0); };
    const std::string complaint = ode_complaint(record);
    EXPECT_EQ(result, 0);
    EXPECT_NE(complaint.find(reason), std::string::npos) << complaint;
}

// Once, the next collide ended the program.
TEST_F(RecorderTest, ASecondRecordingEndsTheFirstAlsoWhenItsFileCannotBeMade)
{
    const ScratchFile file;
    const dSpaceID space = dPredictiveSpaceCreate(nullptr), other = dPredictiveSpaceCreate(nullptr);
    dCreateSphere(space, 1);
    ASSERT_EQ(dPredictiveSpaceRecord(space, file.path().c_str(), 0), 1);
    dSpaceCollide(space, nullptr, ignore);
    expect_not_recorded(space, "/nonexistent/file", "/nonexistent/file");
    dSpaceCollide(space, nullptr, ignore);
    EXPECT_TRUE(Recording::read(file.path()).has_end());
    EXPECT_EQ(Recording::read(file.path()).events().size(), 1u) << "the first recording has ended with the second call";

    EXPECT_EQ(dPredictiveSpaceRecord(space, file.path().c_str(), 0), 1);
    EXPECT_EQ(dPredictiveSpaceRecord(space, file.path().c_str(), 0), 1) << "its own file again";
    expect_not_recorded(other, file.path(), "another recording is being written to it");
    dSpaceDestroy(space);
    EXPECT_TRUE(Recording::read(file.path()).has_end());
    dSpaceDestroy(other);
}

TEST_F(RecorderTest, AForkedProgramGoesOnWithItsRecordedSpace)
{
    const ScratchFile file;
    const dGeomID ball = dCreateSphere(space_, 1);
    ASSERT_EQ(dPredictiveSpaceRecord(space_, file.path().c_str(), 0), 1);
    EXPECT_EXIT(
        {
            alarm(10); // ends a child that waits for a lock
            dGeomSetPosition(ball, 1, 0, 0);
            dSpaceCollide(space_, nullptr, ignore);
            _exit(0);
        },
        testing::ExitedWithCode(0), "");
}

TEST_F(RecorderTest, WhatCannotBeRecordedIsRefused)
{
    const dSpaceID hash = dHashSpaceCreate(nullptr);
    expect_not_recorded(hash, "/dev/null", "not a predictive");
    expect_not_recorded(nullptr, "/dev/null", "null");
    expect_not_recorded(space_, "/nonexistent/file", "/nonexistent/file");
    EXPECT_EQ(dPredictiveSpaceRecord(space_, nullptr, 0), 1) << "there was none";
    dCreateSphere(space_, 1);
    dCreateSphere(space_, 1);
    dSpaceCollide(space_, space_, [](void *self, dGeomID, dGeomID) {
        EXPECT_NE(ode_complaint([&] {
                      dPredictiveSpaceRecord(static_cast<dSpaceID>(self), "/dev/null", 0);
                  }).find("locked space"),
                  std::string::npos);
    });
    dSpaceCollide(space_, nullptr, ignore);
    ASSERT_EQ(dPredictiveSpaceRecord(space_, "/dev/full", 0), 1);
    dSpaceCollide(space_, nullptr, ignore);
    expect_not_recorded(space_, "", "to its end");
    dSpaceDestroy(hash);
}
} // namespace
} // namespace ode_predictive_space::recording
