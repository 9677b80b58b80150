// Objects that are tested by their bounding boxes, which are tighter than the boxes around their spheres.

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Rods = OdeTest;

// They drift side by side, so slowly that they stay near: the spheres around them overlap, but not their boxes.
TEST_F(Rods, AreToldApartByTheirBoxesHoweverTheyTurn)
{
    constexpr int rods = 20, ticks = 600;
    for (const dReal spin : {REAL(0.05), REAL(5.0)})
    {
        Scenario scene(SpaceKind::predictive);
        for (int i = 0; i < rods; ++i)
        {
            const dBodyID body = scene.body(scene.numbered(dCreateBox(scene.space(), 1, 0.1, 0.1)), 0.01, 0, 0);
            dBodySetPosition(body, 0, 0.3 * i, 0);
            dBodySetAngularVel(body, spin, 0, 0);
        }
        for (int tick = 0; tick < ticks; ++tick)
        {
            scene.step(0.001);
            EXPECT_TRUE(collide(scene.space()).empty());
        }
        dPredictiveSpaceStats stats;
        dPredictiveSpaceGetStats(scene.space(), &stats);
        EXPECT_LT(stats.near_pairs, rods / 4u) << spin;
    }
}

// A mesh has no known sphere, and its tight bounds would last for only some ticks.
TEST(Meshes, ThatTurnArePredictedForLong)
{
    constexpr int meshes = 10, ticks = 1000;
    Scenario scene(SpaceKind::predictive);
    for (int i = 0; i < meshes; ++i)
    {
        const dGeomID mesh = scene.numbered(dCreateTriMesh(scene.space(), mesh_data(1), nullptr, nullptr, nullptr));
        const dBodyID body = scene.body(mesh, 1, 0, 0);
        dBodySetPosition(body, 0, 10 * i, 0);
        dBodySetAngularVel(body, 5, 3, 1);
    }
    dPredictiveSpaceStats begin = {}, end = {};
    for (int tick = 0; tick < 2 * ticks; ++tick)
    {
        scene.step(0.001);
        scene.tick();
        if (tick == ticks)
            dPredictiveSpaceGetStats(scene.space(), &begin);
    }
    dPredictiveSpaceGetStats(scene.space(), &end);
    EXPECT_LT(end.repredictions - begin.repredictions, meshes * ticks / 100u);
    EXPECT_EQ(end.near_pairs, 0u);
}
} // namespace
} // namespace ode_predictive_space
