#include "demos/scenes/scene.h"

#include "demos/scenes/kinematic_scenes.h"
#include "demos/scenes/mix_scene.h"
#include "demos/scenes/pile_scene.h"
#include "demos/scenes/query_scene.h"
#include "demos/scenes/stack_scene.h"
#include "demos/scenes/terrain_scene.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace ode_predictive_space::scenes
{
namespace
{
struct Description
{
    const char *name;
    const char *text;
};

constexpr Description descriptions[] = {
    {"gas", "half of the objects still, the others fly at up to 1 mm per tick and bounce off the walls"},
    {"game", "a dense room in which everything flies, at up to 10 mm per tick"},
    {"classes", "game with spheres, boxes, capsules, meshes, cylinders and convexes"},
    {"pile", "spheres and boxes that have settled in a pit, under gravity"},
    {"stack", "walls and towers of boxes, asleep until a heavy ball hits them, every two seconds"},
    {"terrain", "small movers on a heightfield, a mesh and a plane, among boxes up to 10,000 times as long"},
    {"still", "nothing moves"},
    {"probe", "one hand-driven probe among still objects"},
    {"mix", "half still, half moving, real contacts, some triangle meshes, a probe on a hand's path that pushes them"},
    {"churn", "gas in which 1 % of the objects are destroyed and made anew in each tick"},
    {"explosion", "a calm scene in which all velocities change in one tick, every 200 ticks"},
    {"teleport", "every object jumps to a random place in each tick"},
    {"query", "gas, with 20 spheres and 20 rays that ask in each tick what is near them"},
};
} // namespace

const std::vector<std::string> &scene_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> result;
        for (const Description &description : descriptions)
            result.emplace_back(description.name);
        return result;
    }();
    return names;
}

std::string describe_scene(const std::string &name)
{
    for (const Description &description : descriptions)
    {
        if (name == description.name)
            return description.text;
    }
    throw std::invalid_argument("there is no scene named \"" + name + "\"");
}

void Scene::collide(dSpaceID space, PairList &list)
{
    dSpaceCollide(space, &list, &PairList::collect);
}

const std::vector<dGeomID> &Scene::queries() const
{
    static const std::vector<dGeomID> none;
    return none;
}

SceneFactory::SceneFactory(const SceneSpec &spec) : spec_(spec)
{
    describe_scene(spec.name);
    if (spec.objects < 1)
        throw std::invalid_argument("a scene needs at least one object");
    if (spec.name == "pile" && spec.settled)
        settled_ = settle_pile(spec);
}

SceneFactory::SceneFactory(const SceneSpec &spec, SceneRecipe recipe) : spec_(spec), recipe_(std::move(recipe)) {}

SceneFactory::~SceneFactory() = default;
SceneFactory::SceneFactory(SceneFactory &&) noexcept = default;

std::unique_ptr<Scene> SceneFactory::make(dSpaceID space) const
{
    if (recipe_.make)
        return recipe_.make(spec_, space);
    if (spec_.name == "pile")
        return std::make_unique<PileScene>(spec_, space, settled_);
    if (spec_.name == "mix")
        return std::make_unique<MixScene>(spec_, space);
    if (spec_.name == "stack")
        return std::make_unique<StackScene>(spec_, space);
    if (spec_.name == "terrain")
        return std::make_unique<TerrainScene>(spec_, space);
    if (spec_.name == "query")
        return std::make_unique<QueryScene>(spec_, space);
    return make_kinematic_scene(spec_, space);
}

SceneBounds SceneFactory::bounds() const
{
    if (recipe_.make)
        return recipe_.bounds;
    if (spec_.name == "pile")
        return pile_bounds(spec_.objects);
    if (spec_.name == "stack")
        return stack_bounds(spec_.objects);
    if (spec_.name == "terrain")
        return terrain_bounds(spec_.objects);
    const double half = spec_.name == "mix" ? mix_half_room(spec_.objects) + wall_thickness
                                            : kinematic_half_room(spec_.name, spec_.objects);
    return {Vector3::Zero(), Vector3::Constant(half)};
}

double SceneFactory::tick_seconds() const
{
    if (recipe_.make)
        return recipe_.tick_seconds;
    if (spec_.name == "pile")
        return PileScene::step_seconds;
    return spec_.name == "stack" ? StackScene::step_seconds : usual_tick;
}
} // namespace ode_predictive_space::scenes
