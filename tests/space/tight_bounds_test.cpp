// Objects that are tested by their bounding boxes, which are tighter than the boxes around their spheres.

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
// Rods side by side that drift together, so slowly that they stay near: the spheres around them overlap, but not their boxes.
class Rods : public OdeTest
{
protected:
    static constexpr int rods = 20;
    static constexpr int ticks = 600;

    unsigned long near_pairs_when_spinning(dReal spin)
    {
        std::vector<dBodyID> bodies;
        for (int i = 0; i < rods; ++i)
        {
            const dGeomID rod = scene.numbered(dCreateBox(space, 1, 0.1, 0.1));
            bodies.push_back(scene.body(rod, 0.01, 0, 0));
            dBodySetPosition(bodies.back(), 0, 0.3 * i, 0);
            dBodySetAngularVel(bodies.back(), spin, 0, 0);
        }
        for (int tick = 0; tick < ticks; ++tick)
        {
            scene.step(0.001);
            EXPECT_TRUE(collide(space).empty());
        }
        dPredictiveSpaceStats stats;
        dPredictiveSpaceGetStats(space, &stats);
        return stats.near_pairs;
    }

    Scenario scene{SpaceKind::predictive};
    dSpaceID space = scene.space();
};

TEST_F(Rods, ThatHardlyTurnAreToldApartByTheirBoxes)
{
    EXPECT_LT(near_pairs_when_spinning(0.05), rods / 4u);
}

TEST_F(Rods, ThatTurnAreToldApartByTheirBoxesToo)
{
    EXPECT_LT(near_pairs_when_spinning(5), rods / 4u);
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
