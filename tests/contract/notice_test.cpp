// Notices to the space, and changes without a notice: the cases in which a prediction can be wrong without a sign.

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Notice = OdeTest;

TEST_F(Notice, AGeomThatStopsWithoutASign)
{
    // Its velocity suggests further motion, but nothing moves it; another geom comes to where it stopped.
    expect_as_simple([](Scenario &scene) {
        dGeomID stopping = scene.sphere(0.5, 0, 0, 0);
        dBodyID body = scene.body(stopping, 10, 0, 0);
        dGeomID chaser = scene.sphere(0.5, -6, 0, 0);
        for (int tick = 0; tick < 600; ++tick)
        {
            if (tick < 100)
                dBodySetPosition(body, 0.01 * tick, 0, 0);
            dGeomSetPosition(chaser, -6 + 0.02 * tick, 0, 0);
            scene.tick();
        }
    });
}

TEST_F(Notice, AGeomThatGrowsAndMovesBetweenTwoTicks)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID growing = scene.sphere(0.5, 0, 0, 0);
        dBodyID body = scene.body(growing, 0.001, 0, 0);
        scene.sphere(0.5, 0, 3, 0);
        for (int tick = 0; tick < 400; ++tick)
        {
            const bool large = tick > 100 && tick % 40 < 20;
            if (tick % 3 == 0)
                dGeomSphereSetRadius(growing, large ? 2.6 : 0.5);
            dBodySetPosition(body, 0.001 * tick, 0, 0);
            if (tick % 3 == 1)
                dGeomSphereSetRadius(growing, large ? 2.7 : 0.5);
            if (tick % 5 == 0)
                dBodySetPosition(body, 0.001 * tick, 0, 0);
            scene.tick();
        }
    });
}

TEST_F(Notice, AGeomThatLeavesAndComesBackBetweenTwoTicks)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID jumping = scene.sphere(0.5, 0, 0, 0);
        dBodyID body = scene.body(jumping, 0, 0, 0);
        scene.sphere(0.5, 0.9, 0, 0);
        scene.sphere(0.5, 50, 0, 0);
        for (int tick = 0; tick < 200; ++tick)
        {
            dBodySetPosition(body, tick % 7 == 0 ? 0 : 50, 0, 0);
            if (tick % 2)
                dBodySetPosition(body, tick % 5 == 0 ? 50 : 0, 0, 0);
            scene.tick();
        }
    });
}

// The loss of the body sends no notice; afterwards the rotation can be any matrix.
TEST_F(Notice, AGeomThatLosesItsBodyAndIsStretched)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID box = scene.box(1, 0, 0, 0);
        scene.body(box, 0.01, 0, 0);
        scene.sphere(0.5, 0, 2.2, 0);
        for (int tick = 0; tick < 60; ++tick)
        {
            if (tick < 30)
                dBodySetPosition(dGeomGetBody(box), 0.0001 * tick, 0, 0);
            if (tick == 30)
                dGeomSetBody(box, 0);
            if (tick == 40)
            {
                const dMatrix3 stretched = {4, 0, 0, 0, 0, 4, 0, 0, 0, 0, 4, 0};
                dGeomSetRotation(box, stretched);
            }
            scene.tick();
        }
    });
}

// Out of reach for a unit cube in any orientation, but not for a stretched one.
constexpr dReal out_of_reach = 1.6;

dBodyID cube_beside_ball(Scenario &scene)
{
    const dBodyID body = scene.body(scene.box(1, 0, 0, 0), 0, 0, 0);
    scene.sphere(0.3, 0, out_of_reach, 0);
    for (int i = 0; i < 20; ++i)
        scene.sphere(0.1, 20 + i, 0, 0);
    for (int tick = 0; tick < 20; ++tick)
    {
        dBodySetPosition(body, 0.0001 * tick, 0, 0);
        scene.tick();
    }
    return body;
}

// Its rows are not orthogonal: ODE leaves the second one as it is.
void stretch(dBodyID body)
{
    const dMatrix3 stretched = {1, 0, 0, 0, 0.2, 3, 1, 0, 0, 0, 1, 0};
    dBodySetRotation(body, stretched);
}

void move_on(Scenario &scene, dBodyID body)
{
    for (int tick = 0; tick < 20; ++tick)
    {
        dBodySetPosition(body, 0.002 + 0.0001 * tick, 0, 0);
        scene.tick();
    }
}

TEST_F(Notice, ABodyWhoseMatrixIsMadeNoRotation)
{
    expect_as_simple([](Scenario &scene) {
        const dBodyID body = cube_beside_ball(scene);
        stretch(body);
        scene.tick();
        move_on(scene, body);
        dBodySetAngularVel(body, 0, 0, 1); // a step makes it a rotation again
        for (int tick = 0; tick < 20; ++tick)
        {
            scene.step(0.01);
            scene.tick();
        }
    });
}

TEST_F(Notice, ABodyThatIsStretchedAndMovedBeforeOneTick)
{
    expect_as_simple([](Scenario &scene) {
        const dBodyID body = cube_beside_ball(scene);
        stretch(body);
        move_on(scene, body);
    });
}

// dGeomRaySet() writes the third column of the matrix that all geoms of its body share; the others get no notice until the body
// moves. With a matrix that is no rotation, the box of a plate inside its envelope reaches a ball.
TEST_F(Notice, ARayThatChangesTheMatrixOfItsBody)
{
    for (const bool is_in_space : {true, false})
        expect_as_simple([is_in_space](Scenario &scene) {
            const dBodyID body = scene.body(scene.numbered(dCreateBox(scene.space(), 0.02, 1, 1)), 0, 0, 0);
            scene.sphere(0.3, 0, 0.95, 0);
            for (int i = 0; i < 20; ++i)
                scene.sphere(0.1, 20 + i, 0, 0);
            dGeomID ray = dCreateRay(is_in_space ? scene.space() : nullptr, 10);
            scene.numbered(ray);
            dGeomSetBody(ray, body);
            for (int tick = 0; tick < 100; ++tick)
            {
                const double height = tick < 30 ? 0.02 * tick - 0.9 : 0.0001 * (tick - 30) - 0.3;
                if (tick == 60)
                    dGeomRaySet(ray, 0, height, 0, 0, 1, 0);
                if (tick == 80 && !is_in_space)
                    dGeomSetBody(ray, nullptr); // its column stays
                dBodySetPosition(body, 0, height, 0);
                scene.tick();
            }
            dGeomDestroy(ray);
        });
}

TEST_F(Notice, AGeomThatGetsABodyWhoseMatrixIsNoRotation)
{
    expect_as_simple([](Scenario &scene) {
        const dBodyID body = cube_beside_ball(scene), other = dBodyCreate(scene.world());
        dBodySetPosition(other, 0.0021, 0, 0);
        stretch(other);
        dGeomSetBody(dBodyGetFirstGeom(body), other);
        scene.tick();
        move_on(scene, other);
    });
}

TEST_F(Notice, ABodyThatFallsAsleepWithItsVelocity)
{
    expect_as_simple([](Scenario &scene) {
        dBodyID sleeper = scene.body(scene.sphere(0.5, 0, 0, 0), 1, 0, 0);
        scene.body(scene.sphere(0.5, 12, 0, 0), -1, 0, 0);
        for (int tick = 0; tick < 1500; ++tick)
        {
            if (tick == 150)
                dBodyDisable(sleeper);
            if (tick == 1200)
                dBodyEnable(sleeper);
            scene.step(0.01);
            scene.tick();
        }
    });
}

TEST_F(Notice, SeveralTicksPerStepAndSeveralStepsPerTick)
{
    expect_as_simple([](Scenario &scene) {
        for (int i = 0; i < 8; ++i)
            scene.body(scene.sphere(0.5, 3 * i, 0.3 * i, 0), i % 2 ? -1 : 1, 0, 0);
        for (int round = 0; round < 300; ++round)
        {
            const int steps = round < 100 ? 1 : round < 200 ? round % 4 : 5;
            for (int step = 0; step < steps; ++step)
                scene.step(0.01);
            for (int tick = 0; tick <= round % 3; ++tick)
                scene.tick();
        }
    });
}

TEST_F(Notice, OnlySomeGeomsMoveInEachTick)
{
    expect_as_simple([](Scenario &scene) {
        std::vector<dBodyID> bodies;
        for (int i = 0; i < 10; ++i)
            bodies.push_back(scene.body(scene.box(0.5, i, 0, 0), 0.5, 0, 0));
        for (int tick = 0; tick < 600; ++tick)
        {
            const auto i = static_cast<std::size_t>(tick) % 10;
            const dReal *position = dBodyGetPosition(bodies[i]);
            dBodySetPosition(bodies[i], position[0] + (i % 2 ? 0.03 : -0.03), 0.001 * tick, 0);
            scene.tick();
        }
    });
}

TEST_F(Notice, TheStepSizeChanges)
{
    expect_as_simple([](Scenario &scene) {
        for (int i = 0; i < 12; ++i)
            scene.body(scene.sphere(0.3, 2 * i, 0.1 * i, 0), i % 2 ? -0.5 : 0.5, 0, 0);
        for (int tick = 0; tick < 400; ++tick)
        {
            scene.step(tick < 150 ? 0.001 : tick < 200 ? 0.1 : 0.005);
            scene.tick();
        }
    });
}

TEST_F(Notice, TimeStandsStillAndGoesOn)
{
    expect_as_simple([](Scenario &scene) {
        scene.body(scene.sphere(0.5, -5, 0, 0), 1, 0, 0);
        scene.body(scene.sphere(0.5, 5, 0, 0), -1, 0, 0);
        scene.sphere(0.5, 0, 0.9, 0);
        for (int tick = 0; tick < 1600; ++tick)
        {
            if (tick % 200 < 100)
                scene.step(0.01);
            scene.tick();
        }
    });
}

TEST_F(Notice, VelocitiesChangeWithoutASign)
{
    expect_as_simple([](Scenario &scene) {
        dBodyID body = scene.body(scene.sphere(0.5, 0, 5, 0), 0, -0.1, 0);
        for (int i = 0; i < 10; ++i)
            scene.sphere(0.5, 2 * i, 0, 0);
        for (int tick = 0; tick < 1000; ++tick)
        {
            if (tick % 250 == 249)
                dBodySetLinearVel(body, tick % 500 < 250 ? 5 : -4, tick % 500 < 250 ? -3 : 2, 0);
            scene.step(0.01);
            scene.tick();
        }
    });
}

TEST_F(Notice, BitsAndEnabledChangeWithoutASignInTheCalm)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID still = scene.box(1, 0, 0, 0);
        dGeomID other = scene.box(1, 0.5, 0, 0);
        dGeomSetCategoryBits(still, 0);
        dGeomSetCollideBits(still, 0);
        dGeomDisable(other);
        for (int tick = 0; tick < 300; ++tick)
        {
            if (tick == 100)
                dGeomEnable(other);
            if (tick == 200)
                dGeomSetCollideBits(still, 1);
            scene.tick();
        }
        EXPECT_EQ(scene.log().back().size(), 1u);
    });
}

TEST_F(Notice, AGeomGoesFromBodyToBodyAndToNone)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID rider = scene.sphere(0.5, 0, 0, 0);
        dBodyID bodies[] = {dBodyCreate(scene.world()), dBodyCreate(scene.world())};
        dBodySetPosition(bodies[1], 8, 0, 0);
        dBodySetLinearVel(bodies[0], 1, 0, 0);
        for (int i = 0; i < 10; ++i)
            scene.box(0.5, i, 0.2, 0);
        for (int tick = 0; tick < 300; ++tick)
        {
            if (tick % 30 == 10)
                dGeomSetBody(rider, bodies[tick / 30 % 2]);
            if (tick % 30 == 25)
                dGeomSetBody(rider, nullptr);
            scene.step(0.01);
            scene.tick();
        }
    });
}

TEST_F(Notice, ABodyGoesFromUnderItsGeom)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID rider = scene.sphere(0.5, 0, 0, 0);
        dBodyID body = scene.body(rider, 1, 0, 0);
        dGeomSetOffsetPosition(rider, 0, 1, 0);
        for (int i = 0; i < 10; ++i)
            scene.box(0.5, i, 0.8, 0);
        for (int tick = 0; tick < 300; ++tick)
        {
            if (tick == 150)
                dBodyDestroy(body);
            if (tick == 200)
                dGeomSetPosition(rider, 7, 1, 0);
            scene.step(0.02);
            scene.tick();
        }
    });
}

TEST_F(Notice, ABodyGoesFromUnderATurningGeom)
{
    expect_as_simple([](Scenario &scene) {
        for (GeomKind kind : {GeomKind::box, GeomKind::capsule, GeomKind::cylinder})
        {
            dGeomID rider = scene.numbered(create_geom(kind, 1, scene.space()));
            dBodyID body = scene.body(rider, 0.5, 0, 0);
            dBodySetAngularVel(body, 1, 2, 0);
            scene.box(0.5, 1, 0, 0);
            for (int tick = 0; tick < 120; ++tick)
            {
                if (tick == 60)
                    dBodyDestroy(body);
                if (tick > 90)
                    dGeomSetPosition(rider, 0.1 * tick - 9, 0, 0);
                scene.step(0.02);
                scene.tick();
            }
        }
    });
}

TEST_F(Notice, BoundsAreAskedForBetweenMoveAndTick)
{
    // dGeomGetAABB() and dSpaceCollide2() of two geoms update the bounds and clear the mark of the move.
    expect_as_simple([](Scenario &scene) {
        dGeomID mover = scene.sphere(0.5, 9, 0, 0);
        dGeomID post = scene.sphere(0.5, 0, 0, 0);
        for (int i = 1; i < 5; ++i)
            scene.sphere(0.5, i, 0, 0);
        for (int tick = 0; tick < 200; ++tick)
        {
            if (tick % 3 == 0)
                dGeomSetPosition(mover, tick % 2 ? 9 : 0.02 * tick, 0, 0);
            dReal aabb[6];
            if (tick % 4 < 2)
                dGeomGetAABB(mover, aabb);
            else if (tick % 4 == 2)
                dGeomGetAABB(as_geom(scene.space()), aabb);
            else
                scene.query(mover, post);
            scene.tick();
        }
    });
}

TEST_F(Notice, BoundsAreAskedForOfASmoothMover)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID mover = scene.sphere(0.5, -9, 0, 0);
        dGeomID carried = scene.sphere(0.5, -9, 0.5, 0);
        dBodyID body = scene.body(carried, 1, 0, 0);
        for (int i = 0; i < 5; ++i)
            scene.sphere(0.5, i, 0, 0);
        for (int tick = 0; tick < 900; ++tick)
        {
            dGeomSetPosition(mover, 0.02 * tick - 9, 0, 0);
            dBodySetPosition(body, tick < 300 ? 0.01 * tick - 9 : 0.04 * tick - 18, 0.5, 0);
            dReal aabb[6];
            dGeomGetAABB(mover, aabb);
            dGeomGetAABB(carried, aabb);
            scene.tick();
        }
    });
}

TEST_F(Notice, ASpaceIsCleanedBetweenMoveAndTick)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID mover = scene.sphere(0.5, 9, 0, 0);
        for (int i = 0; i < 5; ++i)
            scene.sphere(0.5, i, 0, 0);
        for (int tick = 0; tick < 200; ++tick)
        {
            dGeomSetPosition(mover, tick % 7 ? 0.02 * tick : 9, 0, 0);
            if (tick % 3)
                dSpaceClean(scene.space());
            if (tick % 5 == 0)
                dGeomSetPosition(mover, 4, 0.5, 0);
            scene.tick();
        }
    });
}

TEST_F(Notice, RemovedAndAddedAgainElsewhere)
{
    expect_as_simple([](Scenario &scene) {
        std::vector<dGeomID> geoms;
        for (int i = 0; i < 20; ++i)
        {
            geoms.push_back(scene.sphere(0.6, i, 0, 0));
            scene.body(geoms.back(), 0.3 * (i % 3 - 1), 0, 0);
        }
        for (int tick = 0; tick < 300; ++tick)
        {
            dGeomID geom = geoms[static_cast<std::size_t>(tick) * 7 % 20];
            if (dGeomGetSpace(geom))
                dSpaceRemove(scene.space(), geom);
            else
                scene.add(scene.space(), geom);
            if (tick % 3 == 0)
                dGeomSetPosition(geom, tick % 20, 0, 0);
            scene.step(0.01);
            scene.tick();
        }
        // Some are in no space that would destroy them.
        for (dGeomID geom : geoms)
            dGeomDestroy(geom);
    });
}

TEST_F(Notice, ABodyIsTeleportedAlongItsOwnPath)
{
    // The body is on the predicted line, but at another time than predicted.
    expect_as_simple([](Scenario &scene) {
        dBodyID body = scene.body(scene.sphere(0.5, 0, 0, 0), 1, 0, 0);
        scene.sphere(0.5, 30, 0, 0);
        for (int tick = 0; tick < 600; ++tick)
        {
            scene.step(0.01);
            if (tick == 300)
                dBodySetPosition(body, 29, 0, 0);
            if (tick == 320)
                dBodySetPosition(body, 3, 0, 0);
            if (tick == 500)
                dBodySetPosition(body, 29.5, 0, 0);
            scene.tick();
        }
    });
}

TEST_F(Notice, TurningBringsNearWithoutMovingTheCentre)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID beam = scene.numbered(dCreateBox(scene.space(), 10, 0.2, 0.2));
        scene.box(0.5, 0, 4, 0);
        scene.box(0.5, 3, 3, 0);
        for (int tick = 0; tick < 400; ++tick)
        {
            if (tick > 150)
            {
                dMatrix3 rotation;
                dRFromAxisAndAngle(rotation, 0, 0, 1, 0.01 * (tick - 150));
                dGeomSetRotation(beam, rotation);
            }
            scene.tick();
        }
    });
}
} // namespace
} // namespace ode_predictive_space
