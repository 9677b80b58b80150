// All worlds: the same motion in every space, the pairs of brute force, and their common promises.

#include "demos/worlds/spaces.h"
#include "tests/scenes/few_objects.h"
#include "tests/support/overlap.h"

#include <gtest/gtest.h>
#include <ode_predictive_space/predictive_space.h>

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
    Ticks(const std::string &space, const WorldFactory &factory)
        : space_(make_space(space, factory)), world_(factory.make(space_.get()))
    {}
    ~Ticks()
    {
        dSpaceSetCleanup(space(), 0);
        space_.reset();
    }
    Ticks(const Ticks &) = delete;
    Ticks &operator=(const Ticks &) = delete;

    /// In place of dSpaceCollide(), calls dSpaceCollide2() for the first of the world's queries, as a program that needs only
    /// what is near some geoms.
    void ask_only(std::size_t queries) { queries_ = queries; }

    std::vector<IndexPair> make()
    {
        PairList list;
        world_->advance();
        if (queries_ == 0)
            world_->collide(space(), &list, PairList::near);
        for (std::size_t i = 0; i < queries_; ++i)
            dSpaceCollide2(world_->queries()[i], reinterpret_cast<dGeomID>(space()), &list, &PairList::collect);
        list.drop_false_pairs(space());
        std::vector<IndexPair> pairs = list.sorted();
        world_->respond(pairs);
        return pairs;
    }

    const World &world() const { return *world_; }
    dSpaceID space() const { return space_.get(); }

private:
    OwnedSpace space_;
    std::unique_ptr<World> world_;
    std::size_t queries_ = 0; ///< 0: dSpaceCollide()
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
    for (const std::string &space : exact_spaces())
    {
        Ticks run(space, factory);
        std::size_t found = 0;
        for (int tick = 0; tick < ticks_of(GetParam()); ++tick)
        {
            const std::vector<IndexPair> pairs = run.make();
            found += pairs.size();
            ASSERT_EQ(pairs, pairs_by_brute_force(run.world(), run.space())) << space << ", tick " << tick;
        }
        EXPECT_GT(found, 0u) << space;
    }
}

/// In limit worlds, ODE's other spaces take minutes, or lose pairs.
std::vector<std::string> spaces_for(const std::string &name)
{
    return group_of(name) == Group::limit ? std::vector<std::string>{"simple", "predictive-box"} : all_spaces();
}

struct Life
{
    std::vector<std::vector<IndexPair>> pairs; ///< of each tick
    std::size_t contacts = 0;                  ///< summed over the ticks
};

Life live(const std::string &space, const WorldFactory &factory, int ticks)
{
    Life life;
    Ticks run(space, factory);
    run.ask_only(factory.spec().name == "ask" ? asking_spheres : 0);
    for (int tick = 0; tick < ticks; ++tick)
    {
        life.pairs.push_back(run.make());
        life.contacts += run.world().contacts();
        if (dSpaceIsPredictive(run.space()) != 0)
        {
            EXPECT_NE(dPredictiveSpaceValidate(run.space()), 0) << space << ", tick " << tick;
        }
    }
    return life;
}

/// @return the number of pairs in the first space.
std::size_t expect_the_same_in_all(const std::vector<std::string> &spaces, const WorldFactory &factory, int ticks)
{
    const Life first = live(spaces.front(), factory, ticks);
    std::size_t found = 0;
    for (const auto &pairs : first.pairs)
        found += pairs.size();
    for (std::size_t i = 1; i < spaces.size(); ++i)
    {
        const Life life = live(spaces[i], factory, ticks);
        EXPECT_EQ(life.contacts, first.contacts) << spaces[i];
        if (spaces[i] != "predictive-sphere" && spaces[i] != "predictive-shape")
        {
            EXPECT_TRUE(life.pairs == first.pairs) << spaces[i];
        }
    }
    return found;
}

TEST_P(AnyWorld, MovesInTheSameWayInEverySpace)
{
    const std::size_t found =
        expect_the_same_in_all(spaces_for(GetParam()), factory_of(GetParam()), ticks_of(GetParam()));
    EXPECT_TRUE(found > 0 || group_of(GetParam()) == Group::limit) << "nothing is compared";
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
    Ticks run("simple", factory);
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
    expect_the_same_in_all(spaces_for(GetParam()), WorldFactory({GetParam(), 1}), 50);
}
} // namespace
} // namespace ode_predictive_space::worlds
