// Gap tests that save no reports are few, for any reason.

#include <cmath>

#include <ode_predictive_space/predictive_space.h>

#include "ode_predictive_space/broadphase/tuning.h"
#include "tests/contract/support/scenario.h"
#include "tests/shape/polyhedron_geom.h"

namespace ode_predictive_space
{
namespace
{
class GapCheckCost : public OdeTest
{
protected:
    GapCheckCost() { dPredictiveSpaceSetProximity(space, dPredictiveProximityShape); }
    ~GapCheckCost() override { dSpaceDestroy(space); }

    dGeomID create_mesh(const MeshArrays &arrays)
    {
        return dCreateTriMesh(space, arrays.id(), nullptr, nullptr, nullptr);
    }

    // The ball is beside the edge of a cube with sides of 2. It touches the cube by 0.005 unless the cube is turned.
    dGeomID create_ball()
    {
        const dGeomID ball = dCreateSphere(space, 1);
        dGeomSetPosition(ball, beside_edge, beside_edge, 0);
        return ball;
    }

    static void turn(dGeomID mesh, dReal angle)
    {
        dMatrix3 rotation;
        dRFromAxisAndAngle(rotation, 0, 0, 1, angle);
        dGeomSetRotation(mesh, rotation);
    }

    void turn_to_and_fro(dGeomID mesh, int ticks) const
    {
        for (int tick = 0; tick < ticks; ++tick)
        {
            turn(mesh, tick % 2 ? REAL(0.1) : REAL(-0.1));
            collide(space);
        }
    }

    unsigned long gap_checks() const
    {
        dPredictiveSpaceCounters counters;
        dPredictiveSpaceGetCounters(space, &counters, sizeof counters);
        return counters.gap_checks;
    }

    static constexpr dReal beside_edge = REAL(1.7035);
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
};

TEST_F(GapCheckCost, PairsOfWhichTheProgramIsNotToldAreNotLookedAt)
{
    const MeshArrays cube(Polyhedron::cube());
    const dGeomID mesh = create_mesh(cube), ball = create_ball();
    turn(mesh, REAL(0.1));
    dGeomSetCategoryBits(mesh, 1);
    dGeomSetCollideBits(mesh, 2);
    dGeomSetCategoryBits(ball, 1);
    dGeomSetCollideBits(ball, 2);
    for (int tick = 0; tick < 100; ++tick)
    {
        dGeomSetPosition(ball, beside_edge, beside_edge, tick % 2 ? REAL(1e-4) : REAL(-1e-4));
        EXPECT_EQ(collide(space).size(), 0u);
    }
    EXPECT_EQ(gap_checks(), 0u);
    dGeomSetCategoryBits(ball, 2);
    std::size_t reported = 0;
    for (int tick = 0; tick < 100; ++tick)
    {
        dGeomSetPosition(ball, beside_edge, beside_edge, tick % 2 ? REAL(1e-4) : REAL(-1e-4));
        reported += collide(space).size();
    }
    EXPECT_GT(gap_checks(), 0u) << "bits change without notice";
    EXPECT_LT(reported, 50u) << "the shapes are apart";
}

// Two octahedra whose boxes overlap. Only objects that move are tested against a landscape.
TEST_F(GapCheckCost, TwoMeshesThatHaveNotMovedAreNotLookedAt)
{
    const MeshArrays octahedron(Polyhedron::octahedron());
    create_mesh(octahedron);
    const dGeomID beside = create_mesh(octahedron);
    dGeomSetPosition(beside, REAL(1.5), REAL(1.5), 0);
    for (int tick = 0; tick < 100; ++tick)
        EXPECT_EQ(collide(space).size(), 1u);
    EXPECT_EQ(gap_checks(), 0u);
    for (dReal place : {REAL(5.0), REAL(1.5)})
    {
        dGeomSetPosition(beside, place, place, 0);
        EXPECT_EQ(collide(space).size(), 0u);
    }
    EXPECT_GT(gap_checks(), 0u);
}

TEST_F(GapCheckCost, AMeshOnABodyIsLookedAtBesideAnotherMesh)
{
    const MeshArrays octahedron(Polyhedron::octahedron());
    create_mesh(octahedron);
    const dGeomID carried = create_mesh(octahedron);
    const dWorldID world = dWorldCreate();
    const dBodyID body = dBodyCreate(world);
    dGeomSetBody(carried, body);
    dBodySetPosition(body, REAL(1.5), REAL(1.5), 0);
    EXPECT_EQ(collide(space).size(), 0u);
    dWorldDestroy(world);
}

// A test finds a gap, but at the next tick the mesh has turned farther than that.
TEST_F(GapCheckCost, BesideAMeshThatTurnsLooksAreGivenUp)
{
    const MeshArrays cube(Polyhedron::cube());
    const dGeomID mesh = create_mesh(cube);
    create_ball();
    constexpr int ticks = 1000;
    turn_to_and_fro(mesh, ticks);
    EXPECT_GT(gap_checks(), 0u);
    EXPECT_LT(gap_checks(), ticks / 10u);
}

// A geom that gets another role gets another envelope, and its pairs are new ones.
TEST_F(GapCheckCost, BesideAMeshLooksAreGivenUpAlsoWherePairsComeAndGo)
{
    const MeshArrays cube(Polyhedron::cube());
    const dGeomID mesh = create_mesh(cube), ball = create_ball();
    constexpr int ticks = 1000;
    for (int tick = 0; tick < ticks; ++tick)
    {
        dPredictiveSpaceSetGeomRole(space, ball, dPredictiveRoleEnvironment);
        turn_to_and_fro(mesh, 1);
    }
    EXPECT_LT(gap_checks(), ticks / 10u);
}

TEST_F(GapCheckCost, LooksThatSpareReportsGoOn)
{
    const MeshArrays cube(Polyhedron::cube());
    create_mesh(cube);
    const dGeomID ball = create_ball();
    std::size_t reported = 0;
    for (int tick = 0; tick < 3000; ++tick)
    {
        dGeomSetPosition(ball, REAL(1.8), REAL(1.8), tick % 2 ? REAL(0.004) : REAL(-0.004));
        reported += collide(space).size();
    }
    EXPECT_EQ(reported, 0u);
    EXPECT_GT(gap_checks(), 50u) << "the gap may have closed after some ticks";
}

// The ball is beside the edge of a long box; the centres are so far apart that the inscribed balls do not touch.
TEST_F(GapCheckCost, OfPairsThatTouchAreFewAndSoonTellThatTheyHaveParted)
{
    for (int role : {dPredictiveRoleEnvironment, dPredictiveRoleInteractive})
        dPredictiveSpaceSetDeviation(space, role, 1, 0, 0); // the pair stays the same
    dCreateBox(space, 1, 1, 10);
    const dGeomID ball = dCreateSphere(space, REAL(0.5));
    dPredictiveSpaceSetGeomRole(space, ball, dPredictiveRoleInteractive);
    const auto reported_at = [&](dReal place, int ticks) {
        std::size_t reported = 0;
        for (int tick = 0; tick < ticks; ++tick)
        {
            dGeomSetPosition(ball, place, place, tick % 2 ? REAL(1e-4) : REAL(-1e-4));
            reported += collide(space).size();
        }
        return reported;
    };
    constexpr dReal touching = REAL(0.83), apart = REAL(0.9);
    EXPECT_EQ(reported_at(touching, 300), 300u);
    EXPECT_GT(gap_checks(), 0u);
    EXPECT_LT(gap_checks(), 30u);
    EXPECT_LE(reported_at(apart, 50), tuning::reports_per_rest);
    EXPECT_EQ(reported_at(touching, 1), 1u);
    EXPECT_LE(reported_at(apart, 50), 2u) << "a pair that was apart is looked at again at once";
}

TEST_F(GapCheckCost, OfAMeshAreNotChargedToItsSuccessor)
{
    const MeshArrays cube(Polyhedron::cube());
    dGeomID mesh = create_mesh(cube);
    create_ball();
    turn_to_and_fro(mesh, 1000);
    dGeomDestroy(mesh);
    collide(space);
    mesh = create_mesh(cube);
    turn(mesh, REAL(0.1));
    EXPECT_EQ(collide(space).size(), 0u) << "the shapes are apart";
}

// As the mesh that turns above, until the two touch and come to rest, in any state of the account.
TEST_F(GapCheckCost, AGapThatHasClosedDoesNotCountAtRest)
{
    const MeshArrays cube(Polyhedron::cube());
    const dGeomID mesh = create_mesh(cube);
    create_ball();
    for (int turns = 1; turns <= 200; ++turns)
    {
        turn_to_and_fro(mesh, turns);
        turn(mesh, 0);
        for (int tick = 0; tick < 50; ++tick)
            ASSERT_EQ(collide(space).size(), 1u) << turns;
    }
}

TEST_F(GapCheckCost, DataThatChangeAtEachTickAreSeldomRead)
{
    MeshArrays cube(Polyhedron::cube());
    const dGeomID mesh = create_mesh(cube);
    create_ball();
    constexpr int ticks = 1000;
    std::size_t reported = 0;
    for (int tick = 0; tick < ticks; ++tick)
    {
        cube.move_corners({0, 0, tick % 2 ? 1e-3 : -1e-3});
        dPredictiveSpaceGeomChanged(space, mesh);
        reported += collide(space).size();
    }
    EXPECT_LT(gap_checks(), ticks / 10u);
    EXPECT_GT(reported, ticks / 2u) << "the pair is reported by its boxes";
}
} // namespace
} // namespace ode_predictive_space
