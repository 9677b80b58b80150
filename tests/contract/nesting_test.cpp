#include <functional>

#include <ode_predictive_space/predictive_space.h>

#include "ode_predictive_space/ode/internals.h"
#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Contract = OdeTest;

void recurse(void *data, dGeomID first, dGeomID second)
{
    static_cast<Pairs *>(data)->push_back({geom_number(first), geom_number(second)});
    if (dGeomIsSpace(first) || dGeomIsSpace(second))
        dSpaceCollide2(first, second, data, recurse);
}

void recursive_tick(Scenario &scene)
{
    Pairs pairs;
    dSpaceCollide(scene.space(), &pairs, recurse);
    scene.note(unordered(pairs));
    if (scene.kind() == SpaceKind::predictive)
    {
        EXPECT_EQ(dPredictiveSpaceValidate(scene.space()), 1);
    }
}

using MakeSpace = std::function<dSpaceID(Scenario &, dSpaceID parent)>;

dSpaceID make_same_kind(Scenario &scene, dSpaceID parent)
{
    return scene.make_space(parent);
}
dSpaceID make_simple(Scenario &, dSpaceID parent)
{
    return dSimpleSpaceCreate(parent);
}
dSpaceID make_hash(Scenario &, dSpaceID parent)
{
    return dHashSpaceCreate(parent);
}
dSpaceID make_sweep_and_prune(Scenario &, dSpaceID parent)
{
    return dSweepAndPruneSpaceCreate(parent, dSAP_AXES_XYZ);
}
dSpaceID make_quadtree(Scenario &, dSpaceID parent)
{
    const dVector3 centre = {0, 0, 0};
    const dVector3 extents = {20, 20, 20};
    return dQuadTreeSpaceCreate(parent, centre, extents, 3);
}

void run_cars(Scenario &scene, const MakeSpace &make)
{
    std::vector<dBodyID> bodies;
    for (int car = 0; car < 2; ++car)
    {
        dSpaceID nested = make(scene, scene.space());
        scene.numbered(as_geom(nested));
        for (int part = 0; part < 4; ++part)
        {
            dGeomID geom = scene.numbered(dCreateBox(nested, 1, 0.5, 0.5));
            dGeomSetPosition(geom, car ? 8 : -8, 0.4 * car, 0.4 * part);
            bodies.push_back(scene.body(geom, car ? -2 : 2, 0, 0));
        }
    }
    for (int post = 0; post < 6; ++post)
        scene.box(0.5, 4.0 * post - 10, 0, 0);
    for (int tick = 0; tick < 200; ++tick)
    {
        scene.step(0.05);
        recursive_tick(scene);
        if (tick % 50 == 20)
            dBodySetPosition(bodies[0], 0, 6, 0);
        if (tick % 50 == 25)
            dBodySetPosition(bodies[0], dBodyGetPosition(bodies[1])[0], 0, 0);
    }
}

// A clean geom may be added to a nested space of ODE's own only if no geom in it is dirty.
TEST_F(Contract, 11_ATickCleansTheGeomsOfNestedSpaces)
{
    const dSpaceID outer = dPredictiveSpaceCreate(nullptr);
    const dSpaceID nested = dSimpleSpaceCreate(dSimpleSpaceCreate(outer));
    const dGeomID geom = dCreateSphere(nested, 1);
    dCreateSphere(outer, 1);
    for (int i = 0; i < 10; ++i)
    {
        dGeomSetPosition(geom, i, 0, 0);
        collide(outer);
        EXPECT_FALSE(geom->gflags & GEOM_DIRTY) << "at tick " << i;
    }
    dSpaceDestroy(outer);
}

TEST_F(Contract, 11_PredictiveInPredictive)
{
    expect_as_simple([](Scenario &scene) { run_cars(scene, make_same_kind); });
}

TEST_F(Contract, 11_SimpleInPredictive)
{
    expect_as_simple([](Scenario &scene) { run_cars(scene, make_simple); });
}

TEST_F(Contract, 11_HashInPredictive)
{
    expect_as_simple([](Scenario &scene) { run_cars(scene, make_hash); });
}

TEST_F(Contract, 11_SweepAndPruneInPredictive)
{
    expect_as_simple([](Scenario &scene) { run_cars(scene, make_sweep_and_prune); });
}

TEST_F(Contract, 11_QuadtreeInPredictive)
{
    expect_as_simple([](Scenario &scene) { run_cars(scene, make_quadtree); });
}

void run_inside(Scenario &scene, const MakeSpace &make_outer)
{
    dSpaceID outer = make_outer(scene, nullptr);
    dSpaceID inner = scene.make_space(outer);
    scene.numbered(as_geom(inner));
    std::vector<dGeomID> inside;
    for (int i = 0; i < 4; ++i)
        inside.push_back(scene.numbered(dCreateSphere(inner, 0.5)));
    for (int i = 0; i < 8; ++i)
        dGeomSetPosition(scene.numbered(dCreateBox(outer, 1, 1, 1)), 2 * i, 0, 0);
    for (int tick = 0; tick < 150; ++tick)
    {
        for (std::size_t i = 0; i < 4; ++i)
            dGeomSetPosition(inside[i], 0.1 * tick, 0.3 * static_cast<dReal>(i) - 0.004 * tick, 0);
        Pairs pairs;
        dSpaceCollide(outer, &pairs, recurse);
        dSpaceCollide(inner, &pairs, recurse);
        scene.note(unordered(pairs));
    }
    dSpaceDestroy(outer);
}

TEST_F(Contract, 11_PredictiveInSimple)
{
    expect_as_simple([](Scenario &scene) { run_inside(scene, make_simple); });
}

TEST_F(Contract, 11_PredictiveInHash)
{
    expect_as_simple([](Scenario &scene) { run_inside(scene, make_hash); });
}

TEST_F(Contract, 11_PredictiveInSweepAndPrune)
{
    expect_as_simple([](Scenario &scene) { run_inside(scene, make_sweep_and_prune); });
}

TEST_F(Contract, 11_PredictiveInQuadtree)
{
    expect_as_simple([](Scenario &scene) { run_inside(scene, make_quadtree); });
}

TEST_F(Contract, 11_TheBoundsOfASpaceEncloseItsGeoms)
{
    dSpaceID outer = dSimpleSpaceCreate(nullptr);
    dSpaceID inner = dPredictiveSpaceCreate(outer);
    dGeomID geom = dCreateSphere(inner, 1);
    dGeomSetPosition(dCreateSphere(inner, 1), 5, 6, 7);
    for (int tick = 0; tick < 10; ++tick)
    {
        dGeomSetPosition(geom, -tick, 0, 0);
        if (tick % 2)
            collide(outer);
        if (tick % 3 == 0)
            collide(inner);
        dReal aabb[6];
        dGeomGetAABB(as_geom(inner), aabb);
        const dReal expected[6] = {static_cast<dReal>(-tick - 1), 6, -1, 7, -1, 8};
        for (int side = 0; side < 6; ++side)
            EXPECT_EQ(aabb[side], expected[side]) << tick;
    }
    dSpaceDestroy(outer);
}

TEST_F(Contract, 11_AnEmptyNestedSpaceIsNoWiderThanInASimpleSpace)
{
    expect_as_simple([](Scenario &scene) {
        for (int i = 0; i < 3; ++i)
            scene.numbered(as_geom(scene.make_space(scene.space())));
        scene.box(1, 5, 0, 0);
        dGeomID visitor = scene.box(1, 0.2, 0, 0);
        recursive_tick(scene);
        dGeomSetPosition(visitor, 4.5, 0, 0);
        recursive_tick(scene);
    });
}

TEST_F(Contract, 11_ANestedSpaceMayEmptyAndFillAgain)
{
    expect_as_simple([](Scenario &scene) {
        dSpaceID nested = scene.make_space(scene.space());
        scene.numbered(as_geom(nested));
        scene.box(1, 5, 0, 0);
        dGeomID geom = scene.numbered(dCreateBox(nested, 1, 1, 1));
        dGeomSetPosition(geom, 5, 0.5, 0);
        for (int tick = 0; tick < 12; ++tick)
        {
            recursive_tick(scene);
            if (tick % 3 == 0)
                dSpaceRemove(nested, geom);
            recursive_tick(scene);
            if (tick % 3 == 0)
                scene.add(nested, geom);
        }
    });
}

TEST_F(Contract, 11_FourDeep)
{
    expect_as_simple([](Scenario &scene) {
        dSpaceID deepest = scene.space();
        for (int level = 0; level < 4; ++level)
        {
            deepest = scene.make_space(deepest);
            scene.numbered(as_geom(deepest));
        }
        dGeomID mover = scene.numbered(dCreateSphere(deepest, 0.5));
        for (int i = 0; i < 10; ++i)
            scene.box(0.5, i, 0, 0);
        for (int tick = 0; tick < 200; ++tick)
        {
            dGeomSetPosition(mover, 0.05 * tick, 0, 0);
            recursive_tick(scene);
        }
    });
}

TEST_F(Contract, 11_ASpaceAndItsParentAreCollidedWithEachOther)
{
    expect_as_simple([](Scenario &scene) {
        dSpaceID nested = scene.make_space(scene.space());
        scene.numbered(as_geom(nested));
        std::vector<dGeomID> geoms;
        for (int i = 0; i < 3; ++i)
            geoms.push_back(scene.numbered(dCreateSphere(nested, 0.6)));
        for (int i = 0; i < 6; ++i)
            scene.sphere(0.6, i, 0, 0);
        for (int tick = 0; tick < 30; ++tick)
        {
            for (std::size_t i = 0; i < 3; ++i)
                dGeomSetPosition(geoms[i], 0.2 * tick - static_cast<dReal>(i), 0, 0);
            // The queried parent cleans the nested space while that is walked.
            scene.query(as_geom(nested), as_geom(scene.space()));
            scene.query(as_geom(scene.space()), as_geom(nested));
            if (tick % 4 == 0)
                recursive_tick(scene);
        }
    });
}

TEST_F(Contract, 11_NestedSpacesMoveBetweenParents)
{
    expect_as_simple([](Scenario &scene) {
        dSpaceID parents[] = {scene.space(), scene.make_space(scene.space())};
        scene.numbered(as_geom(parents[1]));
        dSpaceID nested = scene.make_space(scene.space());
        scene.numbered(as_geom(nested));
        dGeomID geom = scene.numbered(dCreateSphere(nested, 1));
        scene.sphere(1, 0, 0, 0);
        dGeomSetPosition(scene.numbered(dCreateSphere(parents[1], 1)), 1, 0, 0);
        for (int round = 0; round < 8; ++round)
        {
            dGeomSetPosition(geom, round % 3, 0, 0);
            recursive_tick(scene);
            dSpaceRemove(parents[round % 2], as_geom(nested));
            recursive_tick(scene);
            scene.add(parents[(round + 1) % 2], as_geom(nested));
            recursive_tick(scene);
        }
    });
}

// ODE's other spaces rely on this: a space is dirty while a geom in it is.
TEST_F(Contract, 11_ANestedSpaceIsDirtyWhenItLeavesWithDirtyGeoms)
{
    dSpaceID outer = dPredictiveSpaceCreate(nullptr), other = dSimpleSpaceCreate(nullptr);
    dSpaceID nested = dSimpleSpaceCreate(outer);
    dGeomID ball = dCreateSphere(nested, 0.5);
    collide(outer);
    dGeomSetPosition(ball, 1, 0, 0);
    dReal box[6];
    dGeomGetAABB(as_geom(nested), box);
    dSpaceRemove(outer, as_geom(nested));
    dSpaceAdd(other, as_geom(nested));
    dGeomID neighbour = dCreateSphere(other, 0.5);
    dGeomSetPosition(neighbour, 100, 0, 0);
    collide(other);
    dGeomSetPosition(neighbour, 101, 0, 0);
    collide(other);
    dGeomSetPosition(ball, 101, 0, 0);
    EXPECT_EQ(collide(other).size(), 1u);
    dSpaceDestroy(other);
    dSpaceDestroy(outer);
}

// A simple space assumes that all geoms behind a clean one in its list are clean.
TEST_F(Contract, 11_AGeomThatHasMovedIsDirtyWhenItLeaves)
{
    dSpaceID predictive = dPredictiveSpaceCreate(nullptr), simple = dSimpleSpaceCreate(nullptr);
    dGeomID ball = dCreateSphere(predictive, 0.5), neighbour = dCreateSphere(simple, 0.5);
    dPredictiveSpaceSetGeomRole(predictive, ball, dPredictiveRoleInteractive);
    collide(predictive);
    collide(simple);
    dGeomSetPosition(ball, 5, 0, 0);
    dReal box[6];
    dGeomGetAABB(ball, box);
    dSpaceRemove(predictive, ball);
    dGeomSetPosition(neighbour, 5, 0, 0);
    dSpaceAdd(simple, ball);
    EXPECT_EQ(collide(simple).size(), 1u);
    dSpaceDestroy(simple);
    dSpaceDestroy(predictive);
}

// New data make a mesh dirty without a notice, and its next move makes the space that holds it dirty without one, too.
void expect_moves_are_noticed_beside_a_new_mesh(dSpaceID outer, dSpaceID nested)
{
    static const float vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const dTriIndex indices[] = {0, 1, 2};
    dTriMeshDataID data[2];
    for (dTriMeshDataID &each : data)
    {
        each = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildSingle(each, vertices, 3 * sizeof(float), 3, indices, 3, 3 * sizeof(dTriIndex));
    }
    dGeomSetPosition(dCreateSphere(outer, 0.5), 100, 0, 0);
    dGeomID mesh = dCreateTriMesh(nested, data[0], nullptr, nullptr, nullptr);
    dGeomID ball = dCreateSphere(nested, 0.5);
    for (int tick = 0; tick < 5; ++tick)
    {
        dGeomSetPosition(ball, 0.01 * tick, 0, 0);
        collide(outer);
    }
    dGeomTriMeshSetData(mesh, data[1]);
    dGeomSetPosition(mesh, 1, 0, 0);
    collide(outer);
    dGeomSetPosition(ball, 100, 0, 0);
    EXPECT_EQ(collide(outer).size(), 1u);
    dSpaceDestroy(outer);
    for (dTriMeshDataID each : data)
        dGeomTriMeshDataDestroy(each);
}

TEST_F(Contract, 11_ANewMeshInANestedSpaceHidesNoMoves)
{
    dSpaceID outer = dPredictiveSpaceCreate(nullptr);
    expect_moves_are_noticed_beside_a_new_mesh(outer, dSimpleSpaceCreate(outer));
    outer = dPredictiveSpaceCreate(nullptr);
    expect_moves_are_noticed_beside_a_new_mesh(outer, dPredictiveSpaceCreate(outer));
}
} // namespace
} // namespace ode_predictive_space
