// Queries when most geoms have just left their envelopes, so that all were swept and there is no tree.

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
class Explosion : public OdeTest
{
protected:
    static constexpr int balls = 1000;

    Explosion()
    {
        left = scene.sphere(0.5, -10, -10, -10);
        right = scene.sphere(0.5, -8.6, -10, -10);
        scene.body(left, 1, 0, 0);
        scene.body(right, -1, 0, 0);
        for (int i = 0; i < balls; ++i)
            add(i);
        run(100);
    }

    void add(int number)
    {
        dGeomID ball = scene.sphere(0.1, 3 * (number % 10), 3 * (number / 10 % 10), 3 * (number / 100));
        bodies.push_back(scene.body(ball, 0.01, 0.02, 0.03));
    }

    void run(int ticks)
    {
        for (int tick = 0; tick < ticks; ++tick)
        {
            scene.step(step);
            collide(space);
        }
    }

    void explode()
    {
        for (dBodyID body : bodies)
        {
            const dReal *position = dBodyGetPosition(body);
            dBodySetPosition(body, position[0] + 100, position[1], position[2]);
        }
        const unsigned long scans = stats().scans;
        run(1);
        ASSERT_EQ(stats().scans, scans + 1);
    }

    void ask(int questions)
    {
        dGeomID probe = dCreateSphere(nullptr, 1);
        for (int i = 0; i < questions; ++i)
        {
            dGeomSetPosition(probe, 100 + 3 * (i % 10), 3 * (i % 9), 3 * (i % 8));
            ASSERT_EQ(collide2(as_geom(space), probe).size(), 1u) << i;
        }
        dGeomDestroy(probe);
    }

    dPredictiveSpaceStats stats() const
    {
        dPredictiveSpaceStats result;
        dPredictiveSpaceGetStats(space, &result);
        return result;
    }

    static constexpr double step = 0.001;
    Scenario scene{SpaceKind::predictive};
    dSpaceID space = scene.space();
    dGeomID left, right;
    std::vector<dBodyID> bodies;
};

TEST_F(Explosion, HidesNoEncounterOfThoseThatKeepTheirPaths)
{
    dPredictiveSpaceGetEncounters(space, left, nullptr, 0); // starts the sampling of their motion
    run(1);
    explode();
    dReal ticks = 0;
    EXPECT_EQ(dPredictiveSpaceGetTimeOfProximity(space, left, right, &ticks), 1);
    EXPECT_NEAR(ticks, 95, 15);
    dPredictiveEncounter met[4];
    ASSERT_EQ(dPredictiveSpaceGetEncounters(space, left, met, 4), 1);
    EXPECT_EQ(met[0].geom, right);
    EXPECT_EQ(met[0].ticks, ticks);
}

TEST_F(Explosion, WhoThenAsksGetsAnIndex)
{
    explode();
    const dPredictiveSpaceStats before = stats();
    ask(100);
    EXPECT_EQ(stats().repredictions, before.repredictions) << "all envelopes are there";
    EXPECT_EQ(stats().scans, before.scans);
    EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
    run(10);
    ask(100);
    EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
}
} // namespace
} // namespace ode_predictive_space
