#include "demos/haptic/encounter_log.h"

#include "ode_predictive_space/haptics/hand_path.h"
#include "tests/haptics/support/probe_world.h"

#include <gtest/gtest.h>
#include <random>

namespace ode_predictive_space::demo
{
using namespace haptics;

namespace
{
class EncounterLogTest : public testing::Test
{
protected:
    std::vector<Touch> touching() const
    {
        Touch touch;
        touch.object = object_of(geom_);
        return {touch};
    }

    const OdeUse ode_;
    dGeomID geom_ = dCreateSphere(nullptr, 1);
    EncounterLog log_;

    ~EncounterLogTest() override { dGeomDestroy(geom_); }
};

TEST_F(EncounterLogTest, ComparesTheForecastWithTheContact)
{
    log_.add(1.0, {}, {});
    log_.add(2.0, {{geom_, 3.5}}, {});
    log_.add(3.0, {{geom_, 2.0}}, {}); // near at 5
    log_.add(5.0, {{geom_, 0.0}}, {});
    log_.add(6.0, {{geom_, 0.0}}, touching());
    log_.add(7.0, {{geom_, 0.0}}, touching());
    ASSERT_EQ(log_.contacts().size(), 1U) << "first contacts only";
    EXPECT_EQ(log_.contacts()[0].time, 6);
    EXPECT_EQ(log_.contacts()[0].warning, 4);
    EXPECT_EQ(log_.contacts()[0].forecast, 5);
    const EncounterSummary summary = log_.summary();
    EXPECT_EQ(summary.predicted, 1U);
    EXPECT_EQ(summary.late, 0U);
    EXPECT_EQ(summary.missed, 0U);
    EXPECT_EQ(summary.mean_early, 1);
    EXPECT_NE(summary.text().find("Of 1 first contacts, 1 were predicted"), std::string::npos) << summary.text();
}

TEST_F(EncounterLogTest, AContactBeforeItsForecastIsLate)
{
    log_.add(1.0, {{geom_, 5.0}}, {});
    log_.add(2.0, {{geom_, 0.0}}, touching());
    EXPECT_EQ(log_.summary().late, 1U);
    EXPECT_EQ(log_.summary().missed, 0U);
}

TEST_F(EncounterLogTest, AContactOfWhatIsNotNearIsMissed)
{
    log_.add(1.0, {}, touching());
    EXPECT_EQ(log_.summary().missed, 1U);
    EXPECT_EQ(log_.summary().predicted, 0U);
    log_.add(2.0, {}, {});
    log_.add(3.0, {{geom_, 1.0}}, touching());
    EXPECT_EQ(log_.summary().missed, 2U);
}

/// Encounters of a hand in a scene of tilted plates, sticks and balls.
///
/// @param near becomes the number of near encounters, summed over the ticks.
EncounterSummary meet_some(int proximity, const RenderSettings &settings, int &near)
{
    ProbeWorld world;
    dPredictiveSpaceSetProximity(world.space, proximity);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-0.15, 0.15);
    for (int i = 0; i < 400; ++i)
    {
        const Vector3 position(place(random), place(random), place(random));
        if (i % 2 != 0)
        {
            world.add_moving_box({0.02, 0.02, 0.02}, position, 0.2);
            continue;
        }
        const dGeomID geom =
            i % 4 == 0 ? world.add_box({0.04, 0.04, 0.004}, position) : dCreateCapsule(world.space, 0.003, 0.05);
        dGeomSetPosition(geom, position.x(), position.y(), position.z());
        dMatrix3 rotation;
        dRFromAxisAndAngle(rotation, place(random), place(random), place(random) + 0.2, 20 * place(random));
        dGeomSetRotation(geom, rotation);
    }
    HandPathDevice hand;
    HapticProbe probe(hand, world.space, 0.01, settings);
    EncounterLog log;
    near = 0;
    for (int tick = 0; tick < 6000; ++tick)
    {
        probe.begin(0.001 * tick);
        world.collide(probe);
        probe.render(0.001);
        log.add(0.001 * tick, probe);
        for (const Encounter &encounter : probe.encounters())
            near += encounter.seconds <= 0 ? 1 : 0;
        world.step(0.001);
    }
    return log.summary();
}

struct Meeting
{
    EncounterSummary summary;
    int near = 0; // near encounters, summed over the ticks
};

class EncountersInASceneTest : public testing::Test
{
protected:
    static Meeting meet_by(int proximity, const RenderSettings &settings)
    {
        Meeting meeting;
        meeting.summary = meet_some(proximity, settings, meeting.near);
        EXPECT_GT(meeting.summary.contacts, 20U) << meeting.summary.text();
        EXPECT_EQ(meeting.summary.missed, 0U) << meeting.summary.text();
        EXPECT_GE(10 * meeting.summary.predicted, 9 * meeting.summary.contacts) << meeting.summary.text();
        EXPECT_LE(10 * meeting.summary.late, meeting.summary.contacts) << meeting.summary.text();
        return meeting;
    }

    const OdeUse ode_;
};

TEST_F(EncountersInASceneTest, ByTheDefaultLawNothingIsMissedAndMostIsPredicted)
{
    meet_by(dPredictiveProximityBox, {});
    meet_by(dPredictiveProximityShape, {});
}

// With the proxy law the region that the probe checks is so large that most of it is in contact anyway.
TEST_F(EncountersInASceneTest, ByThePenaltyLawTooAndByShapesTheyAreAboutContact)
{
    const Meeting by_boxes = meet_by(dPredictiveProximityBox, with_stiffness(500));
    const Meeting by_shapes = meet_by(dPredictiveProximityShape, with_stiffness(500));
    EXPECT_EQ(by_shapes.summary.contacts, by_boxes.summary.contacts);
    EXPECT_LT(by_shapes.near, 0.5 * by_boxes.near);
    EXPECT_LT(by_shapes.summary.mean_early, 0.7 * by_boxes.summary.mean_early);
}
} // namespace
} // namespace ode_predictive_space::demo
