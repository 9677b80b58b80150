// Contract 13: coordinates that are not numbers, infinite or huge. The simple space is the reference.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Contract = OdeTest;

constexpr dReal nan_value = std::numeric_limits<dReal>::quiet_NaN();
constexpr dReal infinite = std::numeric_limits<dReal>::infinity();

constexpr dReal huge = std::numeric_limits<dReal>::max() / 1e8f;
constexpr dReal tiny = std::numeric_limits<dReal>::min() * 1e8f;

const std::vector<dReal> finite_extremes = {1e12, -1e12, huge, -huge, tiny, std::numeric_limits<dReal>::denorm_min()};

std::vector<dReal> extremes_and_no_numbers()
{
    std::vector<dReal> all = {nan_value, infinite, -infinite};
    all.insert(all.end(), finite_extremes.begin(), finite_extremes.end());
    return all;
}
const std::vector<dReal> extremes = extremes_and_no_numbers();

void run_row(Scenario &scene, dReal extreme, bool with_bodies)
{
    std::vector<dGeomID> geoms;
    for (int i = 0; i < 12; ++i)
    {
        geoms.push_back(scene.sphere(0.5, i, 0, 0));
        if (with_bodies)
            scene.body(geoms.back(), 0.1 * i, 0, 0);
    }
    for (int tick = 0; tick < 80; ++tick)
    {
        const auto victim = static_cast<std::size_t>(tick / 20);
        if (tick % 20 == 5)
            dGeomSetPosition(geoms[victim], extreme, 0, 0);
        if (tick % 20 == 9)
            dGeomSetPosition(geoms[victim], extreme, extreme, extreme);
        if (tick % 20 == 15)
            dGeomSetPosition(geoms[victim], 3, 0.2, 0);
        if (with_bodies)
            scene.step(0.02);
        else
            dGeomSetPosition(geoms[11], 11 - 0.1 * tick, 0, 0);
        scene.tick();
        scene.query(as_geom(scene.space()), geoms[victim]);
    }
}

TEST_F(Contract, 13_GeomsGoToExtremesAndComeBack)
{
    for (dReal extreme : extremes)
    {
        SCOPED_TRACE(extreme);
        expect_as_simple([=](Scenario &scene) { run_row(scene, extreme, false); });
    }
}

TEST_F(Contract, 13_BodiesGoToExtremesAndComeBack)
{
    for (dReal extreme : extremes)
    {
        SCOPED_TRACE(extreme);
        expect_as_simple([=](Scenario &scene) { run_row(scene, extreme, true); });
    }
}

// These also run in programs that trap invalid operations; see support/trapping.cpp.
TEST_F(Contract, 13_FiniteExtremes)
{
    for (dReal extreme : finite_extremes)
    {
        SCOPED_TRACE(extreme);
        expect_as_simple([=](Scenario &scene) { run_row(scene, extreme, false); });
        if (std::abs(extreme) <= 1e12) // farther out, ODE's step makes values that are not finite
            expect_as_simple([=](Scenario &scene) { run_row(scene, extreme, true); });
        expect_as_simple([=](Scenario &scene) {
            std::vector<dGeomID> boxes;
            for (int i = 0; i < 20; ++i)
            {
                boxes.push_back(scene.box(0.6, 0.5 * i, 0, 0));
                scene.body(boxes.back(), extreme, -extreme, 0.1 * i);
            }
            for (int tick = 0; tick < 20; ++tick)
            {
                dGeomSetPosition(boxes[static_cast<std::size_t>(tick)], 0.4 * tick, 0.1 * tick, 0);
                scene.tick();
            }
        });
    }
}

TEST_F(Contract, 13_ExtremeVelocities)
{
    for (dReal extreme : extremes)
    {
        SCOPED_TRACE(extreme);
        expect_as_simple([=](Scenario &scene) {
            std::vector<dBodyID> bodies;
            for (int i = 0; i < 10; ++i)
                bodies.push_back(scene.body(scene.sphere(0.6, i, 0, 0), 0.1 * i, 0, 0));
            for (int tick = 0; tick < 40; ++tick)
            {
                if (tick % 10 == 3)
                    dBodySetLinearVel(bodies[2], extreme, 0, 1);
                if (tick % 10 == 4)
                    dBodySetLinearVel(bodies[2], 0, 0, 0);
                if (tick % 10 == 7)
                    dBodySetPosition(bodies[2], 2, 0, 0);
                // The velocity seems right unless it is checked against the geom's motion.
                dBodySetLinearVel(bodies[5], tick % 2 ? extreme : 0, 0, 0);
                dBodySetPosition(bodies[5], 5 + 0.01 * tick, 0, 0);
                if (tick % 10 < 3)
                    dBodySetPosition(bodies[7], 7 - 0.1 * tick, 0, 0);
                scene.tick();
                dBodySetLinearVel(bodies[5], 0, 0, 0);
                scene.step(0.01);
                scene.tick();
            }
        });
    }
}

TEST_F(Contract, 13_ManyExtremeGeomsOfEveryKind)
{
    expect_as_simple([](Scenario &scene) {
        std::vector<dGeomID> geoms;
        for (int i = 0; i < 60; ++i)
        {
            geoms.push_back(scene.numbered(create_geom(static_cast<GeomKind>(i % 10), 1, scene.space())));
            dGeomSetPosition(geoms.back(), i % 8, i / 8, 0.1 * i);
        }
        scene.numbered(create_geom(GeomKind::plane, 1, scene.space()));
        for (int round = 0; round < 60; ++round)
        {
            for (std::size_t i = 0; i < 60; i += 7)
            {
                const std::size_t chosen = (i + static_cast<std::size_t>(round) * 11) % 60;
                const dReal extreme = extremes[(chosen + static_cast<std::size_t>(round)) % 9];
                dGeomSetPosition(geoms[chosen], round % 2 ? extreme : 1, extreme, round % 3 ? 0 : extreme);
                dGeomSetPosition(geoms[(chosen + 30) % 60], static_cast<dReal>(chosen % 8), round % 8, 1);
            }
            scene.tick();
        }
    });
}

TEST_F(Contract, 13_ExtremeSizes)
{
    for (dReal extreme : {infinite, dReal(1e12), huge, tiny})
    {
        SCOPED_TRACE(extreme);
        expect_as_simple([=](Scenario &scene) {
            dGeomID giant = scene.sphere(1, 3, 0, 0);
            for (int i = 0; i < 10; ++i)
                scene.sphere(0.3, i, 0, 0);
            for (int tick = 0; tick < 30; ++tick)
            {
                if (tick % 10 == 3)
                    dGeomSphereSetRadius(giant, extreme);
                if (tick % 10 == 8)
                    dGeomSphereSetRadius(giant, 1);
                dGeomSetPosition(giant, 3 + 0.1 * tick, 0, 0);
                scene.tick();
            }
        });
    }
}

TEST_F(Contract, 13_ExtremeGeomsInNestedSpaces)
{
    for (dReal extreme : extremes)
    {
        SCOPED_TRACE(extreme);
        expect_as_simple([=](Scenario &scene) {
            dSpaceID nested = scene.make_space(scene.space());
            scene.numbered(as_geom(nested));
            dGeomID first = scene.numbered(dCreateSphere(nested, 1));
            dGeomID second = scene.numbered(dCreateSphere(nested, 1));
            scene.sphere(1, 1, 0, 0);
            for (int tick = 0; tick < 24; ++tick)
            {
                dGeomSetPosition(first, tick % 6 < 3 ? extreme : 0.1 * tick, 0, 0);
                dGeomSetPosition(second, tick % 8 < 3 ? extreme : 0, 0.1 * tick, 0);
                scene.tick();
                scene.note(unordered(collide(nested)));
            }
        });
    }
}

// The sides of their boxes are beyond single precision, in which they would seem to overlap.
TEST_F(Contract, 13_SizesBeyondSinglePrecision)
{
    if (sizeof(dReal) == sizeof(float))
        return;
    for (const double radius : {1e39, 1e300})
        expect_as_simple([radius](Scenario &scene) {
            for (const double x : {0.0, 1.9, 4.0, 7.0})
                scene.sphere(static_cast<dReal>(radius), static_cast<dReal>(x * radius), 0, 0);
            scene.tick();
            scene.tick();
        });
}

TEST_F(Contract, 13_NothingIsLeftOutBySpheresForWantOfANumber)
{
    for (dReal extreme : extremes)
    {
        SCOPED_TRACE(extreme);
        Scenario scene(SpaceKind::predictive);
        dPredictiveSpaceSetProximity(scene.space(), dPredictiveProximitySphere);
        dGeomID mad = scene.sphere(0.5, 0, 0, 0);
        scene.body(mad, 0, 0, 0);
        dGeomID still = scene.sphere(0.5, 0, 0.2, 0);
        for (int tick = 0; tick < 20; ++tick)
        {
            dGeomSetPosition(mad, tick % 4 ? extreme : 0, tick % 4 == 2 ? extreme : 0.01 * tick, 0);
            scene.tick();
            dContactGeom contact;
            if (dCollide(mad, still, 1, &contact, sizeof contact) > 0)
            {
                EXPECT_EQ(scene.log().back(), Pairs({{0, 1}})) << "tick " << tick;
            }
        }
    }
}

TEST_F(Contract, 13_OthersAreNotPoisoned)
{
    Scenario scene(SpaceKind::predictive);
    dGeomID mad = scene.sphere(0.5, 0, 0, 0);
    dGeomID mover = scene.sphere(0.5, 20, 0, 0);
    scene.sphere(0.5, 0, 50, 0);
    scene.body(mover, -1, 0, 0);
    for (int tick = 0; tick < 100; ++tick)
    {
        dGeomSetPosition(mad, tick < 50 ? nan_value : 1e12, 0, 0);
        scene.step(0.01);
        scene.tick();
    }
    dReal ticks = -1;
    EXPECT_EQ(dPredictiveSpaceGetTimeOfProximity(scene.space(), mover, dSpaceGetGeom(scene.space(), 0), &ticks) >> 1,
              0);
    EXPECT_FALSE(std::isnan(ticks));
    dGeomSetPosition(mad, dGeomGetPosition(mover)[0], 0, 0);
    scene.tick();
    EXPECT_EQ(scene.log().back(), Pairs({{0, 1}}));
}

dGeomID create_boxed(const std::array<dReal, 6> &box)
{
    static const int number = [] {
        dGeomClass description = {};
        description.bytes = sizeof box;
        description.collider = [](int) -> dColliderFn * { return nullptr; };
        description.aabb = [](dGeomID geom, dReal *bounds) {
            const auto *given = static_cast<const dReal *>(dGeomGetClassData(geom));
            for (int side = 0; side < 6; ++side)
                bounds[side] = given[side] + dGeomGetPosition(geom)[side / 2];
        };
        return dCreateGeomClass(&description);
    }();
    dGeomID geom = dCreateGeom(number);
    std::copy(box.begin(), box.end(), static_cast<dReal *>(dGeomGetClassData(geom)));
    return geom;
}

TEST_F(Contract, 13_SpacesOfGeomsWithoutAPlaceMeetWhatHasNoBounds)
{
    for (int count : {5, 300})
        for (bool planes_first : {true, false})
            expect_as_simple([=](Scenario &scene) {
                for (int i = 0; i < count; ++i)
                    scene.sphere(1, 3 * i, 0, 0);
                const auto add_boundless = [&] {
                    scene.numbered(dCreatePlane(scene.space(), REAL(0.6), REAL(0.8), 0, 0));
                    scene.sphere(1, nan_value, 0, 0);
                    scene.sphere(1, nan_value, nan_value, nan_value);
                };
                const auto add_nowhere = [&] {
                    dSpaceID nested = scene.make_space(scene.space());
                    number_geom(as_geom(nested), 1000);
                    dGeomSetPosition(dCreateSphere(nested, 1), nan_value, nan_value, nan_value);
                };
                planes_first ? add_boundless() : add_nowhere();
                scene.tick();
                scene.tick();
                planes_first ? add_nowhere() : add_boundless();
                scene.tick();
                scene.tick();
            });
}

TEST_F(Contract, 13_BoxesMayBeInsideOut)
{
    expect_as_simple([](Scenario &scene) {
        for (int i = 0; i < 100; ++i)
            for (int j = 0; j < 20; ++j)
                scene.sphere(1, 10 * i, 4 * j, 0);
        scene.add(scene.space(), scene.numbered(create_boxed({300, 700, 60, 20, -1, 1})));
        scene.box(500, 500, 40, 0);
        scene.tick();
        scene.tick();
    });
}

TEST_F(Contract, 13_BoxesThatAreInsideOutMayLeap)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID leaper = scene.numbered(create_boxed({1, -1, 1, -1, 1, -1}));
        scene.add(scene.space(), leaper);
        const int leaps = 11;
        scene.box(10, 10 * leaps * leaps - 1, 0, 0);
        for (int tick = 0; tick < 14; ++tick)
        {
            dGeomSetPosition(leaper, 10 * std::min(tick * tick, leaps * leaps), 0, 0);
            scene.tick();
        }
    });
}

TEST_F(Contract, 13_DeviationsMayHaveNoEnd)
{
    expect_as_simple([](Scenario &scene) {
        if (scene.kind() == SpaceKind::predictive)
            for (int role : {dPredictiveRoleEnvironment, dPredictiveRoleInteractive})
                dPredictiveSpaceSetDeviation(scene.space(), role, std::numeric_limits<dReal>::max(), 0, 0);
        dGeomID one = scene.sphere(1, 0, 0, 0), other = scene.sphere(1, 10, 0, 0);
        scene.sphere(5, 0, 0, 0);
        for (int tick = 0; tick < 12; ++tick)
        {
            scene.tick();
            const dReal far = tick < 6 ? 1e6 : 1e15;
            dGeomSetPosition(one, far, 0, 0);
            dGeomSetPosition(other, far + (tick < 6 ? REAL(1.9) + REAL(0.1) * tick : far / 10), 0, 0);
        }
    });
}

// ODE makes a matrix of NaNs from an infinite quaternion.
TEST_F(Contract, 13_BodiesMayLoseTheirRotation)
{
    expect_as_simple([](Scenario &scene) {
        std::vector<dBodyID> bodies;
        for (int i = 0; i < 50; ++i)
        {
            dGeomID geom = scene.numbered(dCreateBox(scene.space(), 1, 2, 3));
            dGeomSetPosition(geom, 100 * i, 0, 0);
            bodies.push_back(scene.body(geom, 0, 0, 0));
        }
        for (int tick = 0; tick < 30; ++tick)
        {
            for (int i = 0; i < 50; ++i)
                dBodySetPosition(bodies[static_cast<std::size_t>(i)], 100 * i, REAL(0.1) * tick, 0);
            if (tick == 25)
            {
                const dQuaternion infinite_one = {infinite, 0, 0, 0};
                dBodySetQuaternion(bodies[7], infinite_one);
            }
            scene.tick();
        }
    });
}
} // namespace
} // namespace ode_predictive_space
