#include <cmath>
#include <limits>

#include <ode_predictive_space/predictive_space.hpp>

#include "tests/contract/support/scenario.h"
#include "tests/shape/polyhedron_geom.h"

namespace ode_predictive_space
{
namespace
{
class ShapeProximity : public OdeTest
{
protected:
    ShapeProximity()
    {
        dPredictiveSpaceSetProximity(space, dPredictiveProximityShape);
        // New geoms are then predicted at once, not swept.
        dPredictiveEncounter none;
        const dGeomID first = dCreateSphere(space, 1);
        dPredictiveSpaceGetEncounters(space, first, &none, 1);
        dGeomDestroy(first);
    }
    ~ShapeProximity() override { dSpaceDestroy(space); }

    // Two primitives are tested by box, unless the program has made one of them interactive.
    dGeomID by_shape(dGeomID geom)
    {
        dPredictiveSpaceSetGeomRole(space, geom, dPredictiveRoleInteractive);
        return geom;
    }

    dGeomID ball(dReal x, dReal y)
    {
        const dGeomID geom = by_shape(dCreateSphere(space, 1));
        dGeomSetPosition(geom, x, y, 0);
        return geom;
    }

    std::size_t pairs()
    {
        const std::size_t count = collide(space).size();
        EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
        return count;
    }

    unsigned long bytes() const
    {
        dPredictiveSpaceStats stats;
        dPredictiveSpaceGetStats(space, &stats);
        return stats.bytes;
    }

    dPredictiveSpaceCounters counters() const
    {
        dPredictiveSpaceCounters counters;
        dPredictiveSpaceGetCounters(space, &counters, sizeof counters);
        return counters;
    }

    void let_rest()
    {
        for (int i = 0; i < 100; ++i)
            pairs();
    }

    // The boxes of balls of radius 1 overlap, but the balls are 0.26 apart.
    static constexpr dReal apart = REAL(1.6);

    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
};

TEST_F(ShapeProximity, LeavesOutPairsWhoseBoxesAloneOverlap)
{
    ball(0, 0);
    const dGeomID other = ball(apart, apart);
    EXPECT_EQ(pairs(), 0u);
    EXPECT_EQ(counters().postponed, 1u);
    EXPECT_EQ(counters().gap_checks, 1u);
    dGeomSetPosition(other, REAL(1.4), REAL(1.4), 0);
    EXPECT_EQ(pairs(), 1u);
    EXPECT_EQ(counters().postponed, 0u);
}

// ODE then uses the box of the mesh, which is still that of the old corners.
TEST_F(ShapeProximity, JudgesMeshesChangedInPlaceByBoxesBesideHeightfields)
{
    const double flat[4] = {};
    const dHeightfieldDataID heights = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildDouble(heights, flat, 0, 2, 2, 2, 2, 1, 0, 1, 0);
    const dGeomID ground = dCreateHeightfield(space, heights, 0);
    MeshArrays cube(Polyhedron::cube().changed(Eigen::Vector3d::Constant(0.2), {0, 0, 0}));
    const dGeomID mesh = dCreateTriMesh(space, cube.id(), nullptr, nullptr, nullptr);
    dGeomSetPosition(mesh, 0, REAL(-0.4), REAL(1.1));
    cube.move_corners({0, 0, 0.3});
    dContactGeom contact;
    EXPECT_GT(dCollide(ground, mesh, 1, &contact, sizeof contact), 0) << "beside the ground's edge";
    EXPECT_EQ(pairs(), 1u);
    dGeomDestroy(ground);
    dGeomHeightfieldDataDestroy(heights);
}

// Such a mesh gives a capsule contacts with triangles that it no longer reaches.
TEST_F(ShapeProximity, JudgesCapsulesByBoxesBesideMeshesThatKeepTheirTriangles)
{
    const MeshArrays cube(Polyhedron::cube());
    const dGeomID mesh = dCreateTriMesh(space, cube.id(), nullptr, nullptr, nullptr);
    const dGeomID capsule = dCreateCapsule(space, REAL(0.1), 2);
    dMatrix3 along_edge;
    dRFromAxisAndAngle(along_edge, 1, 1, 0, static_cast<dReal>(M_PI_2));
    dGeomSetRotation(capsule, along_edge);
    dGeomSetPosition(capsule, REAL(1.7), REAL(1.7), 0);
    EXPECT_EQ(pairs(), 0u) << "the boxes alone overlap";
    dGeomDestroy(mesh);
    const dGeomID coherent = dCreateTriMesh(space, cube.id(), nullptr, nullptr, nullptr);
    dGeomTriMeshEnableTC(coherent, dBoxClass, 1);
    EXPECT_EQ(pairs(), 1u);
    dGeomTriMeshClearTCCache(coherent); // ODE would not free the kept triangles
    dGeomDestroy(coherent);
}

TEST_F(ShapeProximity, SeesAGapAlongTheNormalOfATriangle)
{
    Polyhedron sheets = Polyhedron::square().changed({1, 1, 1}, {0, 0, 1});
    sheets.add(Polyhedron::square().changed({3, 3, 1}, {0, 0, 4}));
    const MeshArrays arrays(sheets);
    const dGeomID mesh = dCreateTriMesh(space, arrays.id(), nullptr, nullptr, nullptr);
    const dGeomID capsule = dCreateCapsule(space, REAL(0.1), 3);
    dQuaternion lying, rolled, flat, tilted, both;
    dQFromAxisAndAngle(lying, 0, 1, 0, static_cast<dReal>(M_PI_2));
    dQFromAxisAndAngle(rolled, 0, 0, 1, 1); // so that its axes are not the normal
    dQMultiply0(flat, lying, rolled);
    dQFromAxisAndAngle(tilted, 1, 1, 0, REAL(0.6)); // so that the boxes overlap
    dQMultiply0(both, tilted, flat);
    dGeomSetQuaternion(mesh, tilted);
    dGeomSetQuaternion(capsule, both);
    const dReal *R = dGeomGetRotation(mesh);
    for (const bool touches : {false, true})
    {
        const dVector3 place = {2, 0,
                                touches ? REAL(1.098) : REAL(1.102)}; // its middle is beside the sheet, an end above it
        dVector3 turned;
        dMultiply0_331(turned, R, place);
        dGeomSetPosition(capsule, turned[0], turned[1], turned[2]);
        EXPECT_EQ(pairs(), touches ? 1u : 0u);
    }
    dGeomDestroy(mesh);
}

// In between, gap tests of primitives are given up and tried again.
TEST_F(ShapeProximity, ReportsWhatComesToRestBeforeItIsLookedAtAgain)
{
    std::vector<dGeomID> row, others;
    for (int i = 0; i < 60; ++i) // they touch at their ends, so that gap tests do not pay
    {
        row.push_back(dCreateBox(space, 4, 1, 1));
        dGeomSetPosition(row.back(), dReal(3.9) * i, 0, 0);
    }
    const MeshArrays tetrahedron(Polyhedron::tetrahedron());
    const dGeomID mesh = dCreateTriMesh(space, tetrahedron.id(), nullptr, nullptr, nullptr); // it is always tested
    dGeomSetPosition(mesh, 0, -50, 0);
    row.push_back(ball(0, -51));
    for (int i = 0; i < 4; ++i)
    {
        ball(0, dReal(50 + 10 * i));
        others.push_back(ball(dReal(1.9), dReal(51.9 + 10 * i))); // the boxes overlap, the balls do not
    }
    const auto wiggle = [](const std::vector<dGeomID> &geoms, int tick) {
        for (const dGeomID geom : geoms)
        {
            const dReal *place = dGeomGetPosition(geom);
            dGeomSetPosition(geom, place[0] + (tick % 2 ? 1e-4 : -1e-4), place[1], place[2]);
        }
    };
    constexpr int nearer = 100, still = 2070, end = 2200;
    for (int tick = 0; tick < end; ++tick)
    {
        wiggle(row, tick);
        if (tick < still)
            wiggle(others, tick);
        if (tick == nearer)
            for (std::size_t i = 0; i < others.size(); ++i)
                dGeomSetPosition(others[i], 1, dReal(50.5 + 10 * static_cast<double>(i)), 0);
        const std::size_t reported = collide(space).size();
        if (tick > nearer)
        {
            ASSERT_EQ(reported, 59u + 1 + others.size()) << "tick " << tick;
        }
    }
    dGeomDestroy(mesh);
}

TEST_F(ShapeProximity, ReportsAPairThatComesWithinTheMarginAtThatTick)
{
    // With this deviation the motion keeps to its prediction, and the pair stays the same.
    for (int role : {dPredictiveRoleEnvironment, dPredictiveRoleInteractive})
        dPredictiveSpaceSetDeviation(space, role, 2, 0, 0);
    dPredictiveSpaceSetShapeMargin(space, REAL(0.2));
    ball(0, 0);
    const dGeomID other = ball(apart, apart);
    for (dReal place = apart; place > REAL(1.5); place -= REAL(0.002))
    {
        dGeomSetPosition(other, place, place, 0);
        const dReal gap = std::sqrt(2 * place * place) - 2;
        const std::size_t count = pairs();
        ASSERT_GE(count, gap <= REAL(0.2) ? 1u : 0u) << "at a gap of " << gap;
        ASSERT_LE(count, gap <= REAL(0.21) ? 1u : 0u) << "at a gap of " << gap;
    }
}

TEST_F(ShapeProximity, OfAPairAtRestFollowsTheMargin)
{
    ball(0, 0);
    ball(apart, apart);
    let_rest();
    EXPECT_EQ(pairs(), 0u);
    dPredictiveSpaceStats stats;
    dPredictiveSpaceGetStats(space, &stats);
    EXPECT_EQ(stats.near_pairs, 1u);
    EXPECT_EQ(stats.scheduled, 1u);
    EXPECT_EQ(counters().postponed, 0u) << "it rests";
    dPredictiveSpaceSetShapeMargin(space, REAL(0.3));
    EXPECT_EQ(pairs(), 1u);
    let_rest();
    dPredictiveSpaceSetShapeMargin(space, 0);
    EXPECT_EQ(pairs(), 0u);
}

// A question brings the space up to date before the tick.
TEST_F(ShapeProximity, OfAPairAtRestFollowsTheSettingsAlsoAfterAQuestion)
{
    const dGeomID one = ball(0, 0);
    ball(apart, apart);
    const auto pairs_after_a_question = [&] {
        dPredictiveSpaceGetEncounters(space, one, nullptr, 0);
        return pairs();
    };
    let_rest();
    dPredictiveSpaceSetShapeMargin(space, REAL(0.3));
    EXPECT_EQ(pairs_after_a_question(), 1u);
    dPredictiveSpaceSetProximity(space, dPredictiveProximityBox);
    dPredictiveSpaceSetShapeMargin(space, 0);
    let_rest();
    dPredictiveSpaceSetProximity(space, dPredictiveProximityShape);
    EXPECT_EQ(pairs_after_a_question(), 0u);
}

TEST_F(ShapeProximity, QuestionsAreAboutContact)
{
    const dGeomID one = ball(0, 0), other = ball(apart, apart);
    pairs();
    dReal ticks = -1;
    const bool meet = dPredictiveSpaceGetTimeOfProximity(space, one, other, &ticks) != 0;
    EXPECT_TRUE(!meet || ticks >= 1) << "their boxes alone overlap";
    dGeomSetPosition(other, REAL(1.4), REAL(1.4), 0);
    EXPECT_EQ(dPredictiveSpaceGetTimeOfProximity(space, one, other, &ticks), 1);
    EXPECT_EQ(ticks, 0);
    dPredictiveEncounter met;
    EXPECT_EQ(dPredictiveSpaceGetEncounters(space, one, &met, 1), 1);
    EXPECT_EQ(met.ticks, 0);
    dPredictiveSpaceSetProximity(space, dPredictiveProximityBox);
    dGeomSetPosition(other, apart, apart, 0);
    EXPECT_EQ(dPredictiveSpaceGetTimeOfProximity(space, one, other, &ticks), 1);
    EXPECT_EQ(ticks, 0);
}

TEST_F(ShapeProximity, GivesTheMemoryOfShapesBack)
{
    std::vector<dGeomID> boxes;
    for (int i = 0; i < 3000; ++i)
    {
        boxes.push_back(dCreateBox(space, 1, 1, 1));
        dGeomSetPosition(boxes.back(), REAL(0.9) * static_cast<dReal>(i % 60), REAL(0.9) * static_cast<dReal>(i / 60),
                         0);
    }
    pairs();
    const unsigned long before = bytes();
    for (; boxes.size() > 5; boxes.pop_back())
        dGeomDestroy(boxes.back());
    pairs();
    EXPECT_LT(bytes(), before / 20);
}

// Once, a postponed pair was tested by its old gap until the next report, which validation took for a fault of the space.
TEST_F(ShapeProximity, IsValidWhenAGeomHasGrownSinceTheLastReport)
{
    for (int role : {dPredictiveRoleEnvironment, dPredictiveRoleInteractive})
        dPredictiveSpaceSetDeviation(space, role, 1, 0, 0);
    const dGeomID other = ball(REAL(1.8), REAL(1.8)), box = dCreateBox(space, 2, 2, 2);
    for (bool at_rest : {false, true})
    {
        dGeomBoxSetLengths(box, 2, 2, 2);
        for (int i = 0; i < 100; ++i)
        {
            if (!at_rest)
                dGeomSetPosition(box, REAL(-0.0001) * i, 0, 0);
            pairs();
        }
        EXPECT_EQ(pairs(), 0u) << at_rest;
        dGeomBoxSetLengths(box, REAL(2.4), REAL(2.4), REAL(2.4));
        dContactGeom contact;
        ASSERT_GT(dCollide(box, other, 1, &contact, sizeof contact), 0);
        EXPECT_EQ(dPredictiveSpaceValidate(space), 1) << at_rest;
        EXPECT_EQ(pairs(), 1u) << at_rest;
    }
}

TEST_F(ShapeProximity, NoticesThatOneOfTwoSizesGrows)
{
    ball(0, 0);
    for (const bool is_capsule : {true, false})
        for (const bool longer : {true, false})
        {
            const dGeomID rod = (is_capsule ? dCreateCapsule : dCreateCylinder)(space, REAL(0.2), 1);
            const dReal beside = longer ? REAL(0.8) : REAL(0.9);
            dGeomSetPosition(rod, beside, beside, longer ? 1 : 0);
            EXPECT_EQ(pairs(), 0u) << is_capsule << longer;
            (is_capsule ? dGeomCapsuleSetParams : dGeomCylinderSetParams)(rod, longer ? REAL(0.2) : REAL(0.3),
                                                                          longer ? 2 : 1);
            EXPECT_EQ(pairs(), 1u) << is_capsule << longer;
            dGeomDestroy(rod);
        }
}

TEST_F(ShapeProximity, NoticesThatAPlaneTurnsFarAway)
{
    const dGeomID plane = dCreatePlane(space, REAL(0.0001), 0, 1, 0);
    dGeomSetPosition(by_shape(dCreateSphere(space, 1)), 1000, 0, REAL(1.2));
    EXPECT_EQ(pairs(), 0u);
    EXPECT_EQ(counters().postponed, 1u);
    dGeomPlaneSetParams(plane, REAL(-0.0003), 0, 1, 0);
    EXPECT_EQ(pairs(), 1u);
}

TEST_F(ShapeProximity, ReportsPairsWithinAThousandthOfTheirSize)
{
    ball(0, 0);
    const dGeomID other = ball(0, REAL(2.0015));
    EXPECT_EQ(pairs(), 0u) << "the boxes are apart";
    const double oblique = std::sqrt(0.5);
    dGeomSetPosition(other, static_cast<dReal>(2.0015 * oblique), static_cast<dReal>(2.0015 * oblique), 0);
    EXPECT_EQ(pairs(), 1u);
    dGeomSetPosition(other, static_cast<dReal>(2.0025 * oblique), static_cast<dReal>(2.0025 * oblique), 0);
    // A pair without a gap is tested again after some reports.
    for (int i = 0; i < 20; ++i)
        pairs();
    EXPECT_EQ(pairs(), 0u);
}

TEST_F(ShapeProximity, GoesByBoxesForOtherGeoms)
{
    ball(0, 0);
    const dGeomID ray = dCreateRay(space, 1);
    dGeomRaySet(ray, REAL(0.9), REAL(0.9), REAL(0.9), 0, 0, 1);
    EXPECT_EQ(pairs(), 1u);
    dGeomDestroy(ray);
    const dGeomID skewed = dCreateBox(space, 2, 2, 2);
    dGeomSetPosition(skewed, apart, apart, 0);
    EXPECT_EQ(pairs(), 1u) << "the box and the ball touch";
    dGeomSetPosition(skewed, REAL(1.9), REAL(1.9), 0);
    EXPECT_EQ(pairs(), 0u);
    const dMatrix3 no_rotation{1, 0, 0, 0, REAL(0.1), 1, 0, 0, 0, 0, 1, 0};
    dGeomSetRotation(skewed, no_rotation);
    EXPECT_EQ(pairs(), 1u);
}

TEST_F(ShapeProximity, OfPlacesThatAreNotNumbersIsThatOfBoxes)
{
    const dReal nan = std::numeric_limits<dReal>::quiet_NaN();
    ball(0, 0);
    const dGeomID other = ball(apart, apart);
    EXPECT_EQ(pairs(), 0u);
    dGeomSetPosition(other, nan, nan, nan);
    collide(space);
    dGeomSetPosition(other, apart, apart, 0);
    EXPECT_EQ(pairs(), 0u);
    dGeomSetPosition(other, 1, 1, 0);
    EXPECT_EQ(pairs(), 1u);
}

TEST_F(ShapeProximity, NoticesOtherDataOfAMeshAlsoAfterTheSpaceWasCleaned)
{
    MeshArrays corner({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}});
    const dGeomID mesh = dCreateTriMesh(space, corner.id(), nullptr, nullptr, nullptr);
    dGeomSetPosition(dCreateSphere(space, REAL(0.1)), REAL(0.85), REAL(0.85), REAL(0.85));
    for (int tick = 0; tick < 5; ++tick)
        EXPECT_EQ(pairs(), 0u);
    corner.move_corners({0.55, 0.55, 0.55}); // its slanted face meets the ball
    dGeomTriMeshSetData(mesh, corner.id());
    dSpaceClean(space);
    EXPECT_EQ(pairs(), 1u);
    dGeomDestroy(mesh);
}

// Far from the origin, each step is below single precision; the pair has come to rest before, or is new.
TEST_F(ShapeProximity, NoticesThatAGeomCreepsFarFromTheOrigin)
{
    if (sizeof(dReal) < sizeof(double))
        return; // ODE itself cannot distinguish the steps from no motion
    int contacts = 0;
    for (const int ticks_at_rest : {0, 1, 2, 3, 8, 64, 100})
        for (const dReal step : {REAL(1e-3), REAL(2e-4)})
        {
            constexpr dReal far = 1e6;
            const dGeomID still = ball(far, 0), creeps = ball(far + 2, 0);
            const dReal gap = 20 * step, side = REAL(1.5);
            const dReal along = std::sqrt((2 + gap) * (2 + gap) - side * side);
            const auto creep_to = [&](int tick) { dGeomSetPosition(creeps, far + along - step * tick, side, 0); };
            creep_to(0);
            for (int tick = 0; tick < ticks_at_rest; ++tick)
                EXPECT_EQ(pairs(), 0u);
            for (int tick = 1; tick < 60; ++tick)
            {
                creep_to(tick);
                dContactGeom contact;
                const bool touches = dCollide(still, creeps, 1, &contact, sizeof contact) > 0;
                contacts += touches;
                const std::size_t reported = pairs();
                ASSERT_TRUE(reported == 1 || !touches) << "tick " << tick << " after a rest of " << ticks_at_rest;
            }
            dGeomDestroy(still);
            dGeomDestroy(creeps);
        }
    EXPECT_GT(contacts, 0);
}
} // namespace
} // namespace ode_predictive_space
