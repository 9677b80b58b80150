// All worlds: the same motion in every space, the pairs of brute force, and their common promises.

#include "demos/runs/world_run.h"
#include "tests/scenes/few_objects.h"
#include "tests/support/overlap.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::worlds
{
namespace
{
Group group_of(const std::string &name)
{
    return world_named(name).group;
}

/// More than a life of the worlds of "many", or than the time between events; few for thousands of rays.
int ticks_of(const std::string &name)
{
    if (name == "reset" || name == "recentre") // the later ticks are of the same worlds
        return ticks_between_events + 10;
    if (name.find("lidar") == 0)
        return 4;
    const std::map<Group, int> usual = {
        {Group::scene, 500}, {Group::stepped, 150}, {Group::program, ticks_of_life + 10}, {Group::limit, 50}};
    return usual.at(group_of(name));
}

WorldFactory factory_of(const std::string &name)
{
    return WorldFactory({name, objects_of(name), 3});
}

std::vector<std::string> names_of(const std::vector<Group> &groups)
{
    std::vector<std::string> names;
    for (const Group group : groups)
    {
        for (const std::string &name : world_names(group))
            names.push_back(name);
    }
    return names;
}

/// Two geoms in the same nested space of a robot are not tested.
bool in_one_nested_space(dGeomID first, dGeomID second, dSpaceID outer)
{
    const dSpaceID space = dGeomGetSpace(first);
    return space != outer && space != nullptr && space == dGeomGetSpace(second) &&
           dGeomGetSpace(reinterpret_cast<dGeomID>(space)) == outer;
}

std::vector<IndexPair> pairs_by_brute_force(const World &world, dSpaceID space)
{
    std::vector<IndexPair> pairs;
    const std::vector<dGeomID> &geoms = world.geoms();
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

class Ticks
{
public:
    Ticks(SpaceKind kind, const WorldFactory &factory)
        : contender_(make_contender(kind, factory)), world_(factory.make(contender_->space()))
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
        world_->advance();
        world_->collide(contender_->space(), &list, PairList::near);
        contender_->finish(list);
        std::vector<IndexPair> pairs = list.sorted();
        world_->respond(pairs);
        return pairs;
    }

    const World &world() const { return *world_; }
    dSpaceID space() const { return contender_->space(); }

private:
    std::unique_ptr<Contender> contender_;
    std::unique_ptr<World> world_;
};

class WorldsTest : public testing::TestWithParam<std::string>
{
protected:
    OdeSession ode_;
};

class AnyWorld : public WorldsTest
{};
class ProgramWorlds : public WorldsTest
{};
class Scenes : public WorldsTest
{};
class Limits : public WorldsTest
{};

std::string name_of(const testing::TestParamInfo<std::string> &info)
{
    return info.param;
}

INSTANTIATE_TEST_SUITE_P(All, AnyWorld,
                         testing::ValuesIn(names_of({Group::scene, Group::stepped, Group::program, Group::limit})),
                         name_of);
INSTANTIATE_TEST_SUITE_P(All, ProgramWorlds, testing::ValuesIn(world_names(Group::program)), name_of);
INSTANTIATE_TEST_SUITE_P(All, Scenes, testing::ValuesIn(world_names(Group::scene)), name_of);
INSTANTIATE_TEST_SUITE_P(All, Limits, testing::ValuesIn(world_names(Group::limit)), name_of);

TEST_P(ProgramWorlds, HaveInEachSpaceThePairsThatBruteForceFindsAtEveryTick)
{
    const WorldFactory factory = factory_of(GetParam());
    for (const SpaceKind kind : all_spaces())
    {
        Ticks run(kind, factory);
        std::size_t found = 0;
        for (int tick = 0; tick < ticks_of(GetParam()); ++tick)
        {
            const std::vector<IndexPair> pairs = run.make();
            found += pairs.size();
            ASSERT_EQ(pairs, pairs_by_brute_force(run.world(), run.space())) << space_name(kind) << ", tick " << tick;
        }
        EXPECT_GT(found, 0u) << space_name(kind);
    }
}

/// In limit worlds, ODE's other spaces take minutes, or lose pairs.
std::vector<SpaceKind> spaces_for(const std::string &name)
{
    if (group_of(name) == Group::limit)
        return {SpaceKind::simple, SpaceKind::predictive};
    std::vector<SpaceKind> kinds = all_spaces();
    kinds.push_back(SpaceKind::predictive_by_spheres);
    kinds.push_back(SpaceKind::predictive_by_shapes);
    return kinds;
}

TEST_P(AnyWorld, MovesInTheSameWayInEverySpace)
{
    const WorldFactory factory = factory_of(GetParam());
    const WorldRuns runs = make_runs(spaces_for(GetParam()), factory);
    for (const auto &run : runs)
    {
        run->ask_only(GetParam() == "ask" ? asking_spheres : 0);
        for (int tick = 0; tick < ticks_of(GetParam()); ++tick)
        {
            run->turn(1);
            if (run->contender().is_predictive())
            {
                EXPECT_NE(dPredictiveSpaceValidate(run->contender().space()), 0) << run->name() << ", tick " << tick;
            }
        }
        EXPECT_EQ(run->reported().contacts, runs.front()->reported().contacts) << run->name();
    }
    EXPECT_EQ(first_difference(runs), -1);
    EXPECT_TRUE(runs.front()->reported().pairs > 0 || group_of(GetParam()) == Group::limit) << "nothing is compared";
}

TEST_P(AnyWorld, LeavesNothingInTheSpace)
{
    const OwnedSpace space(dSimpleSpaceCreate(nullptr));
    {
        const std::unique_ptr<World> world = factory_of(GetParam()).make(space.get());
        world->advance();
        EXPECT_FALSE(world->geoms().empty());
    }
    EXPECT_EQ(dSpaceGetNumGeoms(space.get()), 0);
}

TEST_P(Scenes, StayWithinTheirBounds)
{
    const WorldFactory factory = factory_of(GetParam());
    const Bounds bounds = factory.bounds();
    Ticks run(SpaceKind::simple, factory);
    for (int tick = 0; tick < 300; ++tick)
    {
        run.make();
        for (const dGeomID geom : run.world().geoms())
        {
            if (geom == nullptr || dGeomGetClass(geom) == dPlaneClass)
                continue;
            const Vector3 position = from_ode(dGeomGetPosition(geom));
            ASSERT_TRUE(((position - bounds.centre).cwiseAbs() - bounds.half_extent).maxCoeff() < 0.01)
                << "tick " << tick << ": " << position.transpose();
        }
    }
}

TEST_P(Limits, HaveThePairsOfASimpleSpaceWithOneObject)
{
    const WorldFactory factory({GetParam(), 1});
    const WorldRuns runs = make_runs(spaces_for(GetParam()), factory);
    run_by_turns(runs, 50);
    EXPECT_EQ(first_difference(runs), -1);
}
} // namespace
} // namespace ode_predictive_space::worlds
