#include "tests/benchmarks/stepped/stepped_scenes.h"

#include "demos/scenes/query_scene.h"
#include "tests/benchmarks/stepped/floating_scenes.h"
#include "tests/benchmarks/stepped/rolling_scene.h"

#include <functional>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace scenes;

constexpr FloatingSettings gas = {0.5, 1};
constexpr FloatingSettings game = {1, 10};
constexpr FloatingSettings classes = {1, 10, 6};

struct Entry
{
    std::string name;
    std::string text;
    SceneSpec like; ///< the scene of the library that has its room
    std::function<std::unique_ptr<Scene>(const SceneFactory &, dSpaceID)> make;
};

SceneSpec falling_pile()
{
    SceneSpec spec{"pile"};
    spec.settled = false;
    return spec;
}

std::unique_ptr<Scene> make_as_it_is(const SceneFactory &factory, dSpaceID space)
{
    return factory.make(space);
}

template <typename StepScene> std::unique_ptr<Scene> make_scene_of(const SceneFactory &factory, dSpaceID space)
{
    return std::make_unique<StepScene>(factory.spec(), space);
}

template <const FloatingSettings &settings>
std::unique_ptr<Scene> make_floating(const SceneFactory &factory, dSpaceID space)
{
    return std::make_unique<FloatingScene>(factory.spec(), space, settings);
}

std::unique_ptr<Scene> make_asking(const SceneFactory &factory, dSpaceID space)
{
    return std::make_unique<QueryScene>(factory.spec(), make_floating<gas>(factory, space));
}

const std::vector<Entry> &entries()
{
    static const std::vector<Entry> all = {
        {"gas", "half of the objects still, the others float at up to 1 mm per tick", {"gas"}, &make_floating<gas>},
        {"game", "a dense room in which everything floats, at up to 10 mm per tick", {"game"}, &make_floating<game>},
        {"classes",
         "game with spheres, boxes, capsules, meshes, cylinders and convexes",
         {"classes"},
         &make_floating<classes>},
        {"pile", "spheres and boxes that have settled in a pit", {"pile"}, &make_as_it_is},
        {"settling", "the same from their drop on, in windows of 0.5 s", falling_pile(), &make_as_it_is},
        {"stack", "walls and towers of boxes, asleep until a heavy ball hits them", {"stack"}, &make_as_it_is},
        {"terrain",
         "objects driven over and above a ground, among huge boxes",
         {"terrain"},
         &make_scene_of<RollingScene>},
        {"teleport",
         "every object jumps to a random place after each step",
         {"teleport"},
         &make_scene_of<JumpingScene>},
        {"dart",
         "geoms without bodies; every pose is set at every tick, 5 % are new",
         {"gas"},
         &make_scene_of<PoseSettingScene>},
        {"ask", "gas without dSpaceCollide(): 20 spheres ask in each tick what is near them", {"gas"}, &make_asking},
    };
    return all;
}

const Entry &entry_named(const std::string &name)
{
    for (const Entry &entry : entries())
    {
        if (entry.name == name)
        {
            return entry;
        }
    }
    throw std::invalid_argument("there is no stepped scene named \"" + name + "\"");
}
} // namespace

const std::vector<std::string> &stepped_scene_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> result;
        for (const Entry &entry : entries())
        {
            result.push_back(entry.name);
        }
        return result;
    }();
    return names;
}

std::string describe_stepped_scene(const std::string &name)
{
    return entry_named(name).text;
}

SceneSpec spec_of_stepped_scene(const std::string &name, int objects, std::uint64_t seed)
{
    SceneSpec spec = entry_named(name).like;
    spec.objects = objects;
    spec.seed = seed;
    return spec;
}

std::size_t queries_of_stepped_scene(const std::string &name)
{
    return name == "ask" ? QueryScene::probes : 0;
}

std::unique_ptr<Scene> make_stepped_scene(const std::string &name, const SceneFactory &factory, dSpaceID space)
{
    return entry_named(name).make(factory, space);
}
} // namespace ode_predictive_space::benchmarks
