// All scenes: the same motion in every space, and what they promise in common.

#include "tests/scenes/motion.h"

#include <gtest/gtest.h>
#include <stdexcept>

namespace ode_predictive_space::scenes
{
namespace
{
class AnyScene : public testing::TestWithParam<std::string>
{
protected:
    SceneSpec spec(std::uint64_t seed = 1) const { return {GetParam(), 100, seed}; }

    OdeSession ode_;
};

INSTANTIATE_TEST_SUITE_P(Scenes, AnyScene, testing::ValuesIn(scene_names()),
                         [](const auto &info) { return info.param; });

TEST_P(AnyScene, EverySpaceReportsTheSamePairs)
{
    const SceneRuns runs = make_runs(all_spaces(), SceneFactory(spec()));
    run_by_turns(runs, 500);
    EXPECT_EQ(first_difference(runs), -1);
    for (const auto &run : runs)
    {
        EXPECT_EQ(run->ticks(), 500u);
        EXPECT_GT(run->pairs(), 0u) << "nothing is compared where nothing meets";
        EXPECT_EQ(run->pair_hash(), runs.front()->pair_hash()) << run->name();
        EXPECT_EQ(run->contacts(), runs.front()->contacts()) << run->name();
    }
}

TEST_P(AnyScene, SameSeedSameRunAndAnotherSeedAnotherRun)
{
    SceneRun first(SpaceKind::hash, SceneFactory(spec(1)));
    SceneRun again(SpaceKind::hash, SceneFactory(spec(1)));
    SceneRun other(SpaceKind::hash, SceneFactory(spec(2)));
    for (int tick = 0; tick < 200; ++tick)
    {
        first.tick();
        again.tick();
        other.tick();
    }
    EXPECT_EQ(first.pair_hash(), again.pair_hash());
    EXPECT_NE(first.pair_hash(), other.pair_hash());
}

TEST_P(AnyScene, StaysWithinItsBounds)
{
    const SceneFactory factory(spec());
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    const std::unique_ptr<Scene> scene = factory.make(space.get());
    const SceneBounds bounds = factory.bounds();
    PairList pairs;
    for (int tick = 0; tick < 300; ++tick)
    {
        scene->advance();
        pairs.clear();
        dSpaceCollide(space.get(), &pairs, &PairList::collect);
        scene->respond(pairs.sorted());
        for (int i = 0; i < dSpaceGetNumGeoms(space.get()); ++i)
        {
            const dGeomID geom = dSpaceGetGeom(space.get(), i);
            if (!has_place(geom))
                continue;
            const Vector3 position = from_ode(dGeomGetPosition(geom));
            ASSERT_TRUE(((position - bounds.centre).cwiseAbs() - bounds.half_extent).maxCoeff() < 0.01)
                << "tick " << tick << ": " << position.transpose();
        }
    }
}

TEST_P(AnyScene, LeavesNothingInTheSpace)
{
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    {
        const std::unique_ptr<Scene> scene = SceneFactory(spec()).make(space.get());
        scene->advance();
        EXPECT_GE(dSpaceGetNumGeoms(space.get()), 100);
    }
    EXPECT_EQ(dSpaceGetNumGeoms(space.get()), 0);
}

TEST_P(AnyScene, TellsItsGeoms)
{
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    const std::unique_ptr<Scene> scene = SceneFactory(spec()).make(space.get());
    for (int tick = 0; tick < 20; ++tick)
        scene->advance();
    int alive = 0;
    for (const dGeomID geom : scene->geoms())
    {
        alive += geom != nullptr ? 1 : 0;
        EXPECT_TRUE(geom == nullptr || dSpaceQuery(space.get(), geom) != 0);
    }
    EXPECT_EQ(alive, dSpaceGetNumGeoms(space.get()));
}

TEST_P(AnyScene, HasADescription)
{
    EXPECT_FALSE(describe_scene(GetParam()).empty());
}

TEST(SceneFactory, RefusesUnknownScenesAndEmptyOnes)
{
    const OdeSession ode;
    EXPECT_THROW(SceneFactory({"soup", 10, 1}), std::invalid_argument);
    EXPECT_THROW(SceneFactory({"gas", 0, 1}), std::invalid_argument);
    EXPECT_THROW(space_named("octree"), std::invalid_argument);
}
} // namespace
} // namespace ode_predictive_space::scenes
