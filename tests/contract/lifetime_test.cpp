#include <set>

#include <ode_predictive_space/predictive_space.h>

#include "ode_predictive_space/ode/internals.h"
#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Contract = OdeTest;

// dSpaceCollide2(space, space) relies on this list when it walks a space without virtual calls.
void expect_sound_list(dSpaceID space)
{
    int count = 0;
    dxGeom **back = &space->first;
    for (dxGeom *geom = space->first; geom; geom = geom->next)
    {
        ASSERT_EQ(geom->tome, back);
        ASSERT_EQ(geom->parent_space, space);
        back = &geom->next;
        ++count;
    }
    EXPECT_EQ(count, space->count);
    EXPECT_EQ(count, dSpaceGetNumGeoms(space));
}

std::set<int> enumerated(dSpaceID space)
{
    std::set<int> numbers;
    for (int i = 0; i < dSpaceGetNumGeoms(space); ++i)
        numbers.insert(geom_number(dSpaceGetGeom(space, i)));
    return numbers;
}

TEST_F(Contract, 02_GeomsAreAddedWithinTheirConstructors)
{
    expect_as_simple([](Scenario &scene) {
        for (int kind = 0; kind < geom_kind_count; ++kind)
            scene.numbered(create_geom(static_cast<GeomKind>(kind), 1, scene.space()));
        dSpaceID nested = scene.make_space(scene.space());
        scene.numbered(as_geom(nested));
        scene.numbered(dCreateSphere(nested, 1));
        scene.tick();
    });
}

TEST_F(Contract, 02_GeomsMayGoBeforeTheFirstTick)
{
    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    for (int kind = 0; kind < geom_kind_count; ++kind)
    {
        dGeomID gone = create_geom(static_cast<GeomKind>(kind), 1, space);
        create_geom(static_cast<GeomKind>(kind), 1, space);
        dGeomDestroy(gone);
    }
    EXPECT_EQ(dSpaceGetNumGeoms(space), geom_kind_count);
    EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
    dSpaceDestroy(space);
}

TEST_F(Contract, 03_DestroyedGeomsAreForgotten)
{
    expect_as_simple([](Scenario &scene) {
        std::vector<dGeomID> geoms;
        for (int i = 0; i < 30; ++i)
        {
            geoms.push_back(scene.box(1, 0.4 * i, 0, 0));
            scene.body(geoms.back(), i % 2 ? 1 : -1, 0, 0);
        }
        for (int i = 0; i < 30; ++i)
        {
            scene.tick();
            scene.step(0.01);
            dGeomDestroy(geoms[static_cast<std::size_t>(i * 7 % 30)]);
            scene.tick();
        }
    });
}

TEST_F(Contract, 03_DestroyedGeomsLeaveRoomForNewOnesAtTheSameAddress)
{
    expect_as_simple([](Scenario &scene) {
        for (int round = 0; round < 50; ++round)
        {
            dGeomID first = scene.box(1, round, 0, 0);
            scene.box(1, round + 3, 0, 0);
            scene.tick();
            dGeomDestroy(first);
            // The new box is likely to get the address of the destroyed one.
            scene.box(1, round + 2.5, 0, 0);
            scene.tick();
        }
    });
}

TEST_F(Contract, 03_ASpaceIsDestroyedWithAllThatItHolds)
{
    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    for (int i = 0; i < 20; ++i)
        dGeomSetPosition(dCreateSphere(space, 1), i, 0, 0);
    dCreateSphere(dPredictiveSpaceCreate(space), 1);
    collide(space);
    dSpaceDestroy(space);

    dSpaceID never_collided = dPredictiveSpaceCreate(nullptr);
    dCreateSphere(never_collided, 1);
    dSpaceDestroy(never_collided);
}

TEST_F(Contract, 04_TheListOfGeomsIsSoundAtAllTimes)
{
    Scenario scene(SpaceKind::predictive);
    std::vector<dGeomID> geoms;
    for (int i = 0; i < 40; ++i)
    {
        geoms.push_back(scene.box(1, 0.7 * i, 0, 0));
        expect_sound_list(scene.space());
    }
    for (std::size_t i = 0; i < 40; ++i)
    {
        dGeomSetPosition(geoms[i], 0, 0.1 * static_cast<dReal>(i), 0);
        expect_sound_list(scene.space());
        if (i % 3 == 0)
            scene.tick();
        expect_sound_list(scene.space());
        dSpaceRemove(scene.space(), geoms[(i * 7 + 3) % 40]);
        expect_sound_list(scene.space());
        dSpaceAdd(scene.space(), geoms[(i * 7 + 3) % 40]);
        expect_sound_list(scene.space());
    }
}

TEST_F(Contract, 04_WalkingASpaceByHandDoesNotHideItsMoves)
{
    // dSpaceCollide2(small, large) iterates over the geoms of the small space and updates their bounds itself.
    expect_as_simple([](Scenario &scene) {
        dGeomID mover = scene.box(1, 10, 0, 0);
        scene.box(1, 0, 0, 0);
        dSpaceID large = dHashSpaceCreate(nullptr);
        for (int i = 0; i < 5; ++i)
            number_geom(dCreateBox(large, 1, 1, 1), 100 + i);
        scene.tick();
        for (int tick = 0; tick < 40; ++tick)
        {
            dGeomSetPosition(mover, 10 - 0.4 * tick, 0, 0);
            scene.query(as_geom(scene.space()), as_geom(large));
            scene.query(as_geom(large), as_geom(scene.space()));
            scene.tick();
        }
        dSpaceDestroy(large);
    });
}

TEST_F(Contract, 05_LinksAreZeroOutsideAndNeedNotBeZeroOnEntry)
{
    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    std::vector<dGeomID> geoms;
    for (int i = 0; i < 10; ++i)
    {
        geoms.push_back(dCreateSphere(nullptr, 1));
        geoms.back()->next_ex = geoms.front();
        geoms.back()->tome_ex = &geoms.front()->next;
        dSpaceAdd(space, geoms.back());
    }
    EXPECT_EQ(collide(space).size(), 45u);
    dSpaceRemove(space, geoms[4]);
    EXPECT_EQ(geoms[4]->next_ex, nullptr);
    EXPECT_EQ(geoms[4]->tome_ex, nullptr);
    EXPECT_EQ(collide(space).size(), 36u);

    dSpaceSetCleanup(space, 0);
    dSpaceDestroy(space);
    for (dGeomID geom : geoms)
    {
        EXPECT_EQ(geom->next_ex, nullptr);
        EXPECT_EQ(geom->tome_ex, nullptr);
        EXPECT_EQ(geom->parent_space, nullptr);
        dGeomDestroy(geom);
    }
}

TEST_F(Contract, 05_GeomsMoveBetweenAllKindsOfSpaces)
{
    const dVector3 centre = {0, 0, 0};
    const dVector3 extents = {10, 10, 10};
    dSpaceID spaces[] = {dPredictiveSpaceCreate(nullptr), dQuadTreeSpaceCreate(nullptr, centre, extents, 3),
                         dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ), dHashSpaceCreate(nullptr),
                         dSimpleSpaceCreate(nullptr)};
    std::vector<dGeomID> geoms;
    for (int i = 0; i < 10; ++i)
        geoms.push_back(dCreateSphere(spaces[0], 1));
    for (int round = 0; round < 20; ++round)
    {
        dSpaceID from = spaces[round % 5];
        dSpaceID to = spaces[round % 2 ? (round + 1) % 5 : (round + 4) % 5];
        for (std::size_t i = 0; i < geoms.size(); ++i)
        {
            if (dGeomGetSpace(geoms[i]))
                dSpaceRemove(dGeomGetSpace(geoms[i]), geoms[i]);
            dSpaceClean(i % 3 ? from : to);
            dSpaceAdd(i % 3 ? from : to, geoms[i]);
        }
        for (dSpaceID space : spaces)
        {
            const auto n = static_cast<std::size_t>(dSpaceGetNumGeoms(space));
            EXPECT_EQ(collide(space).size(), n * (n - (n > 0)) / 2);
        }
    }
    for (dSpaceID space : spaces)
        dSpaceDestroy(space);
}

TEST_F(Contract, 06_AddCleanGeomWhileOthersAreDirty)
{
    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    dGeomID clean = dCreateSphere(space, 1);
    dGeomID other = dCreateSphere(space, 1);
    EXPECT_EQ(collide(space).size(), 1u);
    dSpaceRemove(space, clean);
    dGeomSetPosition(other, 5, 0, 0);
    dGeomSetPosition(dCreateSphere(space, 1), 5, 0, 0);
    dSpaceAdd(space, clean);
    EXPECT_EQ(collide(space).size(), 1u);
    dGeomSetPosition(clean, 5, 0, 0);
    EXPECT_EQ(collide(space).size(), 3u);
    dSpaceDestroy(space);
}

std::size_t pairs_after_putting_back(dSpaceID space)
{
    dGeomID put_back = dCreateSphere(space, 1), other = dCreateSphere(space, 1);
    collide(space);
    dSpaceRemove(space, put_back);
    dGeomSetPosition(other, 0.5, 0, 0);
    dSpaceAdd(space, put_back);
    const std::size_t pairs = collide(space).size();
    dSpaceDestroy(space);
    return pairs;
}

TEST_F(Contract, 06_AGeomThatIsPutBackEndsOdesSpacesAndNotThisOne)
{
    EXPECT_EQ(pairs_after_putting_back(dPredictiveSpaceCreate(nullptr)), 1u);
    if (!ode_has_assertions())
        return;
    for (dSpaceID (*make)(dSpaceID) : {dSimpleSpaceCreate, dHashSpaceCreate})
        EXPECT_DEATH(
            {
                dSetDebugHandler(nullptr);
                pairs_after_putting_back(make(nullptr));
            },
            "GEOM_AABB_BAD\\)\\s*==\\s*0");
}

TEST_F(Contract, 06_AddGeomMadeCleanByAnotherSpace)
{
    for (dSpaceID (*make)(dSpaceID) : {dSimpleSpaceCreate, dHashSpaceCreate, dPredictiveSpaceCreate})
    {
        dSpaceID other = make(nullptr);
        dGeomID geom = dCreateSphere(other, 1);
        dSpaceClean(other);
        dSpaceRemove(other, geom);
        dSpaceID space = dPredictiveSpaceCreate(nullptr);
        dGeomID dirty = dCreateSphere(space, 1);
        dSpaceAdd(space, geom);
        dGeomSetPosition(dirty, 1, 0, 0);
        EXPECT_EQ(collide(space).size(), 1u);
        dGeomSetPosition(geom, 9, 0, 0);
        EXPECT_EQ(collide(space).size(), 0u);
        dGeomSetPosition(dirty, 9, 0, 0);
        EXPECT_EQ(collide(space).size(), 1u);
        dSpaceDestroy(space);
        dSpaceDestroy(other);
    }
}

TEST_F(Contract, 10_GeomsAreEnumeratedEachOnce)
{
    Scenario scene(SpaceKind::predictive);
    std::set<int> all;
    std::vector<dGeomID> geoms;
    for (int i = 0; i < 25; ++i)
    {
        geoms.push_back(scene.sphere(0.5, i, 0, 0));
        all.insert(i);
        EXPECT_EQ(enumerated(scene.space()), all);
    }
    scene.tick();
    EXPECT_EQ(enumerated(scene.space()), all);
    for (std::size_t i = 0; i < 25; i += 2)
    {
        dGeomSetPosition(geoms[i], 0, 0, 0);
        EXPECT_EQ(enumerated(scene.space()), all);
    }
    scene.tick();
    // Out of order, so that no cached position of the last call helps.
    for (int i : {24, 0, 12, 11, 12, 13, 5})
        EXPECT_EQ(all.count(geom_number(dSpaceGetGeom(scene.space(), i))), 1u);
    while (dSpaceGetNumGeoms(scene.space()) > 0)
        dGeomDestroy(dSpaceGetGeom(scene.space(), 0));
}

TEST_F(Contract, 10_AnIndexOutOfRangeIsRefused)
{
    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    dCreateSphere(space, 1);
    if (ode_has_assertions())
    {
        EXPECT_NE(ode_complaint([=] { dSpaceGetGeom(space, 1); }), "");
        EXPECT_NE(ode_complaint([=] { dSpaceGetGeom(space, -1); }), "");
    }
    else // without assertions ODE returns null past the last geom
        EXPECT_EQ(dSpaceGetGeom(space, 1), nullptr);
    dSpaceDestroy(space);
}

TEST_F(Contract, 15_CleanupModeZeroLeavesTheGeoms)
{
    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    EXPECT_EQ(dSpaceGetCleanup(space), 1);
    dSpaceSetCleanup(space, 0);
    dGeomID sphere = dCreateSphere(space, 1);
    dSpaceID nested = dPredictiveSpaceCreate(space);
    dGeomID inner = dCreateSphere(nested, 1);
    collide(space);
    dSpaceDestroy(space);
    EXPECT_EQ(dGeomGetSpace(sphere), nullptr);
    EXPECT_EQ(dGeomGetSpace(as_geom(nested)), nullptr);
    EXPECT_EQ(dGeomGetSpace(inner), nested);

    dSpaceAdd(nested, sphere);
    EXPECT_EQ(collide(nested).size(), 1u);
    dSpaceDestroy(nested);
}

TEST_F(Contract, 15_ChildrenMayEndBeforeTheirParents)
{
    for (int cleanup : {0, 1})
    {
        dSpaceID parent = dPredictiveSpaceCreate(nullptr);
        dSpaceID child = dPredictiveSpaceCreate(parent);
        dSpaceSetCleanup(child, cleanup);
        dGeomID geom = dCreateSphere(child, 1);
        dCreateSphere(parent, 1);
        EXPECT_EQ(collide(parent).size(), 1u);
        dSpaceDestroy(child);
        EXPECT_EQ(dSpaceGetNumGeoms(parent), 1);
        EXPECT_EQ(collide(parent).size(), 0u);
        if (cleanup == 0)
            dSpaceAdd(parent, geom);
        EXPECT_EQ(collide(parent).size(), cleanup == 0 ? 1u : 0u);
        dSpaceDestroy(parent);
    }
}

TEST_F(Contract, 15_GeomsMayEndAfterTheirBodiesAndBefore)
{
    Scenario scene(SpaceKind::predictive);
    dGeomID first = scene.sphere(1, 0, 0, 0);
    dGeomID second = scene.sphere(1, 1, 0, 0);
    dBodyID first_body = scene.body(first, 1, 0, 0);
    dBodyID second_body = scene.body(second, 0, 0, 0);
    scene.tick();
    dBodyDestroy(first_body);
    scene.tick();
    EXPECT_EQ(scene.log().back().size(), 1u);
    dGeomDestroy(second);
    dBodyDestroy(second_body);
    scene.tick();
    EXPECT_TRUE(scene.log().back().empty());
}

TEST_F(Contract, 15_SublevelsSayWhichSpaceIsTakenAsAGeom)
{
    for (int level : {0, 1, 2})
    {
        expect_as_simple([=](Scenario &scene) {
            dSpaceID other = scene.make_space(nullptr);
            scene.numbered(as_geom(other));
            scene.numbered(as_geom(scene.space()));
            for (int i = 0; i < 3; ++i)
            {
                scene.sphere(1, i, 0, 0);
                dGeomSetPosition(scene.numbered(dCreateSphere(other, 1)), i, 0.5, 0);
            }
            dSpaceSetSublevel(scene.space(), 1);
            dSpaceSetSublevel(other, level);
            EXPECT_EQ(dSpaceGetSublevel(other), level);
            scene.query(as_geom(scene.space()), as_geom(other));
            scene.query(as_geom(other), as_geom(scene.space()));
            dSpaceDestroy(other);
        });
    }
}

TEST_F(Contract, 15_QueriesAreAnsweredAfterMostGeomsAreGone)
{
    expect_as_simple([](Scenario &scene) {
        std::vector<dGeomID> geoms;
        for (int i = 0; i < 2000; ++i)
            geoms.push_back(scene.sphere(1, 3 * i, 0, 0));
        dGeomID probe = scene.numbered(dCreateSphere(nullptr, 5));
        dGeomSetPosition(probe, 30, 0, 0);
        scene.tick();
        scene.query(probe, as_geom(scene.space()));
        while (geoms.size() > 100)
        {
            dGeomDestroy(geoms.back());
            geoms.pop_back();
        }
        scene.query(probe, as_geom(scene.space()));
        scene.tick();
        scene.query(probe, as_geom(scene.space()));
        dGeomDestroy(probe);
    });
}

TEST_F(Contract, 15_ManualCleanupIsKept)
{
    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    dSpaceID twin = dSimpleSpaceCreate(nullptr);
    for (int mode : {0, 1, 0})
    {
        dSpaceSetManualCleanup(space, mode);
        dSpaceSetManualCleanup(twin, mode);
        EXPECT_EQ(dSpaceGetManualCleanup(space), dSpaceGetManualCleanup(twin));
    }
    dSpaceDestroy(space);
    dSpaceDestroy(twin);
}
} // namespace
} // namespace ode_predictive_space
