// What is asked while many predictions are made in parts.

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
// A thousand balls that drift, far apart, and two beside them that will meet.
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

    // Until so many have left their paths that not all of them are predicted in one tick.
    void explode()
    {
        for (std::size_t i = 0; i < bodies.size(); ++i)
            dBodySetLinearVel(bodies[i], 0.1 * (static_cast<int>(i) % 7 - 3), 0.2 * (static_cast<int>(i) % 5 - 2), -1);
        const unsigned long scans = stats().scans;
        for (int tick = 0; tick < 20 && stats().scans == scans; ++tick)
            run(1);
        ASSERT_GT(stats().scans, scans);
        ASSERT_LT(stats().repredictions, 3u * balls);
    }

    void ask(int questions)
    {
        dGeomID probe = dCreateSphere(nullptr, 1);
        for (int i = 0; i < questions; ++i)
        {
            dGeomSetPosition(probe, i % 10, i % 9, i % 8);
            collide2(as_geom(space), probe);
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
    explode();
    dReal ticks = 0;
    EXPECT_EQ(dPredictiveSpaceGetTimeOfProximity(space, left, right, &ticks), 1);
    EXPECT_NEAR(ticks, 95, 15);
    dPredictiveEncounter met[4];
    ASSERT_EQ(dPredictiveSpaceGetEncounters(space, left, met, 4), 1);
    EXPECT_EQ(met[0].geom, right);
    EXPECT_EQ(met[0].ticks, ticks);
}

TEST_F(Explosion, WhoThenOnlyAsksGetsAnIndex)
{
    explode();
    const unsigned long predictions = stats().repredictions, scans = stats().scans;
    ask(10);
    EXPECT_EQ(stats().repredictions, predictions) << "a few questions are not worth it";
    ask(90);
    EXPECT_GT(stats().repredictions, predictions + balls / 2);
    EXPECT_EQ(stats().scans, scans) << "no part is left over";
    EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
}

TEST_F(Explosion, OfNewGeomsIsWatchedFirstHoweverMuchWasAskedBefore)
{
    for (int i = 0; i < 3 * balls; ++i)
        add(balls + i);
    collide(space);
    ask(100);
    const unsigned long scans = stats().scans;
    run(3);
    EXPECT_EQ(stats().scans, scans) << "there is an index";
    for (int i = 0; i < 6 * balls; ++i)
        add(4 * balls + i);
    collide(space);
    EXPECT_GT(stats().scans, scans);
}
} // namespace
} // namespace ode_predictive_space
