// Worlds as programs have them: every space reports in them what brute force finds, at every tick.

#include "tests/scenes/worlds/worlds.h"

#include "demos/scenes/scene_run.h"

#include <gtest/gtest.h>
#include <map>
#include <stdexcept>

namespace ode_predictive_space::scenes
{
namespace
{
/// More than a life of the worlds of "many", or than the time between events; few where there are thousands of rays.
int ticks_of(const std::string &name)
{
    if (name == "reset" || name == "recentre") // the later ticks are of the same worlds
        return ticks_between_events + 10;
    return name.find("lidar") == 0 ? 4 : ticks_of_life + 10;
}

int objects_of(const std::string &name)
{
    const std::map<std::string, int> few = {{"ragdolls", 3},     {"chain", 1}, {"city", 5},   {"nested", 6},
                                            {"nested_empty", 8}, {"many", 17}, {"lidar", 40}, {"lidar_nested", 40},
                                            {"hills", 250},      {"reset", 12}};
    const auto found = few.find(name);
    return found == few.end() ? 60 : found->second;
}

SceneFactory factory_of(const std::string &name)
{
    return world_factory({name, objects_of(name), 3});
}

bool may_collide(dGeomID first, dGeomID second)
{
    const dBodyID body = dGeomGetBody(first);
    return (body == nullptr || body != dGeomGetBody(second)) &&
           ((dGeomGetCategoryBits(first) & dGeomGetCollideBits(second)) != 0 ||
            (dGeomGetCategoryBits(second) & dGeomGetCollideBits(first)) != 0);
}

bool boxes_overlap(dGeomID first, dGeomID second)
{
    dReal a[6], b[6];
    dGeomGetAABB(first, a);
    dGeomGetAABB(second, b);
    return a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3] && a[4] <= b[5] && b[4] <= a[5];
}

/// Two geoms that are in the same space of a robot's own are not tested.
bool in_one_nested_space(dGeomID first, dGeomID second, dSpaceID outer)
{
    const dSpaceID space = dGeomGetSpace(first);
    return space != outer && space != nullptr && space == dGeomGetSpace(second) &&
           dGeomGetSpace(reinterpret_cast<dGeomID>(space)) == outer;
}

std::vector<IndexPair> pairs_by_brute_force(const Scene &scene, dSpaceID space)
{
    std::vector<IndexPair> pairs;
    const std::vector<dGeomID> &geoms = scene.geoms();
    for (std::uint32_t i = 0; i < geoms.size(); ++i)
    {
        for (std::uint32_t j = i + 1; j < geoms.size(); ++j)
        {
            if (may_collide(geoms[i], geoms[j]) && !in_one_nested_space(geoms[i], geoms[j], space) &&
                boxes_overlap(geoms[i], geoms[j]))
                pairs.emplace_back(i, j);
        }
    }
    return pairs;
}

/// A contender in a world, tick by tick.
class Ticks
{
public:
    Ticks(SpaceKind kind, const SceneFactory &factory)
        : contender_(make_contender(kind, factory)), scene_(factory.make(contender_->space()))
    {}
    ~Ticks()
    {
        dSpaceSetCleanup(contender_->space(), 0);
        contender_.reset();
    }
    Ticks(const Ticks &) = delete;
    Ticks &operator=(const Ticks &) = delete;

    std::vector<IndexPair> make()
    {
        PairList list;
        scene_->advance();
        scene_->collide(contender_->space(), list);
        contender_->finish(list);
        std::vector<IndexPair> pairs = list.sorted();
        scene_->respond(pairs);
        return pairs;
    }

    const Scene &scene() const { return *scene_; }
    dSpaceID space() const { return contender_->space(); }

private:
    std::unique_ptr<Contender> contender_;
    std::unique_ptr<Scene> scene_;
};

class Worlds : public testing::TestWithParam<std::string>
{
protected:
    OdeSession ode_;
};

INSTANTIATE_TEST_SUITE_P(All, Worlds, testing::ValuesIn(world_names()), [](const auto &name) { return name.param; });

TEST_P(Worlds, EachSpaceReportsWhatBruteForceFindsAtEveryTick)
{
    const SceneFactory factory = factory_of(GetParam());
    for (const SpaceKind kind : all_spaces())
    {
        Ticks run(kind, factory);
        std::size_t found = 0;
        for (int tick = 0; tick < ticks_of(GetParam()); ++tick)
        {
            const std::vector<IndexPair> pairs = run.make();
            found += pairs.size();
            ASSERT_EQ(pairs, pairs_by_brute_force(run.scene(), run.space())) << space_name(kind) << ", tick " << tick;
        }
        EXPECT_GT(found, 0u) << space_name(kind);
    }
}

std::vector<SpaceKind> spaces_with_all_measures()
{
    std::vector<SpaceKind> kinds = all_spaces();
    kinds.push_back(SpaceKind::predictive_by_spheres);
    kinds.push_back(SpaceKind::predictive_by_shapes);
    return kinds;
}

TEST_P(Worlds, MoveInTheSameWayInEverySpace)
{
    const SceneFactory factory = factory_of(GetParam());
    const SceneRuns runs = make_runs(spaces_with_all_measures(), factory);
    for (const auto &run : runs)
    {
        run->check_every_tick();
        run->turn(ticks_of(GetParam()));
        EXPECT_TRUE(run->invariant_held()) << run->name();
        EXPECT_EQ(run->contacts(), runs.front()->contacts()) << run->name();
    }
    EXPECT_EQ(first_difference(runs), -1);
}

TEST_P(Worlds, DescribeThemselves)
{
    EXPECT_FALSE(describe_world(GetParam()).empty());
    EXPECT_TRUE(is_world(GetParam()));
}

TEST(World, HasTheGeomsThatItSays)
{
    const OdeSession ode;
    const auto geoms = [](const std::string &name, int objects) {
        const SceneFactory factory = world_factory({name, objects, 1});
        const OwnedSpace space(make_space(SpaceKind::simple, factory));
        return factory.make(space.get())->geoms().size();
    };
    EXPECT_EQ(geoms("floor", 20), 21u) << "and the plane";
    EXPECT_EQ(geoms("ragdolls", 2), 2u * 12 + 12 + 1) << "and the stairs and the plane";
    EXPECT_EQ(geoms("chain", 2), 2u * 17 + 1);
    EXPECT_EQ(geoms("shelves", 100), 100u + 50 * 7 + 1);
    EXPECT_EQ(geoms("shelves_mesh", 100), 100u + 50 * 7 + 1);
    EXPECT_EQ(geoms("heap", 30), 35u) << "and the pit";
    EXPECT_EQ(geoms("drones", 30), 31u) << "and the room";
    EXPECT_EQ(geoms("city", 4), 4u * 5 + 4 * 5 + 1) << "and the trees and the hills";
    EXPECT_EQ(geoms("many", 17), 17u);
    EXPECT_EQ(geoms("nested", 3), 3u * 7 + 1);
    EXPECT_EQ(geoms("lidar", 50), 50u + 3600);
    EXPECT_EQ(geoms("moon", 5), 6u);
    EXPECT_EQ(geoms("reset", 3), 3u * 7);
    EXPECT_EQ(geoms("conveyor", 20), 20u + 10) << "and the boxes on the belt";
}

std::vector<Vector3> places_in(const Scene &scene)
{
    std::vector<Vector3> places;
    for (const dGeomID geom : scene.geoms())
        places.push_back(from_ode(dGeomGetPosition(geom)));
    return places;
}

TEST(World, RobotsAreSetBackOnceInAPeriod)
{
    const OdeSession ode;
    Ticks run(SpaceKind::simple, factory_of("reset"));
    run.make();
    const std::vector<Vector3> first = places_in(run.scene());
    for (int tick = 1; tick <= ticks_between_events; ++tick)
    {
        run.make();
        ASSERT_EQ(places_in(run.scene()) == first, tick == ticks_between_events) << tick;
    }
}

TEST(World, AllBoxesOrATenthOfTheBeltLeapAtOnce)
{
    const OdeSession ode;
    for (const bool belt : {false, true})
    {
        Ticks run(SpaceKind::simple, factory_of(belt ? "conveyor" : "recentre"));
        for (int tick = 0; tick <= ticks_between_events; ++tick)
        {
            const std::vector<Vector3> before = places_in(run.scene());
            run.make();
            int leaps = 0;
            for (std::size_t i = 0; i < before.size(); ++i)
                leaps += (places_in(run.scene())[i] - before[i]).norm() > 1 ? 1 : 0;
            ASSERT_EQ(leaps, belt ? 60 / 10 : tick % ticks_between_events == 0 ? 60 : 0) << tick;
        }
    }
}

TEST(World, AFifthOfTheRainFallsForEver)
{
    const OdeSession ode;
    Ticks run(SpaceKind::simple, factory_of("rain"));
    for (int tick = 0; tick < ticks_of("rain"); ++tick)
        run.make();
    int fallen = 0;
    for (const dGeomID geom : run.scene().geoms())
        fallen += dGeomGetPosition(geom)[2] < -100 ? 1 : 0;
    EXPECT_EQ(fallen, 60 / 5);
}

TEST(World, StepsVaryAsTheNameSays)
{
    const OdeSession ode;
    for (const char *name : {"frames_0", "frames_set_0", "frames_50", "frames_set_50"})
    {
        Ticks run(SpaceKind::simple, factory_of(name));
        const dGeomID geom = run.scene().geoms().front();
        double shortest = 1e9, longest = 0;
        Vector3 last = from_ode(dGeomGetPosition(geom));
        for (int tick = 0; tick < 40; ++tick)
        {
            run.make();
            const Vector3 now = from_ode(dGeomGetPosition(geom));
            if (tick > 0) // the setters place it before the first one
            {
                shortest = std::min(shortest, (now - last).norm());
                longest = std::max(longest, (now - last).norm());
            }
            last = now;
        }
        const bool varies = std::string(name).find("50") != std::string::npos;
        EXPECT_EQ(longest > 1.2 * shortest, varies) << name << ": " << shortest << " to " << longest;
    }
}

TEST(World, ManyBeginsAnewAfterALife)
{
    const OdeSession ode;
    Ticks run(SpaceKind::simple, factory_of("many"));
    std::vector<std::vector<IndexPair>> pairs;
    for (int tick = 0; tick < 2 * ticks_of_life; ++tick)
        pairs.push_back(run.make());
    EXPECT_TRUE(std::equal(pairs.begin(), pairs.begin() + ticks_of_life, pairs.begin() + ticks_of_life));
}

TEST(World, UnknownNamesAndNoObjectsAreRefused)
{
    EXPECT_FALSE(is_world("soup"));
    EXPECT_THROW(describe_world("soup"), std::invalid_argument);
    EXPECT_THROW(world_factory({"soup", 5, 1}), std::invalid_argument);
    EXPECT_THROW(world_factory({"floor", 0, 1}), std::invalid_argument);
}
} // namespace
} // namespace ode_predictive_space::scenes
