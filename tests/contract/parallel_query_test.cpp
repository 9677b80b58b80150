// Contract 9 and 16: several threads query one space in which nothing moves.

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include <ode_predictive_space/predictive_space.h>

#include "ode_predictive_space/ode/internals.h"
#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Contract = OdeTest;

struct Past
{
    const char *name;
    std::function<void(Scenario &)> run;
};

void run_to_rest(Scenario &scene, int ticks)
{
    for (int tick = 0; tick < ticks; ++tick)
    {
        scene.step(0.01);
        collide(scene.space());
    }
}

const Past pasts[] = {
    {"never_asked", [](Scenario &) {}},
    {"asked_once", [](Scenario &scene) { collide2(dSpaceGetGeom(scene.space(), 0), as_geom(scene.space())); }},
    {"ticked", [](Scenario &scene) { run_to_rest(scene, 1); }},
    {"predicted", [](Scenario &scene) { run_to_rest(scene, 40); }},
    {"moved_since",
     [](Scenario &scene) {
         run_to_rest(scene, 40);
         scene.step(0.01);
     }},
};

template <typename Act> void in_threads(int count, Act act)
{
    std::atomic<int> ready{0};
    std::vector<std::thread> running;
    for (int i = 0; i < count; ++i)
        running.emplace_back([&, i] {
            const OdeThread ode;
            ++ready;
            while (ready < count)
                std::this_thread::yield();
            act(i);
        });
    for (std::thread &thread : running)
        thread.join();
}

class ParallelQuery : public OdeTest, public ::testing::WithParamInterface<std::tuple<Past, int>>
{
protected:
    static constexpr int side = 20, threads = 4, rounds = 3000;

    static void fill(Scenario &scene)
    {
        for (int i = 0; i < side * side; ++i)
        {
            const dReal x = i % side, y = i / side;
            dGeomID geom = i % 2 ? scene.sphere(0.4, x, y, 0.1 * (i % 7)) : scene.box(0.7, x, y, 0.1 * (i % 5));
            if (i % 3 == 0)
                scene.body(geom, 0.1, 0, 0.05 * (i % 4));
            if (i % 9 == 0)
                dGeomSetOffsetPosition(geom, 0.1, 0, 0.1);
        }
        dSpaceID nested = scene.make_space(scene.space());
        number_geom(as_geom(nested), 1000);
        for (int i = 0; i < 5; ++i)
        {
            dGeomID geom = scene.numbered(dCreateSphere(nested, 0.5));
            dGeomSetPosition(geom, 3 * i, 3 * i, 0.5);
        }
    }

    static std::vector<Pairs> ask(dSpaceID space, int first_place)
    {
        std::vector<Pairs> answers(rounds);
        dGeomID probe = number_geom(dCreateSphere(nullptr, 0.6), 5000);
        for (int round = 0; round < rounds; ++round)
        {
            const int place = (first_place + 7 * round) % (side * side);
            dGeomSetPosition(probe, place % side + 0.3, place / side + 0.2, 0.4);
            dSpaceCollide2(probe, as_geom(space), &answers[static_cast<std::size_t>(round)], note_and_descend);
        }
        dGeomDestroy(probe);
        for (Pairs &pairs : answers)
            pairs = unordered(pairs);
        return answers;
    }

    static void note_and_descend(void *data, dGeomID first, dGeomID second)
    {
        static_cast<Pairs *>(data)->push_back({geom_number(first), geom_number(second)});
        if (dGeomIsSpace(first) || dGeomIsSpace(second))
            dSpaceCollide2(first, second, data, note_and_descend);
    }
};

TEST_P(ParallelQuery, EachThreadGetsWhatASimpleSpaceReports)
{
    const auto &[past, proximity] = GetParam();
    Scenario scene(SpaceKind::predictive), reference(SpaceKind::simple);
    dPredictiveSpaceSetProximity(scene.space(), proximity);
    for (Scenario *each : {&scene, &reference})
    {
        fill(*each);
        past.run(*each);
    }

    std::vector<std::vector<Pairs>> answers(threads);
    in_threads(threads, [&](int i) { answers[static_cast<std::size_t>(i)] = ask(scene.space(), 31 * i); });

    for (int i = 0; i < threads; ++i)
    {
        const std::vector<Pairs> expected = ask(reference.space(), 31 * i);
        for (std::size_t round = 0; round < expected.size(); ++round)
        {
            // The sphere test leaves out pairs.
            Pairs &given = answers[static_cast<std::size_t>(i)][round];
            if (proximity == dPredictiveProximitySphere)
            {
                EXPECT_TRUE(std::includes(expected[round].begin(), expected[round].end(), given.begin(), given.end()));
                EXPECT_FALSE(given.empty());
            }
            else
            {
                EXPECT_EQ(given, expected[round]) << "thread " << i << ", round " << round;
            }
        }
    }
    EXPECT_EQ(scene.space()->lock_count, 0);
    EXPECT_EQ(dPredictiveSpaceValidate(scene.space()), 1);
    scene.sphere(1, 0, 0, 0);
    reference.sphere(1, 0, 0, 0);
    if (proximity == dPredictiveProximityBox)
    {
        EXPECT_EQ(unordered(collide(scene.space())), unordered(collide(reference.space())));
    }
}

TEST_P(ParallelQuery, SpacesAreAskedAgainstSpaces)
{
    const auto &[past, proximity] = GetParam();
    Scenario scene(SpaceKind::predictive), reference(SpaceKind::simple);
    dPredictiveSpaceSetProximity(scene.space(), proximity);
    const auto visit_places = [](Scenario &each) {
        dSpaceID visitors = each.make_space(nullptr);
        for (int i = 0; i < 30; ++i)
        {
            dGeomID geom = number_geom(dCreateBox(visitors, 1, 1, 1), 2000 + i);
            dGeomSetPosition(geom, i % 10 + 0.4, 2 * (i / 10) + 0.3, 0.2);
        }
        return visitors;
    };
    dSpaceID visitors[2];
    int number = 0;
    for (Scenario *each : {&scene, &reference})
    {
        fill(*each);
        visitors[number++] = visit_places(*each);
        past.run(*each);
    }

    std::vector<Pairs> answers(threads);
    in_threads(threads, [&](int i) {
        for (int round = 0; round < 300; ++round)
            answers[static_cast<std::size_t>(i)] = collide2(as_geom(visitors[0]), as_geom(scene.space()));
    });
    const Pairs expected = unordered(collide2(as_geom(visitors[1]), as_geom(reference.space())));
    for (const Pairs &given : answers)
    {
        EXPECT_FALSE(given.empty());
        if (proximity != dPredictiveProximitySphere)
        {
            EXPECT_EQ(unordered(given), expected);
        }
    }
    EXPECT_EQ(scene.space()->lock_count, 0);
    EXPECT_EQ(visitors[0]->lock_count, 0);
    for (dSpaceID each : visitors)
        dSpaceDestroy(each);
}

TEST_P(ParallelQuery, InquiriesAreAnsweredAsByOneThread)
{
    const auto &[past, proximity] = GetParam();
    Scenario scene(SpaceKind::predictive);
    dPredictiveSpaceSetProximity(scene.space(), proximity);
    fill(scene);
    past.run(scene);
    // The threads must not do this: dSpaceGetGeom() caches the last place in the list of the space.
    std::vector<dGeomID> geoms;
    for (int i = 0; i < dSpaceGetNumGeoms(scene.space()); ++i)
        geoms.push_back(dSpaceGetGeom(scene.space(), i));
    const auto encounters = [&](int i) {
        std::vector<int> met;
        for (int round = 0; round < 20; ++round)
        {
            dPredictiveEncounter out[40];
            dGeomID geom = geoms[static_cast<std::size_t>(3 * round + i)];
            const int count = dPredictiveSpaceGetEncounters(scene.space(), geom, out, 40);
            for (int k = 0; k < count; ++k)
                met.push_back(geom_number(out[k].geom));
            dReal ticks;
            met.push_back(dPredictiveSpaceGetTimeOfProximity(scene.space(), geom, geoms[0], &ticks));
        }
        return met;
    };
    std::vector<std::vector<int>> answers(threads);
    in_threads(threads, [&](int i) { answers[static_cast<std::size_t>(i)] = encounters(i); });
    for (int i = 0; i < threads; ++i)
        EXPECT_EQ(answers[static_cast<std::size_t>(i)], encounters(i)) << "thread " << i;
}

// The first query of a mesh makes its hull; other threads may be asking about the same mesh. No collide has needed a hull.
TEST_F(Contract, 16_HullsAreMadeByTheFirstOfManyQueries)
{
    constexpr int meshes = 300;
    std::vector<std::unique_ptr<OwnShapeData>> data; // each has a hull of its own
    Scenario scene(SpaceKind::predictive, Asked::nothing);
    dPredictiveSpaceSetProximity(scene.space(), dPredictiveProximityShape);
    for (int i = 0; i < meshes; ++i)
    {
        const dGeomID mesh = scene.numbered(create_geom(GeomKind::trimesh, 1, scene.space()));
        data.push_back(make_own_data(GeomKind::trimesh, 1));
        data.back()->give_to(mesh);
        dGeomSetPosition(mesh, 10 * i, 0, 0);
    }
    EXPECT_TRUE(collide(scene.space()).empty());
    const auto found = [&] {
        int pairs = 0;
        const dGeomID probe = number_geom(dCreateBox(nullptr, 1, 1, 1), meshes);
        for (int i = 0; i < meshes; ++i)
        {
            dGeomSetPosition(probe, 10 * i, 0, 0);
            pairs += static_cast<int>(collide2(probe, as_geom(scene.space())).size());
        }
        dGeomDestroy(probe);
        return pairs;
    };
    std::vector<int> answers(4);
    in_threads(4, [&](int i) { answers[static_cast<std::size_t>(i)] = found(); });
    EXPECT_EQ(answers, std::vector<int>(4, found()));
    EXPECT_GT(answers[0], 0);
}

std::string name_of(const ::testing::TestParamInfo<std::tuple<Past, int>> &info)
{
    static const char *const measures[] = {"box", "sphere", "shape"};
    return std::string(std::get<0>(info.param).name) + "_by_" + measures[std::get<1>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(Contract16, ParallelQuery,
                         ::testing::Combine(::testing::ValuesIn(pasts),
                                            ::testing::Values(dPredictiveProximityBox, dPredictiveProximitySphere,
                                                              dPredictiveProximityShape)),
                         name_of);
} // namespace
} // namespace ode_predictive_space
