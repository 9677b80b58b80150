#include <algorithm>
#include <functional>
#include <set>

#include <ode_predictive_space/predictive_space.h>

#include "ode_predictive_space/ode/internals.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Contract = OdeTest;
using Visit = std::function<void(dGeomID, dGeomID)>;

void visit_pair(void *data, dGeomID first, dGeomID second)
{
    (*static_cast<const Visit *>(data))(first, second);
}

void collide_with(dSpaceID space, Visit visit)
{
    dSpaceCollide(space, &visit, visit_pair);
}

void collide2_with(dGeomID first, dGeomID second, Visit visit)
{
    dSpaceCollide2(first, second, &visit, visit_pair);
}

// Ten spheres in a heap: 45 pairs.
class Heap
{
public:
    Heap()
    {
        for (int i = 0; i < 10; ++i)
            geoms.push_back(scene.sphere(1, 0.1 * i, 0, 0));
    }

    Scenario scene{SpaceKind::predictive};
    std::vector<dGeomID> geoms;
};

TEST_F(Contract, 07_TheSpaceIsLockedWhileItReports)
{
    Heap heap;
    dSpaceID space = heap.scene.space();
    int calls = 0;
    const auto locked = [&](dGeomID, dGeomID) {
        ++calls;
        EXPECT_GT(space->lock_count, 0);
    };
    collide_with(space, locked);
    EXPECT_EQ(space->lock_count, 0);
    collide2_with(heap.geoms[0], as_geom(space), locked);
    EXPECT_EQ(space->lock_count, 0);
    dSpaceClean(space);
    EXPECT_EQ(space->lock_count, 0);
    EXPECT_EQ(calls, 45 + 10);
}

TEST_F(Contract, 07_ChangesAreRefusedWhileLocked)
{
    Heap heap;
    dSpaceID space = heap.scene.space();
    dGeomID outside = dCreateSphere(nullptr, 1);
    std::set<std::string> complaints;
    collide_with(space, [&](dGeomID first, dGeomID) {
        complaints.insert(ode_complaint([&] { dGeomSetPosition(first, 0, 0, 0); }));
        // Without assertions neither ODE nor the space refuses these calls, and the lists break.
        if (!ode_has_assertions())
            return;
        complaints.insert(ode_complaint([&] { dSpaceAdd(space, outside); }));
        complaints.insert(ode_complaint([&] { dSpaceRemove(space, first); }));
        // These calls bypass ODE's own check and meet that of the space.
        complaints.insert(ode_complaint([&] { space->add(outside); }));
        complaints.insert(ode_complaint([&] { space->remove(first); }));
    });
    ASSERT_FALSE(complaints.empty());
    for (const std::string &complaint : complaints)
        EXPECT_EQ(complaint.find("Invalid operation for locked space") != std::string::npos, ode_has_assertions())
            << complaint;
    EXPECT_EQ(dSpaceGetNumGeoms(space), 10);
    EXPECT_EQ(collide(space).size(), 45u);
    dGeomDestroy(outside);
}

TEST_F(Contract, 07_GeomsAreBroughtUpToDateUnderTheLock)
{
    // While a space is being cleaned, nothing in it may be moved. The bounds function of a user class is called just then.
    static dSpaceID space;
    static int least_lock_count;
    const auto collider = [](int) -> dColliderFn * { return nullptr; };
    const auto bounds = [](dGeomID geom, dReal aabb[6]) {
        const dReal *position = dGeomGetPosition(geom);
        for (int axis = 0; axis < 3; ++axis)
        {
            aabb[2 * axis] = position[axis] - 1;
            aabb[2 * axis + 1] = position[axis] + 1;
        }
        least_lock_count = std::min(least_lock_count, space->lock_count);
    };
    dGeomClass watched = {0, collider, bounds, nullptr, nullptr};
    const int number = dCreateGeomClass(&watched);

    space = dPredictiveSpaceCreate(nullptr);
    std::vector<dGeomID> geoms;
    for (int i = 0; i < 2; ++i)
    {
        geoms.push_back(dCreateGeom(number));
        dSpaceAdd(space, geoms.back());
    }
    for (int tick = 0; tick < 5; ++tick)
    {
        least_lock_count = 100;
        dGeomSetPosition(geoms[0], 0.1 * tick, 0, 0);
        if (tick == 2)
            dSpaceClean(space);
        EXPECT_EQ(collide(space).size(), 1u);
        EXPECT_GT(least_lock_count, 0);
    }
    dSpaceDestroy(space);
}

TEST_F(Contract, 08_ACollideWithinACallbackIsNoTick)
{
    Heap heap;
    const dSpaceID space = heap.scene.space();
    collide_with(space, [space](dGeomID, dGeomID) { collide(space); });
    dPredictiveSpaceStats stats;
    dPredictiveSpaceGetStats(space, &stats);
    EXPECT_EQ(stats.ticks, 1u);
}

TEST_F(Contract, 08_ACallbackMayCollideTheSameSpaceAgain)
{
    Heap heap;
    dSpaceID space = heap.scene.space();
    const Pairs expected = unordered(collide(space));
    for (int tick = 0; tick < 5; ++tick)
    {
        for (std::size_t i = 0; i < 10; ++i)
            dGeomSetPosition(heap.geoms[i], 0.1 * static_cast<dReal>(i), 0.1 * tick, 0);
        Pairs outer;
        collide_with(space, [&](dGeomID first, dGeomID second) {
            outer.push_back({geom_number(first), geom_number(second)});
            EXPECT_EQ(unordered(collide(space)), expected);
        });
        EXPECT_EQ(unordered(outer), expected);
    }
}

TEST_F(Contract, 08_ACallbackMayAskThreeDeep)
{
    Heap heap;
    dSpaceID space = heap.scene.space();
    int innermost = 0;
    collide_with(space, [&](dGeomID first, dGeomID) {
        collide2_with(first, as_geom(space), [&](dGeomID, dGeomID second) {
            innermost += static_cast<int>(collide2(as_geom(space), second).size());
        });
    });
    // 45 pairs; each geom meets the nine others and itself, twice over.
    EXPECT_EQ(innermost, 45 * 10 * 10);
    EXPECT_EQ(collide(space).size(), 45u);
}

TEST_F(Contract, 08_ACallbackOfAQueryMayCollideTheSpace)
{
    Heap heap;
    dSpaceID space = heap.scene.space();
    dGeomID probe = dCreateSphere(nullptr, 1);
    for (int tick = 0; tick < 5; ++tick)
    {
        // The query is the first to see these moves.
        for (dGeomID geom : heap.geoms)
            dGeomSetPosition(geom, 0, 0, 0.1 * tick);
        int calls = 0;
        collide2_with(probe, as_geom(space), [&](dGeomID first, dGeomID) {
            EXPECT_EQ(first, probe);
            EXPECT_EQ(collide(space).size(), 45u);
            ++calls;
        });
        EXPECT_EQ(calls, 10);
    }
    dGeomDestroy(probe);
}

TEST_F(Contract, 08_ACallbackMayDisableGeoms)
{
    for (int victim = 0; victim < 10; ++victim)
    {
        Heap heap;
        const Pairs all = unordered(collide(heap.scene.space()));
        Pairs seen;
        collide_with(heap.scene.space(), [&](dGeomID first, dGeomID second) {
            dGeomDisable(heap.geoms[static_cast<std::size_t>(victim)]);
            seen.push_back({geom_number(first), geom_number(second)});
        });
        seen = unordered(seen);
        EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
        // Pairs of the disabled geom may have come before it was disabled; no other may be missing.
        for (const Pair &pair : all)
        {
            const bool excused = pair.first == victim || pair.second == victim;
            EXPECT_TRUE(excused || std::binary_search(seen.begin(), seen.end(), pair));
        }
        EXPECT_EQ(collide(heap.scene.space()).size(), 36u);
        dGeomEnable(heap.geoms[static_cast<std::size_t>(victim)]);
        EXPECT_EQ(unordered(collide(heap.scene.space())), all);
    }
}

TEST_F(Contract, 08_ACallbackMayChangeBitsWhereNothingIsLocked)
{
    // The geoms are of a nested space, while the outer one reports; ODE refuses it for geoms of the reporting space.
    expect_as_simple([](Scenario &scene) {
        dSpaceID nested = scene.make_space(scene.space());
        scene.numbered(as_geom(nested));
        dGeomID inner = scene.numbered(dCreateSphere(nested, 1));
        scene.sphere(1, 0.5, 0, 0);
        for (int tick = 0; tick < 4; ++tick)
        {
            Pairs pairs;
            collide_with(scene.space(), [&](dGeomID first, dGeomID second) {
                dGeomSetCategoryBits(inner, tick % 2 ? 0 : 1);
                dGeomSetCollideBits(inner, tick % 2 ? 0 : 1);
                const Pairs inside = collide2(first, second);
                EXPECT_EQ(inside.size(), tick % 2 ? 0u : 1u);
                pairs.insert(pairs.end(), inside.begin(), inside.end());
            });
            scene.note(unordered(pairs));
        }
    });
}

TEST_F(Contract, 08_ACallbackMayMoveBodiesOfOtherSpaces)
{
    Heap heap;
    Scenario other(SpaceKind::predictive);
    dGeomID mover = other.sphere(1, 5, 0, 0);
    other.sphere(1, 0, 0, 0);
    EXPECT_TRUE(collide(other.space()).empty());
    collide_with(heap.scene.space(), [&](dGeomID, dGeomID) {
        const dReal x = dGeomGetPosition(mover)[0];
        dGeomSetPosition(mover, x > 1 ? 0 : 5, 0, 0);
        EXPECT_EQ(collide(other.space()).size(), x > 1 ? 1u : 0u);
    });
}

TEST_F(Contract, 08_ASpaceCollidedWithItselfIsCollided)
{
    Heap heap;
    dSpaceID space = heap.scene.space();
    for (int tick = 0; tick < 3; ++tick)
    {
        dGeomSetPosition(heap.geoms[0], 0.01 * tick, 0, 0);
        EXPECT_EQ(collide2(as_geom(space), as_geom(space)).size(), 45u);
    }
}
} // namespace
} // namespace ode_predictive_space
