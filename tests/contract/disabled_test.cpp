// Contract 1: disabled geoms are in no reported pair, cost no pairs, and take part from the tick at which they are enabled.

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Contract = OdeTest;

constexpr int crowd = 3000;

std::vector<dGeomID> disabled_crowd(Scenario &scene)
{
    std::vector<dGeomID> geoms;
    for (int i = 0; i < crowd; ++i)
    {
        geoms.push_back(scene.sphere(0.1, 1, 2, 3));
        dGeomDisable(geoms.back());
    }
    scene.body(scene.sphere(0.1, 0, 50, 0), 0.1, 0, 0);
    return geoms;
}

void run(Scenario &scene, int ticks)
{
    for (int i = 0; i < ticks; ++i)
    {
        scene.step(0.01);
        scene.note(unordered(collide(scene.space())));
    }
}

dPredictiveSpaceStats stats_of(const Scenario &scene)
{
    dPredictiveSpaceStats stats;
    dPredictiveSpaceGetStats(scene.space(), &stats);
    return stats;
}

TEST_F(Contract, 01_DisabledGeomsInOnePlaceFormNoPairs)
{
    for (bool asks : {false, true})
    {
        Scenario scene(SpaceKind::predictive);
        disabled_crowd(scene);
        for (int tick = 0; tick < 60; ++tick)
        {
            if (asks)
                dPredictiveSpaceGetEncounters(scene.space(), dSpaceGetGeom(scene.space(), 0), nullptr, 0);
            run(scene, 1);
            const dPredictiveSpaceStats stats = stats_of(scene);
            ASSERT_EQ(stats.near_pairs, 0u) << "tick " << tick;
            ASSERT_EQ(stats.scheduled, 0u) << "tick " << tick;
            ASSERT_LT(stats.bytes, 1024u * crowd) << "tick " << tick;
        }
        EXPECT_EQ(dPredictiveSpaceValidate(scene.space()), 1);
        EXPECT_EQ(stats_of(scene).reported, 0u);
    }
}

// After each of these numbers the space is in another state: it sweeps, or predicts a part of the scene, or all of it.
TEST_F(Contract, 01_EnabledGeomsHaveTheirPairsAtThatVeryTick)
{
    for (int ticks : {0, 1, 2, 4, 8, 16, 40})
        expect_as_simple([ticks](Scenario &scene) {
            const std::vector<dGeomID> geoms = disabled_crowd(scene);
            run(scene, ticks);
            for (std::size_t i = 500; i < 510; ++i)
                dGeomEnable(geoms[i]);
            run(scene, 1);
            for (std::size_t i = 505; i < 515; ++i)
                (dGeomIsEnabled(geoms[i]) ? dGeomDisable : dGeomEnable)(geoms[i]);
            run(scene, 1);
            dGeomEnable(geoms[600]);
            scene.note(unordered(collide(scene.space())));
            dGeomDisable(geoms[600]);
            scene.note(unordered(collide(scene.space())));
            run(scene, 2);
        });
}

TEST_F(Contract, 01_EnablingABodyEnablesItsGeomsAsInASimpleSpace)
{
    expect_as_simple([](Scenario &scene) {
        const std::vector<dGeomID> geoms = disabled_crowd(scene);
        std::vector<dBodyID> bodies;
        for (std::size_t i = 0; i < 20; ++i)
        {
            bodies.push_back(scene.body(geoms[i], 0, 0, 0));
            dBodyDisable(bodies.back());
        }
        run(scene, 10);
        for (dBodyID body : bodies)
            dBodyEnable(body);
        run(scene, 2);
        for (std::size_t i = 0; i < 10; ++i)
            dGeomEnable(geoms[i]);
        run(scene, 2);
        for (dBodyID body : bodies)
            dBodyDisable(body);
        run(scene, 2);
        for (std::size_t i = 0; i < 5; ++i)
            dGeomDisable(geoms[i]);
        run(scene, 2);
        dBodyEnable(bodies[0]);
        dBodyEnable(bodies[9]);
        run(scene, 40);
    });
}

TEST_F(Contract, 01_DisablingDropsThePairs)
{
    Scenario scene(SpaceKind::predictive);
    const std::vector<dGeomID> geoms = disabled_crowd(scene);
    for (std::size_t i = 0; i < 60; ++i)
        dGeomEnable(geoms[i]);
    run(scene, 100);
    EXPECT_EQ(scene.log().back().size(), 60u * 59u / 2u);
    for (std::size_t i = 10; i < 60; ++i)
        dGeomDisable(geoms[i]);
    run(scene, 100);
    EXPECT_EQ(scene.log().back().size(), 45u);
    EXPECT_EQ(stats_of(scene).near_pairs, 45u);
    EXPECT_EQ(dPredictiveSpaceValidate(scene.space()), 1);
}
struct Disabling
{
    bool second; // disable the second geom of the first callback, not the first
    dGeomID disabled = nullptr;
    int pairs_afterwards = 0;
};

void disable_in_first_callback(void *data, dGeomID first, dGeomID second)
{
    auto &disabling = *static_cast<Disabling *>(data);
    disabling.pairs_afterwards += first == disabling.disabled || second == disabling.disabled;
    if (!disabling.disabled)
    {
        disabling.disabled = disabling.second ? second : first;
        dGeomDisable(disabling.disabled);
    }
}

int pairs_of_a_geom_after_a_callback_disabled_it(dSpaceID space, bool second)
{
    for (int i = 0; i < 10; ++i)
        dCreateSphere(space, 1);
    Disabling disabling{second};
    dSpaceCollide(space, &disabling, &disable_in_first_callback);
    EXPECT_NE(disabling.disabled, nullptr);
    disabling.pairs_afterwards = 0;
    dSpaceCollide(space, &disabling, &disable_in_first_callback);
    EXPECT_EQ(disabling.pairs_afterwards, 0) << "in the next collide it has none in any space";
    dGeomEnable(disabling.disabled);
    disabling.disabled = nullptr;
    disabling.pairs_afterwards = 0;
    dSpaceCollide(space, &disabling, &disable_in_first_callback);
    dSpaceDestroy(space);
    return disabling.pairs_afterwards;
}

TEST_F(Contract, 01_AGeomThatACallbackDisablesHasNoFurtherPair)
{
    for (bool second : {false, true})
        EXPECT_EQ(pairs_of_a_geom_after_a_callback_disabled_it(dPredictiveSpaceCreate(nullptr), second), 0);
}

// The header and the FAQ state this of ODE's own spaces.
TEST_F(Contract, 01_OdesSpacesDifferAboutAGeomThatACallbackDisables)
{
    const dVector3 centre = {0, 0, 0}, extents = {10, 10, 10};
    const auto pairs = [&](bool second) {
        return std::vector<bool>{
            pairs_of_a_geom_after_a_callback_disabled_it(dSimpleSpaceCreate(nullptr), second) > 0,
            pairs_of_a_geom_after_a_callback_disabled_it(dQuadTreeSpaceCreate(nullptr, centre, extents, 3), second) > 0,
            pairs_of_a_geom_after_a_callback_disabled_it(dHashSpaceCreate(nullptr), second) > 0,
            pairs_of_a_geom_after_a_callback_disabled_it(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ), second) >
                0};
    };
    EXPECT_EQ(pairs(false), (std::vector<bool>{true, true, true, true}));
    EXPECT_EQ(pairs(true), (std::vector<bool>{false, false, true, true}));
}
} // namespace
} // namespace ode_predictive_space
