// Geoms at an offset from their body, as in robots: their places follow the body's pose, and may change with the offset.

#include <cmath>
#include <functional>
#include <vector>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Offset = OdeTest;

constexpr dReal carried_at = 0.4;

dGeomID carried_cube(Scenario &scene)
{
    dGeomID cube = scene.box(1, 0, 0, 0);
    const dBodyID body = scene.body(cube, 0, 0, 0);
    dGeomSetOffsetPosition(cube, carried_at, 0, 0);
    for (int i = 0; i < 20; ++i)
        scene.sphere(0.1, 20 + i, 0, 0);
    scene.sphere(0.1, 20, 0.05, 0);
    for (int tick = 0; tick < 20; ++tick)
    {
        dBodySetPosition(body, 0.0001 * tick, 0, 0);
        scene.tick();
    }
    return cube;
}

void move_on(Scenario &scene, dGeomID geom)
{
    for (int tick = 0; tick < 20; ++tick)
    {
        dBodySetPosition(dGeomGetBody(geom), 0.002 + 0.0001 * tick, 0, 0);
        scene.tick();
    }
}

void turn_row(dBodyID body)
{
    const dReal third = 1 / std::sqrt(REAL(3.0)), half = 1 / std::sqrt(REAL(2.0)), sixth = 1 / std::sqrt(REAL(6.0));
    const dMatrix3 turned = {third, third, third, 0, half, -half, 0, 0, sixth, sixth, -2 * sixth, 0};
    dBodySetRotation(body, turned);
}

TEST_F(Offset, AGeomCirclesAroundABodyThatStays)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID geom = scene.sphere(0.2, 0, 0, 0);
        const dBodyID body = scene.body(geom, 0, 0, 0);
        dGeomSetOffsetPosition(geom, 3, 0, 0);
        for (int i = 0; i < 24; ++i)
            scene.sphere(0.15, 3.3 * std::cos(0.7 + i / 4.0), 3.3 * std::sin(0.7 + i / 4.0), 0);
        dBodySetAngularVel(body, 0, 0, 1);
        for (int tick = 0; tick < 800; ++tick)
        {
            scene.step(0.01);
            scene.tick();
        }
    });
}

TEST_F(Offset, ABodyWhoseMatrixIsMadeNoRotation)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID cube = carried_cube(scene);
        scene.sphere(0.3, carried_at, 1.6, 0); // only a stretched cube reaches it
        move_on(scene, cube);
        const dMatrix3 stretched = {1, 0, 0, 0, 0.2, 3, 1, 0, 0, 0, 1, 0};
        dBodySetRotation(dGeomGetBody(cube), stretched);
        move_on(scene, cube);
    });
}

TEST_F(Offset, AMatrixOfTheOffsetThatIsMadeNoRotation)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID cube = carried_cube(scene);
        scene.sphere(0.3, carried_at, 1.6, 0);
        move_on(scene, cube);
        const dMatrix3 stretched = {1, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1, 0};
        dGeomSetOffsetRotation(cube, stretched);
        move_on(scene, cube);
    });
}

// No row of either matrix is longer than 1, but rows of their product are.
TEST_F(Offset, AMatrixOfTheOffsetWhoseRowsAreTheSame)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID cube = carried_cube(scene);
        turn_row(dGeomGetBody(cube));
        scene.sphere(0.3, 1.7, 0, 0);
        move_on(scene, cube);
        const dReal third = 1 / std::sqrt(REAL(3.0));
        const dMatrix3 flat = {third, third, third, 0, third, third, third, 0, third, third, third, 0};
        dGeomSetOffsetRotation(cube, flat);
        move_on(scene, cube);
    });
}

TEST_F(Offset, AnOffsetThatChangesWithoutAMoveOfTheBody)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID cube = carried_cube(scene);
        scene.sphere(0.3, 0, 5, 0);
        for (int tick = 0; tick < 200; ++tick)
        {
            dGeomSetOffsetPosition(cube, carried_at, 0.03 * tick, 0);
            if (tick % 50 == 20)
                dGeomClearOffset(cube);
            scene.tick();
        }
    });
}

// ODE keeps the mark that the pose has to be computed from an offset.
TEST_F(Offset, AGeomThatGoesToAnotherBodyAfterItsOwnHasMoved)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID cube = carried_cube(scene);
        scene.sphere(0.3, 0, 5, 0);
        const dBodyID bodies[] = {dGeomGetBody(cube), dBodyCreate(scene.world())};
        for (int tick = 0; tick < 40; ++tick)
        {
            dBodySetPosition(bodies[0], 0.03 * tick, 0, 0);
            dBodySetPosition(bodies[1], 0, 0.2 * tick, 0);
            if (tick % 8 == 5)
            {
                dGeomSetBody(cube, bodies[tick / 8 % 2]);
                dGeomSetOffsetPosition(cube, carried_at, 0, 0);
            }
            scene.tick();
        }
    });
}

// After a collide of ODE's own spaces the pose is computed. Here it was not, and ODE stopped at an assertion.
TEST_F(Offset, AGeomThatLosesItsOffsetWithItsBodyAfterATick)
{
    for (const bool is_taken_out : {false, true})
        expect_as_simple([is_taken_out](Scenario &scene) {
            for (int i = 0; i < 20; ++i)
                scene.sphere(1, 1.5 * i, 0, 0);
            const dGeomID ball = scene.sphere(1, 0, 0, 0);
            const dBodyID body = scene.body(ball, 0, 10, 0), other = dBodyCreate(scene.world());
            dGeomSetOffsetPosition(ball, REAL(0.3), 0, 0);
            for (int tick = 0; tick < 3; ++tick)
            {
                dBodySetPosition(body, REAL(0.5) * dReal(tick), 10, 0);
                scene.tick();
            }
            if (is_taken_out)
                dSpaceRemove(scene.space(), ball);
            dGeomSetBody(ball, other);
            if (is_taken_out)
                dSpaceAdd(scene.space(), ball);
            scene.tick();
        });
}

// The body is so far away that single precision loses metres of the sum of its place and the offset.
TEST_F(Offset, ALongOffsetLeadsBackToTheOthers)
{
    const dReal far = sizeof(dReal) == sizeof(double) ? 1e8 : 1e4;
    expect_as_simple([far](Scenario &scene) {
        std::vector<dBodyID> bodies;
        for (int i = 0; i < 20; ++i)
        {
            bodies.push_back(scene.body(scene.sphere(0.5, 0, 0, 0), 0, 0, 0));
            dGeomSetOffsetPosition(dBodyGetFirstGeom(bodies.back()), far, 0, 0);
        }
        for (int tick = 0; tick < 300; ++tick)
        {
            for (std::size_t i = 0; i < bodies.size(); ++i)
                dBodySetPosition(bodies[i], static_cast<dReal>(2 * i) + (i % 2 ? 0.01 : -0.01) * tick - far, 0, 0);
            scene.tick();
        }
    });
}

// The offset grows and the body moves back, so that the geom hardly moves: no single change leads out of its envelope.
TEST_F(Offset, ALongOffsetThatHasGrownInSmallSteps)
{
    const dReal far = sizeof(dReal) == sizeof(double) ? 1e8 : 1e4, envelope = 1003, step = 500;
    dWorldID world = dWorldCreate();
    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    dPredictiveSpaceSetDeviation(space, dPredictiveRoleEnvironment, envelope, 0, 0);
    for (int i = 0; i < 20; ++i)
        dGeomSetPosition(dCreateSphere(space, 1), 10 * envelope * (i + 1), 0, 0);
    dGeomID geom = dCreateSphere(space, 1);
    const dBodyID body = dBodyCreate(world);
    dGeomSetBody(geom, body);
    dGeomSetOffsetPosition(geom, step, 0, 0);
    dBodySetPosition(body, -step, 0, 0);
    EXPECT_TRUE(collide(space).empty());
    for (dReal offset = step; offset < far; offset += step)
    {
        dGeomSetOffsetPosition(geom, offset + step, 0, 0);
        dBodySetPosition(body, -offset - step, 0, 0);
    }
    // Single precision shows each of these steps. The last one is too short to leave the envelope, as far as it shows.
    constexpr int steps = 111;
    for (int i = 1; i <= steps; ++i)
    {
        dBodySetPosition(body, -far + i * REAL(1003.5) / steps, 0, 0);
        ASSERT_EQ(dPredictiveSpaceValidate(space), 1) << i;
    }
    dSpaceDestroy(space);
    dWorldDestroy(world);
}

TEST_F(Offset, AnOffsetBeyondAnyPrecision)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID cube = carried_cube(scene);
        for (const dReal offset : {REAL(1e16), sizeof(dReal) == sizeof(double) ? REAL(1e200) : REAL(1e30), REAL(0.0)})
        {
            dGeomSetOffsetPosition(cube, offset, 0, 0);
            move_on(scene, cube);
        }
    });
}

// At these places, single precision rounds the place of the geom in one direction, and the sum of body and offset in the other.
// No notice comes between a leap, which brings a new envelope, and the growth.
TEST_F(Offset, AGeomThatGrowsAndDoesNothingElse)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID cube = carried_cube(scene);
        const dBodyID body = dGeomGetBody(cube);
        dGeomSetOffsetPosition(cube, REAL(0.1234567), REAL(0.7654321), REAL(0.3333333));
        for (int i = 0; i < 20; ++i)
        {
            const dReal x = i * REAL(7.7777777);
            scene.sphere(0.3, x, 25, 0); // only a grown cube reaches it
            for (const dReal y : {REAL(15.1111111), REAL(22.2222222)})
            {
                dBodySetPosition(body, x, y, REAL(0.3333333));
                scene.tick();
            }
            dGeomBoxSetLengths(cube, 1, 9, 9);
            scene.tick();
            dGeomBoxSetLengths(cube, 1, 1, 1);
            scene.tick();
        }
    });
}

// ODE sends no notice of the loss.
TEST_F(Offset, AGeomThatLosesItsBodyAndGrows)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID cube = carried_cube(scene);
        dGeomSetOffsetPosition(cube, REAL(0.1234567), REAL(0.7654321), REAL(0.3333333));
        scene.sphere(0.3, 0, 5, 0);
        move_on(scene, cube);
        dGeomSetBody(cube, nullptr);
        dGeomBoxSetLengths(cube, 1, 9, 9);
        scene.tick();
    });
}

unsigned long unchanged(dSpaceID space)
{
    dPredictiveSpaceCounters counters;
    dPredictiveSpaceGetCounters(space, &counters, sizeof counters);
    return counters.unchanged;
}

TEST_F(Offset, ABodyThatIsSetWhereItIsMovesNoGeom)
{
    const std::vector<std::function<dGeomID(dSpaceID)>> classes{
        [](dSpaceID space) { return dCreateSphere(space, 0.5); },
        [](dSpaceID space) { return dCreateBox(space, 1, 1, 1); },
        [](dSpaceID space) { return dCreateCapsule(space, 0.3, 0.6); }};
    for (const dReal gap : {REAL(0.7), REAL(5.0)})
    {
        dWorldID world = dWorldCreate();
        dSpaceID space = dPredictiveSpaceCreate(nullptr);
        std::vector<dBodyID> bodies;
        for (int i = 0; i < 24; ++i)
        {
            dGeomID geom = classes[static_cast<std::size_t>(i) % classes.size()](space);
            bodies.push_back(dBodyCreate(world));
            dGeomSetBody(geom, bodies.back());
            dGeomSetOffsetPosition(geom, 0.25, 0.125, 0);
            dMatrix3 turned;
            dRFromAxisAndAngle(turned, 1, 2, i, i % 2);
            dGeomSetOffsetRotation(geom, turned);
            dBodySetPosition(bodies.back(), gap * i, 0, 0);
        }
        const auto set_all_and_collide = [&] {
            for (dBodyID body : bodies)
            {
                const dReal *position = dBodyGetPosition(body);
                dBodySetPosition(body, position[0], position[1], position[2]);
            }
            collide(space);
        };
        for (int tick = 0; tick < 40; ++tick)
            set_all_and_collide();
        const unsigned long before = unchanged(space);
        for (int tick = 0; tick < 30; ++tick)
            set_all_and_collide();
        // Pairs without moves come to rest now and then, and the next notice of a resting object counts as a move.
        EXPECT_GE(unchanged(space) - before, 28 * bodies.size()) << gap;
        EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
        dSpaceDestroy(space);
        dWorldDestroy(world);
    }
}
} // namespace
} // namespace ode_predictive_space
