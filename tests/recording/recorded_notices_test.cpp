// The notices that a recorded predictive space gets, and the description of the space in a recording.

#include <map>
#include <set>
#include <vector>

#include <unistd.h>

#include <ode/ode.h>

#include <gtest/gtest.h>

#include "ode_predictive_space/history.h"
#include "ode_predictive_space/recording/recorder.h"
#include "ode_predictive_space/recording/space_kind.h"
#include "tests/recording/recorded.h"
#include "tests/recording/recorder_fixture.h"

namespace ode_predictive_space::recording
{
namespace
{
class Notices final : public NoticeListener
{
public:
    explicit Notices(dSpaceID space) { ode_predictive_space_listen(space, this); }
    ~Notices() { ode_predictive_space_stop_listening(this); }
    void notify_moved(dGeomID geom) override { ++numbers_[geom]; }

    std::vector<int> take(const std::vector<dGeomID> &geoms)
    {
        std::vector<int> numbers;
        for (const dGeomID geom : geoms)
            numbers.push_back(numbers_[geom]);
        numbers_.clear();
        return numbers;
    }

private:
    std::map<dGeomID, int> numbers_;
};

// Enough geoms for the space to predict, so that no moved geom stays marked.
std::vector<dGeomID> balls_in(dSpaceID space)
{
    std::vector<dGeomID> balls;
    for (int i = 0; i < 30; ++i)
    {
        balls.push_back(dCreateSphere(space, REAL(0.1)));
        dGeomSetPosition(balls.back(), dReal(i), 0, 0);
    }
    return balls;
}

// The notices before each event but the first, for the geoms in the first space, from the last to the first as recorded.
std::vector<std::vector<int>> notices_in_replay(const Recording &recording)
{
    Stage stage(recording, SpaceKind::box);
    std::unique_ptr<Notices> notices;
    std::vector<dGeomID> geoms;
    std::vector<std::vector<int>> numbers;
    for (const Record &record : recording.records())
    {
        if (record.kind != RecordKind::collide)
        {
            stage.apply(record);
            continue;
        }
        if (notices)
            numbers.push_back(notices->take(geoms));
        stage.ask(record, nullptr, ignore);
        if (notices)
            continue;
        for (std::uint32_t id = 1; id < recording.geom_count(); ++id)
            geoms.push_back(stage.geom(id));
        notices = std::make_unique<Notices>(reinterpret_cast<dSpaceID>(stage.geom(0)));
    }
    return numbers;
}

TEST_F(RecorderTest, AGeomMayMoveMoreOftenThanAReplayRepeats)
{
    const std::vector<dGeomID> geoms = balls_in(space_);
    Recorded recorded;
    recorded.collide(space_);
    for (int i = 0; i < 3000; ++i)
        dGeomSetPosition(geoms[0], dReal(i) / 1000, 1, 0);
    recorded.collide(space_);
    expect_pairs_agree(recorded.end());
}

// The notices of its first stay are no notices of its second.
TEST_F(RecorderTest, AGeomThatMovedLeftAndCameBackHasNoNotices)
{
    const dGeomID ball = balls_in(space_).front();
    Recorded recorded;
    recorded.collide(space_);
    dGeomSetPosition(ball, 0, 1, 0);
    dSpaceRemove(space_, ball);
    recorded.collide(space_);
    dSpaceAdd(space_, ball);
    recorded.collide(space_);
    const Recording recording = recorded.end();
    for (const Record &record : recording.records())
        EXPECT_NE(record.kind, RecordKind::notices);
}

// Like an engine with its own world, the program sets all poses in each tick, though few change.
TEST_F(RecorderTest, NoticesComeBackAlsoOfPosesThatAreSetToWhatTheyAre)
{
    std::vector<dGeomID> geoms = balls_in(space_);
    const dBodyID body = dBodyCreate(world_);
    for (const std::size_t i : {20u, 21u})
        dGeomSetBody(geoms[i], body);
    dGeomSetOffsetPosition(geoms[21], 0, 1, 0);
    Recorded recorded;
    recorded.collide(space_);
    std::vector<std::vector<int>> live;
    {
        Notices notices(space_);
        for (int tick = 0; tick < 6; ++tick)
        {
            for (std::size_t i = 0; i < 10; ++i) // two notices each
            {
                const dReal *position = dGeomGetPosition(geoms[i]);
                dGeomSetPosition(geoms[i], position[0], position[1] + (i == 0 ? REAL(0.1) : 0), position[2]);
                dGeomSetRotation(geoms[i], dGeomGetRotation(geoms[i]));
            }
            dGeomSetPosition(geoms[15], 15, dReal(tick), 0);
            dBodySetPosition(body, 0, 0, dReal(tick / 2));
            live.push_back(notices.take(geoms));
            recorded.collide(space_);
        }
    }
    EXPECT_EQ(live[3][0], 2);
    EXPECT_EQ(live[3][9], 2);
    EXPECT_EQ(live[3][10], 0);
    EXPECT_EQ(live[3][15], 1);
    EXPECT_EQ(live[3][21], 1) << "its body was set to where it was";
    const Recording recording = recorded.end();
    EXPECT_EQ(notices_in_replay(recording), live);
    expect_pairs_agree(recording);
}

// dGeomRaySet() turns the body of its ray. The other geoms stay where they were until the body moves.
TEST_F(RecorderTest, AGeomThatDoesNotFollowItsBodyStaysThereAfterItsNotices)
{
    balls_in(space_);
    const dBodyID body = dBodyCreate(world_);
    const dGeomID ray = dCreateRay(space_, 5), box = dCreateBox(space_, 1, 2, 3);
    dGeomSetBody(ray, body);
    dGeomSetBody(box, body);
    dGeomSetOffsetPosition(box, 1, 2, 3);
    Recorded recorded;
    recorded.collide(space_);
    const auto turn_and_compare = [&](dReal x, dReal y) {
        dGeomRaySet(ray, 0, 0, 0, x, y, 0);
        recorded.collide(space_);
        const Recording recording = recorded.so_far();
        const auto stage = staged(recording);
        expect_same(ray, stage->geom(31));
        expect_same(box, stage->geom(32));
    };
    turn_and_compare(1, 0);
    dBodySetPosition(body, 0, 0, 1);
    dBodySetPosition(body, 0, 0, 2);
    dGeomGetPosition(box); // ODE computes it here
    turn_and_compare(0, 1);
}

TEST_F(RecorderTest, NoticesOfNestedPredictiveSpacesAreRecordedAndThoseOfOdesSpacesAreNot)
{
    const dSpaceID inner = dPredictiveSpaceCreate(space_), simple = dSimpleSpaceCreate(space_);
    dPredictiveSpaceSetProximity(inner, dPredictiveProximityShape);
    const std::vector<dGeomID> in_predictive = balls_in(inner), in_simple = balls_in(simple);
    Recorded recorded;
    for (int tick = 0; tick < 4; ++tick)
    {
        recorded.collide(space_);
        for (const dGeomID each : {in_predictive[3], in_simple[3]})
            for (int times = 0; times < 3; ++times)
                dGeomSetPosition(each, 3, 0, 0);
    }
    const Recording recording = recorded.end();
    std::map<std::uint32_t, std::uint32_t> number_of;
    std::vector<SpaceService> services;
    for (const Record &record : recording.records())
        if (record.kind == RecordKind::notices)
            for (const NoticeCount &count : recording.notices(record))
                number_of[count.id] = count.number;
        else if (record.kind == RecordKind::geom && is_space_class(recording.geom(record).state.geom_class))
            services.push_back(recording.geom(record).state.service);
    ASSERT_EQ(services.size(), 3u);
    EXPECT_EQ(services[0].predictive, 1 + dPredictiveProximityBox);
    EXPECT_EQ(services[1].predictive, 1 + dPredictiveProximityShape);
    EXPECT_EQ(services[2].predictive, 0);
    EXPECT_FALSE(services[0].is_substitute);
    EXPECT_EQ(number_of.size(), 3u) << "one ball, and both spaces";
    EXPECT_EQ(number_of[5], 3u) << "the fourth ball";
    expect_pairs_agree(recording);
}

// A substitute has the class of ODE's space for the program; a space that the program itself made is predictive.
TEST_F(RecorderTest, ASubstituteIsRecordedAsTheSpaceThatTheProgramMade)
{
    balls_in(space_);
    for (const bool is_substitute : {false, true})
    {
        const ScratchFile file;
        Recorder recorder(HistoryFile(file.path(), false), 1 << 24, "a test", [=](dSpaceID) { return is_substitute; });
        recorder.begin_collide(space_).end();
        recorder.close();
        const GeomState state = Recording::read(file.path()).state_of_first_space();
        EXPECT_EQ(full_name_of(own_kind(state)), is_substitute ? "hash" : "predictive, by box");
        EXPECT_EQ(full_name_of(recorded_kind(state)), "predictive, by box");
    }
}

TEST_F(RecorderTest, APredictiveSpaceComesBackWithItsProximity)
{
    for (const int proximity : {dPredictiveProximitySphere, dPredictiveProximityShape, dPredictiveProximityBox})
    {
        dPredictiveSpaceSetProximity(space_, proximity);
        Recorded recorded;
        recorded.collide(space_);
        const Recording recording = recorded.end();
        for (const SpaceKind kind : {SpaceKind::own, predictive_kind(proximity)})
        {
            const auto stage = staged(recording, kind);
            EXPECT_EQ(dPredictiveSpaceGetProximity(reinterpret_cast<dSpaceID>(stage->geom(0))), proximity);
        }
    }
}

TEST_F(RecorderTest, AForkedProgramCountsNoNotices)
{
    const dGeomID ball = balls_in(space_).front();
    dSpaceCollide(space_, nullptr, ignore);
    Notices notices(space_);
    EXPECT_EXIT(
        {
            alarm(10); // ends a child that waits for a lock
            dGeomSetPosition(ball, 0, 1, 0);
            _exit(notices.take({ball})[0]);
        },
        testing::ExitedWithCode(0), "")
        << "there is nobody to take them";
    dGeomSetPosition(ball, 0, 1, 0);
    EXPECT_EQ(notices.take({ball})[0], 1) << "its parent goes on";
}

TEST_F(RecorderTest, ASpaceThatIsNotRecordedAnyMoreIsNotWatchedEither)
{
    const ScratchFile file;
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    const std::vector<dGeomID> balls = balls_in(space);
    const auto functions = [&] { return *reinterpret_cast<void **>(space); };
    void *const before = functions();
    {
        Recorded recorded;
        recorded.collide(space);
        EXPECT_NE(functions(), before);
        EXPECT_EQ(dPredictiveSpaceRecord(space, file.path().c_str(), 0), 1);
        recorded.end();
        EXPECT_NE(functions(), before) << "it records itself";
    }
    EXPECT_EQ(dPredictiveSpaceRecord(space, nullptr, 0), 1);
    EXPECT_EQ(functions(), before);
    Recorded other;
    other.collide(space);
    dSpaceDestroy(space); // while it has a listener
    EXPECT_TRUE(other.recorder().close());
}
} // namespace
} // namespace ode_predictive_space::recording
