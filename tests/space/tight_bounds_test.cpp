// Who is predicted by its bounding box, which is tighter than the box around its sphere?

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
// Rods side by side that drift together, so slowly that they stay near each other: the spheres around them overlap, their
// boxes do not.
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
        return stats.near;
    }

    Scenario scene{SpaceKind::predictive};
    dSpaceID space = scene.space();
};

TEST_F(Rods, ThatHardlyTurnAreToldApartByTheirBoxes)
{
    EXPECT_LT(near_pairs_when_spinning(0.05), rods / 4u);
}

TEST_F(Rods, ThatTurnAreNotAsTheirBoxesWouldNotLast)
{
    EXPECT_GE(near_pairs_when_spinning(5), static_cast<unsigned long>(rods) - 1);
}
} // namespace
} // namespace ode_predictive_space
