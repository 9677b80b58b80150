#include <random>

#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Contract = OdeTest;

TEST_F(Contract, 01_BoxesThatOnlyTouchAreAPair)
{
    expect_as_simple([](Scenario &scene) {
        scene.box(1, 0, 0, 0);
        dGeomID touching = scene.box(1, 1, 1, 1);
        scene.tick();
        EXPECT_EQ(scene.log().back(), Pairs({{0, 1}}));
        dGeomSetPosition(touching, std::nextafter(dReal(1), dReal(2)), 1, 1);
        scene.tick();
        EXPECT_TRUE(scene.log().back().empty());
        dGeomSetPosition(touching, 1, 1, 1);
        scene.tick();
    });
}

TEST_F(Contract, 01_BoxesThatComeToTouchWhileMovingAreAPair)
{
    expect_as_simple([](Scenario &scene) {
        scene.box(1, 0, 0, 0);
        dGeomID mover = scene.box(1, 5, 0, 0);
        // Steps of 1/64 are exact, so at one tick the faces touch without an overlap.
        for (int tick = 0; tick < 64 * 10; ++tick)
        {
            dGeomSetPosition(mover, 5 - tick / 64.0, 0, 0);
            scene.tick();
        }
    });
}

// Far from the origin, ODE's rounding makes some boxes overlap although the spheres do not touch, and vice versa.
TEST_F(Contract, 01_BoxesThatOverlapByRoundingAreAPair)
{
    expect_as_simple([](Scenario &scene) {
        constexpr int twos = 200;
        std::mt19937 random(7);
        std::uniform_real_distribution<dReal> size(0.5, 1.5);
        dGeomID mover = scene.sphere(0.5, 0, 0, 0);
        for (int i = 0; i < twos; ++i)
        {
            const dReal one = size(random), other = size(random), x = 3000 + 10 * i + size(random);
            scene.sphere(one, x, 0, 0);
            scene.sphere(other, x + (one + other), 0, 0);
        }
        for (int tick = 0; tick < 20; ++tick)
        {
            dGeomSetPosition(mover, tick, 0, 0);
            scene.tick();
        }
        EXPECT_GT(scene.log().back().size(), twos / 10u);
        EXPECT_LT(scene.log().back().size(), twos * 9 / 10u);
    });
}

TEST_F(Contract, 01_GeomsOfOneBodyAreNoPair)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID first = scene.box(1, 0, 0, 0);
        dGeomID second = scene.box(1, 0, 0, 0);
        scene.tick();
        dBodyID body = scene.body(first, 0, 0, 0);
        scene.tick();
        dGeomSetBody(second, body);
        scene.tick();
        EXPECT_TRUE(scene.log().back().empty());
        dGeomSetBody(first, nullptr);
        scene.tick();
        EXPECT_EQ(scene.log().back().size(), 1u);
    });
}

TEST_F(Contract, 01_BitsMatchInEitherDirection)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID first = scene.box(1, 0, 0, 0);
        dGeomID second = scene.box(1, 0.5, 0, 0);
        const unsigned long bits[][4] = {{1, 2, 2, 1},
                                         {1, 0, 0, 1},
                                         {1, 2, 4, 0},
                                         {2, 4, 8, 2},
                                         {0, 0, 0, 0},
                                         {1, 1, 2, 2},
                                         {~0UL, 0, 0, 0x80000000UL}};
        for (const auto &each : bits)
        {
            dGeomSetCategoryBits(first, each[0]);
            dGeomSetCollideBits(first, each[1]);
            dGeomSetCategoryBits(second, each[2]);
            dGeomSetCollideBits(second, each[3]);
            scene.tick();
        }
    });
}

TEST_F(Contract, 01_DisabledGeomsAreNotReported)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID first = scene.box(1, 0, 0, 0);
        scene.box(1, 0.5, 0, 0);
        scene.box(1, 0, 0.5, 0);
        for (int tick = 0; tick < 6; ++tick)
        {
            (tick % 2 ? dGeomDisable : dGeomEnable)(first);
            scene.tick();
            EXPECT_EQ(scene.log().back().size(), tick % 2 ? 1u : 3u);
        }
    });
}

TEST_F(Contract, 01_GeomsOfNoSizeAreNotReportedUntilTheyGrow)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID sphere = scene.sphere(0, 0, 0, 0);
        dGeomID box = scene.box(0, 0, 0, 0);
        scene.box(1, 0, 0, 0);
        scene.tick();
        EXPECT_TRUE(scene.log().back().empty());
        dGeomSphereSetRadius(sphere, 0.1);
        scene.tick();
        dGeomBoxSetLengths(box, 1, 1, 1);
        scene.tick();
        EXPECT_EQ(scene.log().back().size(), 3u);
        dGeomBoxSetLengths(box, 1, 0, 1);
        scene.tick();
        EXPECT_EQ(scene.log().back().size(), 1u);
    });
}

TEST_F(Contract, 01_TheTestOfAUserClassIsAskedOnBothSides)
{
    expect_as_simple([](Scenario &scene) {
        dGeomID first = scene.numbered(create_geom(GeomKind::user, 2, scene.space()));
        dGeomID second = scene.numbered(create_geom(GeomKind::user, 2, scene.space()));
        scene.box(0.1, 2.4, 0.9, 0.9);
        for (int tick = 0; tick < 50; ++tick)
        {
            dGeomSetPosition(first, 0.05 * tick, 0, 0);
            dGeomSetPosition(second, 1.9 - 0.01 * tick, 1.9 - 0.02 * tick, 1.9 - 0.05 * tick);
            scene.tick();
        }
    });
}

TEST_F(Contract, 01_ARandomCrowdOfAllKinds)
{
    expect_as_simple([](Scenario &scene) {
        std::mt19937 random(7);
        std::uniform_real_distribution<dReal> anywhere(-6, 6);
        std::vector<dGeomID> movers;
        for (int i = 0; i < 120; ++i)
        {
            const auto kind = static_cast<GeomKind>(i < 100 ? i % 10 : i % geom_kind_count);
            dGeomID geom = scene.numbered(create_geom(kind, 0.2 + 0.01 * i, scene.space()));
            if (is_placeable(kind))
                movers.push_back(geom);
        }
        for (dGeomID geom : movers)
            dGeomSetPosition(geom, anywhere(random), anywhere(random), anywhere(random));
        for (int tick = 0; tick < 100; ++tick)
        {
            for (std::size_t i = 0; i < movers.size(); i += 1 + tick % 3)
            {
                const dReal *position = dGeomGetPosition(movers[i]);
                dGeomSetPosition(movers[i], position[0] + 0.01 * anywhere(random), position[1],
                                 position[2] + 0.002 * static_cast<dReal>(i));
            }
            scene.tick();
        }
    });
}
} // namespace
} // namespace ode_predictive_space
