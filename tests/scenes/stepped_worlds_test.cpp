// The worlds that steps and contacts move: what each promises.

#include "demos/runs/spaces.h"
#include "demos/worlds/world.h"
#include "ode_predictive_space/space/ode_internals.h"

#include <gtest/gtest.h>
#include <set>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr int objects = 100;
constexpr int ticks = 150;

/// Where the geoms of a world are.
std::vector<Vector3> positions(const World &world)
{
    std::vector<Vector3> result;
    for (const dGeomID geom : world.geoms())
    {
        result.push_back(dGeomGetClass(geom) == dPlaneClass ? Vector3::Zero() : from_ode(dGeomGetPosition(geom)));
    }
    return result;
}

int moved_in_a_tick(const std::string &name)
{
    const WorldFactory factory({name, objects, 3});
    const OwnedSpace space(make_space(SpaceKind::simple, factory));
    const std::unique_ptr<World> world = factory.make(space.get());
    world->advance();
    const std::vector<Vector3> before = positions(*world);
    world->advance();
    const std::vector<Vector3> after = positions(*world);
    int moved = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
    {
        moved += before[i] != after[i] ? 1 : 0;
    }
    return moved;
}

TEST(SteppedWorld, MovesWhatItSays)
{
    const OdeSession ode;
    EXPECT_EQ(moved_in_a_tick("gas_stepped"), objects / 2);
    EXPECT_EQ(moved_in_a_tick("game_stepped"), objects);
    EXPECT_EQ(moved_in_a_tick("classes_stepped"), objects);
    EXPECT_EQ(moved_in_a_tick("settling"), objects);
    EXPECT_EQ(moved_in_a_tick("terrain_stepped"), objects + 2) << "and the airships; the cranes turn where they are";
    EXPECT_EQ(moved_in_a_tick("teleport_stepped"), objects);
    EXPECT_EQ(moved_in_a_tick("dart"), objects / 20);
    EXPECT_EQ(moved_in_a_tick("ask"), objects / 2);
}

TEST(SteppedWorld, ClassesHaveEveryClassThatAShapeHas)
{
    const OdeSession ode;
    const WorldFactory factory({"classes_stepped", objects, 3});
    const OwnedSpace space(make_space(SpaceKind::simple, factory));
    const std::unique_ptr<World> world = factory.make(space.get());
    std::set<int> classes;
    for (const dGeomID geom : world->geoms())
    {
        classes.insert(dGeomGetClass(geom));
    }
    EXPECT_EQ(classes,
              (std::set<int>{dSphereClass, dBoxClass, dCapsuleClass, dCylinderClass, dConvexClass, dTriMeshClass}));
}

TEST(SteppedWorld, DartSetsEveryPose)
{
    const OdeSession ode;
    const WorldFactory factory({"dart", objects, 3});
    const OwnedSpace space(make_space(SpaceKind::simple, factory));
    const std::unique_ptr<World> world = factory.make(space.get());
    PairList pairs;
    dSpaceCollide(space.get(), &pairs, &PairList::collect);
    for (const dGeomID geom : world->geoms())
    {
        ASSERT_EQ(geom->gflags & GEOM_DIRTY, 0u);
        EXPECT_EQ(dGeomGetBody(geom), nullptr);
    }
    world->advance();
    for (const dGeomID geom : world->geoms())
    {
        EXPECT_NE(geom->gflags & GEOM_DIRTY, 0u);
    }
}

/// Where the geoms are after some ticks in which the contacts are passed on, or not.
std::vector<Vector3> positions_after_ticks(const std::string &name, bool with_contacts)
{
    const WorldFactory factory({name, objects, 3});
    const OwnedSpace space(make_space(SpaceKind::simple, factory));
    const std::unique_ptr<World> world = factory.make(space.get());
    for (int tick = 0; tick < ticks; ++tick)
    {
        world->advance();
        PairList pairs;
        dSpaceCollide(space.get(), &pairs, &PairList::collect);
        world->respond(with_contacts ? pairs.sorted() : std::vector<IndexPair>());
    }
    return positions(*world);
}

TEST(SteppedWorld, ContactsChangeTheMotion)
{
    const OdeSession ode;
    for (const char *name :
         {"gas_stepped", "game_stepped", "classes_stepped", "pile", "settling", "stack", "terrain_stepped"})
    {
        EXPECT_NE(positions_after_ticks(name, true), positions_after_ticks(name, false)) << name;
    }
}

} // namespace
} // namespace ode_predictive_space::worlds
