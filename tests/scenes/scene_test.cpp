// The scenes: the same motion in every space, the motion that they promise, and no other.

#include "demos/scenes/scene.h"
#include "demos/scenes/scene_run.h"

#include <gtest/gtest.h>
#include <map>
#include <set>
#include <stdexcept>

namespace ode_predictive_space::scenes
{
namespace
{
/// Whether a geom is somewhere: a plane is not.
bool has_place(dGeomID geom)
{
    return dGeomGetClass(geom) != dPlaneClass;
}

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
            {
                continue;
            }
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
    {
        scene->advance();
    }
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

TEST(MixScene, LeavesTheProbeToWhoBringsOne)
{
    const OdeSession ode;
    SceneSpec spec{"mix", 40, 1};
    SceneRun with(SpaceKind::simple, SceneFactory(spec));
    spec.own_probe = false;
    SceneRun without(SpaceKind::simple, SceneFactory(spec));
    EXPECT_EQ(dSpaceGetNumGeoms(without.contender().space()) + 1, dSpaceGetNumGeoms(with.contender().space()));
    for (int tick = 0; tick < 200; ++tick)
    {
        without.tick();
    }
    EXPECT_NE(with.scene().probe(), nullptr);
    EXPECT_EQ(without.scene().probe(), nullptr);
    EXPECT_GT(without.contacts(), 0u) << "walls and objects still touch";
}

/// A scene and the places of its geoms, by their numbers.
class Motion
{
public:
    explicit Motion(const SceneSpec &spec) : scene_(SceneFactory(spec).make(space_.get())) {}

    void advance()
    {
        before_ = places();
        scene_->advance();
        after_ = places();
    }

    std::map<std::uint32_t, Vector3> places() const
    {
        std::map<std::uint32_t, Vector3> result;
        for (int i = 0; i < dSpaceGetNumGeoms(space_.get()); ++i)
        {
            const dGeomID geom = dSpaceGetGeom(space_.get(), i);
            if (has_place(geom))
            {
                result[geom_index(geom)] = from_ode(dGeomGetPosition(geom));
            }
        }
        return result;
    }

    /// Geoms that are elsewhere since the last advance().
    int moved() const
    {
        int count = 0;
        for (const auto &[index, place] : after_)
        {
            const auto old = before_.find(index);
            count += old != before_.end() && old->second != place ? 1 : 0;
        }
        return count;
    }

    /// The farthest way of a geom in the last advance().
    double longest_way() const
    {
        double longest = 0;
        for (const auto &[index, place] : after_)
        {
            const auto old = before_.find(index);
            longest = old == before_.end() ? longest : std::max(longest, (place - old->second).norm());
        }
        return longest;
    }

    /// Geoms that are there after the last advance(), but were not before.
    int made() const
    {
        int count = 0;
        for (const auto &[index, place] : after_)
        {
            count += before_.count(index) == 0 ? 1 : 0;
        }
        return count;
    }

    const std::map<std::uint32_t, Vector3> &before() const { return before_; }
    const std::map<std::uint32_t, Vector3> &after() const { return after_; }
    dSpaceID space() const { return space_.get(); }
    const Scene &scene() const { return *scene_; }

private:
    OdeSession ode_;
    OwnedSpace space_{dSimpleSpaceCreate(nullptr)};
    std::unique_ptr<Scene> scene_;
    std::map<std::uint32_t, Vector3> before_;
    std::map<std::uint32_t, Vector3> after_;
};

TEST(Gas, HalfMovesAtNoMoreThanAHundredthOfTheRadiusPerTick)
{
    Motion motion({"gas", 100, 1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 50);
    EXPECT_LE(motion.longest_way(), 0.01 * object_radius * 1.0001);
    EXPECT_GT(motion.longest_way(), 0.005 * object_radius);
}

TEST(Gas, TheShareThatMovesCanBeChosen)
{
    Motion motion({"gas", 100, 1, 0.1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 10);
}

TEST(Gas, WhatMovesHasABodyAndTheVelocityOfItsMotion)
{
    Motion motion({"gas", 100, 1});
    motion.advance();
    int bodies = 0;
    for (int i = 0; i < dSpaceGetNumGeoms(motion.space()); ++i)
    {
        const dGeomID geom = dSpaceGetGeom(motion.space(), i);
        const Vector3 way = motion.after().at(geom_index(geom)) - motion.before().at(geom_index(geom));
        if (const dBodyID body = dGeomGetBody(geom))
        {
            ++bodies;
            EXPECT_LT((0.001 * from_ode(dBodyGetLinearVel(body)) - way).norm(), 1e-12);
        }
        else
        {
            EXPECT_EQ(way.norm(), 0);
        }
    }
    EXPECT_EQ(bodies, 50);
}

TEST(Gas, BouncesOffTheWalls)
{
    Motion motion({"gas", 100, 1});
    const double half = SceneFactory({"gas", 100, 1}).bounds().half_extent.x();
    for (int tick = 0; tick < 5000; ++tick)
    {
        motion.advance();
    }
    for (const auto &[index, place] : motion.after())
    {
        EXPECT_LT(place.cwiseAbs().maxCoeff(), half) << "geom " << index;
    }
    EXPECT_EQ(motion.moved(), 50);
}

TEST(Game, AllMoveAtNoMoreThanATenthOfTheRadiusPerTick)
{
    Motion motion({"game", 100, 1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 100);
    EXPECT_LE(motion.longest_way(), 0.1 * object_radius * 1.0001);
    EXPECT_GT(motion.longest_way(), 0.05 * object_radius);
}

TEST(Still, NothingMoves)
{
    Motion motion({"still", 100, 1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 0);
}

TEST(ProbeScene, TheProbeMovesAndNothingElse)
{
    Motion motion({"probe", 100, 1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 1);
    EXPECT_NE(motion.before().at(0), motion.after().at(0)) << "the probe has number 0";
    ASSERT_NE(motion.scene().probe(), nullptr);
    EXPECT_EQ(motion.scene().probe()->position, motion.after().at(0));
}

TEST(Churn, OneInAHundredIsReplacedInEachTick)
{
    Motion motion({"churn", 200, 1});
    for (int tick = 0; tick < 20; ++tick)
    {
        motion.advance();
        EXPECT_EQ(motion.after().size(), 200u);
        EXPECT_GE(motion.made(), 1);
        EXPECT_LE(motion.made(), 2);
    }
    EXPECT_EQ(motion.after().rbegin()->first, 200u + 20 * 2 - 1) << "numbers are not given twice";
}

TEST(Churn, ASmallSceneSavesUpFractions)
{
    Motion motion({"churn", 20, 1});
    int made = 0;
    for (int tick = 0; tick < 52; ++tick)
    {
        motion.advance();
        made += motion.made();
    }
    EXPECT_EQ(made, 10);
}

TEST(Explosion, AllVelocitiesChangeInOneTickOutOfTwoHundred)
{
    Motion motion({"explosion", 60, 1});
    std::map<std::uint32_t, Vector3> last_way;
    int ticks_of_change = 0;
    for (int tick = 1; tick <= 450; ++tick)
    {
        motion.advance();
        int changed = 0;
        for (const auto &[index, place] : motion.after())
        {
            const Vector3 way = place - motion.before().at(index);
            changed += tick > 1 && (way - last_way[index]).norm() > 1e-12 ? 1 : 0;
            last_way[index] = way;
        }
        if (changed > 50)
        {
            ++ticks_of_change;
            EXPECT_EQ(tick % 200, 0);
        }
    }
    EXPECT_EQ(ticks_of_change, 2);
}

TEST(Teleport, EverythingJumps)
{
    Motion motion({"teleport", 100, 1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 100);
    EXPECT_GT(motion.longest_way(), 5 * object_radius);
}

TEST(Pile, HasSettled)
{
    const OdeSession ode;
    SceneRun pile(SpaceKind::simple, SceneFactory({"pile", 60, 1}));
    for (int tick = 0; tick < 100; ++tick)
    {
        pile.tick();
    }
    EXPECT_GT(pile.contacts(), 100u * 60u) << "each object touches others";
    Motion motion({"pile", 60, 1});
    motion.advance();
    EXPECT_LT(motion.longest_way(), 0.1 * object_radius);
}

/// Bodies of the space's geoms that are not disabled.
int awake_bodies(dSpaceID space)
{
    int awake = 0;
    for (int i = 0; i < dSpaceGetNumGeoms(space); ++i)
    {
        const dBodyID body = dGeomGetBody(dSpaceGetGeom(space, i));
        awake += body != nullptr && dBodyIsEnabled(body) != 0 ? 1 : 0;
    }
    return awake;
}

TEST(Stack, SleepsUntilTheBallHitsAndThenAPartOfItSleepsOn)
{
    const OdeSession ode;
    const SceneFactory factory({"stack", 192, 1});
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    const std::unique_ptr<Scene> scene = factory.make(space.get());
    PairList pairs;
    int before_throw = 0;
    int most_after = 0;
    for (int tick = 0; tick < 3 * 400; ++tick)
    {
        scene->advance();
        pairs.clear();
        dSpaceCollide(space.get(), &pairs, &PairList::collect);
        scene->respond(pairs.sorted());
        const int awake = awake_bodies(space.get());
        before_throw = tick == 89 ? awake : before_throw;
        most_after = tick > 490 ? std::max(most_after, awake) : most_after;
    }
    EXPECT_LE(before_throw, 10) << "walls and towers are at rest";
    EXPECT_GE(most_after, 10) << "later throws hit something, too";
    EXPECT_LE(most_after, 150);
}

TEST(Terrain, AllObjectsMoveAtNoMoreThanFiveMillimetresPerTickAndMostBoxesDoNot)
{
    Motion motion({"terrain", 100, 1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 100 + 2) << "the airships move; the cranes turn in place";
    EXPECT_LE(motion.longest_way(), 0.0055);
    EXPECT_GT(motion.longest_way(), 0.003);
}

TEST(Terrain, WhatRollsTouchesTheGround)
{
    Motion motion({"terrain", 100, 1});
    for (int tick = 0; tick < 500; ++tick)
    {
        motion.advance();
    }
    PairList pairs;
    dSpaceCollide(motion.space(), &pairs, &PairList::collect);
    std::set<std::uint32_t> on_ground;
    for (const auto &[first, second] : pairs.sorted())
    {
        on_ground.insert(first < 3 ? second : 0);
    }
    EXPECT_GE(on_ground.size(), 50u) << "half of the objects roll; the ground has the numbers 0 to 2";
}

TEST(Terrain, ItsLargestBoxIsTenThousandTimesAsLongAsAnObject)
{
    Motion motion({"terrain", 100, 1});
    double largest = 0;
    double smallest = dInfinity;
    for (int i = 0; i < dSpaceGetNumGeoms(motion.space()); ++i)
    {
        const dGeomID geom = dSpaceGetGeom(motion.space(), i);
        if (dGeomGetClass(geom) == dBoxClass)
        {
            dVector3 sides;
            dGeomBoxGetLengths(geom, sides);
            largest = std::max(largest, sides[0]);
            smallest = std::min(smallest, sides[0]);
        }
    }
    EXPECT_GE(largest, 1e4 * smallest);
}

TEST(Query, ProbesAndRaysAskInNoSpaceAndFindTheSameInEverySpace)
{
    const OdeSession ode;
    const SceneFactory factory({"query", 500, 1});
    std::vector<std::uint64_t> hashes;
    for (const SpaceKind kind : all_spaces())
    {
        const OwnedSpace space(make_space(kind, factory));
        const std::unique_ptr<Scene> scene = factory.make(space.get());
        ASSERT_EQ(scene->queries().size(), 40u);
        PairHash hash;
        PairList pairs;
        std::size_t found = 0;
        for (int tick = 0; tick < 100; ++tick)
        {
            scene->advance();
            pairs.clear();
            for (const dGeomID query : scene->queries())
            {
                ASSERT_EQ(dGeomGetSpace(query), nullptr);
                dSpaceCollide2(query, reinterpret_cast<dGeomID>(space.get()), &pairs, &PairList::collect);
            }
            pairs.drop_pairs_apart();
            hash.add_tick(hash_pairs(pairs.sorted()));
            found += pairs.size();
        }
        EXPECT_GT(found, 1000u);
        hashes.push_back(hash.value());
        EXPECT_EQ(hashes.back(), hashes.front()) << space_name(kind);
    }
}

TEST(Query, OtherScenesAskNothing)
{
    const OdeSession ode;
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    EXPECT_TRUE(SceneFactory({"gas", 10, 1}).make(space.get())->queries().empty());
}

TEST(Mix, ObjectsKeepFloatingAndTheProbeTouchesSome)
{
    const OdeSession ode;
    SceneRun mix(SpaceKind::simple, SceneFactory({"mix", 60, 1}));
    for (int tick = 0; tick < 3000; ++tick)
    {
        mix.tick();
    }
    const ProbeLog &log = mix.probe_log();
    EXPECT_FALSE(log.touched.empty());
    EXPECT_GT(log.max_force, 0);
    EXPECT_LE(log.max_force, 7.9 * (1 + 1e-12));
    EXPECT_LT(log.ticks_in_touch, 3000u);

    Motion motion({"mix", 60, 1});
    motion.advance();
    EXPECT_EQ(motion.moved(), 30 + 1) << "half of the objects, and the probe";
}
} // namespace
} // namespace ode_predictive_space::scenes
