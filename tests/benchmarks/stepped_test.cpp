#include "tests/benchmarks/stepped/stepped_scenes.h"
#include "tests/benchmarks/stepped/windows.h"

#include "demos/scenes/scene_run.h"
#include "ode_predictive_space/space/ode_internals.h"

#include <gtest/gtest.h>
#include <set>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace scenes;

constexpr int objects = 100;
constexpr int ticks = 150;

class SteppedScenes : public testing::TestWithParam<std::string>
{
protected:
    SceneFactory factory() const { return SceneFactory(spec_of_stepped_scene(GetParam(), objects, 3)); }

    std::unique_ptr<SceneRun> run_in(SpaceKind kind, const SceneFactory &factory, int ticks) const
    {
        auto contender = scenes::make_contender(kind, factory);
        auto scene = make_stepped_scene(GetParam(), factory, contender->space());
        auto run = std::make_unique<SceneRun>(std::move(contender), std::move(scene));
        run->ask_only(queries_of_stepped_scene(GetParam()));
        run->check_every_tick();
        run->turn(ticks);
        return run;
    }

    OdeSession ode_;
};

INSTANTIATE_TEST_SUITE_P(Stepped, SteppedScenes, testing::ValuesIn(stepped_scene_names()),
                         [](const auto &name) { return name.param; });

TEST_P(SteppedScenes, GiveTheSamePairsInAllSpaces)
{
    const SceneFactory made = factory();
    SceneRuns runs;
    for (const SpaceKind kind : all_spaces())
    {
        runs.push_back(run_in(kind, made, ticks));
        EXPECT_TRUE(runs.back()->invariant_held());
        EXPECT_EQ(runs.back()->pair_hash(), runs.front()->pair_hash()) << runs.back()->name();
        EXPECT_EQ(runs.back()->contacts(), runs.front()->contacts()) << runs.back()->name();
    }
    EXPECT_EQ(first_difference(runs), -1);
    EXPECT_GT(runs.front()->pairs(), 0u);
    const auto by_spheres = run_in(SpaceKind::predictive_by_spheres, made, ticks);
    EXPECT_EQ(by_spheres->contacts(), runs.front()->contacts()) << "what touches is near";
}

TEST_P(SteppedScenes, DescribeThemselves)
{
    EXPECT_FALSE(describe_stepped_scene(GetParam()).empty());
}

/// Where the geoms of a scene are.
std::vector<Vector3> positions(const Scene &scene)
{
    std::vector<Vector3> result;
    for (const dGeomID geom : scene.geoms())
    {
        result.push_back(dGeomGetClass(geom) == dPlaneClass ? Vector3::Zero() : from_ode(dGeomGetPosition(geom)));
    }
    return result;
}

int moved_in_a_tick(const std::string &name)
{
    const SceneFactory factory(spec_of_stepped_scene(name, objects, 3));
    const OwnedSpace space(make_space(SpaceKind::simple, factory));
    const std::unique_ptr<Scene> scene = make_stepped_scene(name, factory, space.get());
    scene->advance();
    const std::vector<Vector3> before = positions(*scene);
    scene->advance();
    const std::vector<Vector3> after = positions(*scene);
    int moved = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
    {
        moved += before[i] != after[i] ? 1 : 0;
    }
    return moved;
}

TEST(SteppedScene, MovesWhatItSays)
{
    const OdeSession ode;
    EXPECT_EQ(moved_in_a_tick("gas"), objects / 2);
    EXPECT_EQ(moved_in_a_tick("game"), objects);
    EXPECT_EQ(moved_in_a_tick("classes"), objects);
    EXPECT_EQ(moved_in_a_tick("settling"), objects);
    EXPECT_EQ(moved_in_a_tick("terrain"), objects + 2) << "and the airships; the cranes turn where they are";
    EXPECT_EQ(moved_in_a_tick("teleport"), objects);
    EXPECT_EQ(moved_in_a_tick("dart"), objects / 20);
    EXPECT_EQ(moved_in_a_tick("ask"), objects / 2);
}

TEST(SteppedScene, ClassesHaveEveryClassThatAShapeHas)
{
    const OdeSession ode;
    const SceneFactory factory(spec_of_stepped_scene("classes", objects, 3));
    const OwnedSpace space(make_space(SpaceKind::simple, factory));
    const std::unique_ptr<Scene> scene = make_stepped_scene("classes", factory, space.get());
    std::set<int> classes;
    for (const dGeomID geom : scene->geoms())
    {
        classes.insert(dGeomGetClass(geom));
    }
    EXPECT_EQ(classes,
              (std::set<int>{dSphereClass, dBoxClass, dCapsuleClass, dCylinderClass, dConvexClass, dTriMeshClass}));
}

TEST(SteppedScene, DartSetsEveryPose)
{
    const OdeSession ode;
    const SceneFactory factory(spec_of_stepped_scene("dart", objects, 3));
    const OwnedSpace space(make_space(SpaceKind::simple, factory));
    const std::unique_ptr<Scene> scene = make_stepped_scene("dart", factory, space.get());
    PairList pairs;
    dSpaceCollide(space.get(), &pairs, &PairList::collect);
    for (const dGeomID geom : scene->geoms())
    {
        ASSERT_EQ(geom->gflags & GEOM_DIRTY, 0u);
        EXPECT_EQ(dGeomGetBody(geom), nullptr);
    }
    scene->advance();
    for (const dGeomID geom : scene->geoms())
    {
        EXPECT_NE(geom->gflags & GEOM_DIRTY, 0u);
    }
}

/// Where the geoms are after some ticks in which the contacts are passed on, or not.
std::vector<Vector3> positions_after_ticks(const std::string &name, bool with_contacts)
{
    const SceneFactory factory(spec_of_stepped_scene(name, objects, 3));
    const OwnedSpace space(make_space(SpaceKind::simple, factory));
    const std::unique_ptr<Scene> scene = make_stepped_scene(name, factory, space.get());
    for (int tick = 0; tick < ticks; ++tick)
    {
        scene->advance();
        PairList pairs;
        dSpaceCollide(space.get(), &pairs, &PairList::collect);
        scene->respond(with_contacts ? pairs.sorted() : std::vector<IndexPair>());
    }
    return positions(*scene);
}

TEST(SteppedScene, ContactsChangeTheMotion)
{
    const OdeSession ode;
    for (const char *name : {"gas", "game", "classes", "pile", "settling", "stack", "terrain"})
    {
        EXPECT_NE(positions_after_ticks(name, true), positions_after_ticks(name, false)) << name;
    }
}

TEST(SteppedScene, UnknownNamesAreRefused)
{
    EXPECT_THROW(describe_stepped_scene("soup"), std::invalid_argument);
    EXPECT_THROW(spec_of_stepped_scene("soup", 5, 1), std::invalid_argument);
}

TEST(Windows, DivideTheMeasuredTicks)
{
    Comparison whole;
    whole.results.resize(2);
    whole.results[0].times = {1, 2, 3, 4, 5};
    whole.results[0].clock_times = whole.results[0].times;
    whole.results[0].tick_times = {10, 20, 30, 40, 50};
    whole.results[0].ticks = 7; // two of them warm-up
    whole.results[0].pairs = 99;
    whole.results[1].times = whole.results[1].clock_times = whole.results[1].tick_times = {6, 7, 8};
    whole.results[1].ticks = 5;
    const std::vector<Comparison> windows = windows_of(whole, 2);
    ASSERT_EQ(windows.size(), 3u);
    EXPECT_EQ(windows[1].results[0].times, (std::vector<double>{3, 4}));
    EXPECT_EQ(windows[1].results[0].tick_times, (std::vector<double>{30, 40}));
    EXPECT_EQ(windows[1].results[0].ticks, 6u) << "up to the end of the window";
    EXPECT_EQ(windows[1].results[0].pairs, 99u) << "of the whole run";
    EXPECT_EQ(windows[1].results[1].times, (std::vector<double>{8}));
    EXPECT_EQ(windows[2].results[0].times, (std::vector<double>{5}));
    EXPECT_TRUE(windows[2].results[1].times.empty()) << "it was stopped before";
}
} // namespace
} // namespace ode_predictive_space::benchmarks
