#include "tests/scenes/worlds/worlds.h"

#include "tests/scenes/worlds/makers.h"

#include <functional>
#include <stdexcept>

namespace ode_predictive_space::scenes
{
namespace
{
struct Entry
{
    std::string name;
    std::string text;
    std::function<SceneRecipe(const SceneSpec &)> recipe;
};

using VariedWorld = SceneRecipe (*)(const SceneSpec &, double);

template <VariedWorld world> std::function<SceneRecipe(const SceneSpec &)> varied(double variation)
{
    return [variation](const SceneSpec &spec) { return world(spec, variation); };
}

template <bool choice, SceneRecipe (*world)(const SceneSpec &, bool)> SceneRecipe chosen(const SceneSpec &spec)
{
    return world(spec, choice);
}

void add_frames(std::vector<Entry> &all)
{
    for (const int percent : {0, 20, 50, 80})
    {
        const std::string text =
            "objects that fly through a dense room in steps that vary by " + std::to_string(percent) + " %, moved by ";
        all.push_back({"frames_" + std::to_string(percent), text + "the world", varied<&frames_world>(0.01 * percent)});
        all.push_back(
            {"frames_set_" + std::to_string(percent), text + "setters", varied<&set_frames_world>(0.01 * percent)});
    }
}

std::vector<Entry> make_entries()
{
    std::vector<Entry> all = {
        {"floor", "n bodies that roll and lie on a plane", varied<&floor_world>(0)},
        {"floor_50", "the same in steps that vary by 50 %", varied<&floor_world>(0.5)},
        {"ragdolls", "n ragdolls of 12 capsules that fall on stairs", &ragdolls_world},
        {"chain", "n robots of 17 bodies with motors on a plane", &chain_world},
        {"shelves", "n still boxes and 50 robots of 7 geoms on a plane", &chosen<false, &shelves_world>},
        {"shelves_mesh", "the same; ground and walls are one mesh", &chosen<true, &shelves_world>},
        {"heap", "n bodies that fall into a pit", varied<&heap_world>(0)},
        {"heap_lies", "the same from 1.5 s on", varied<&heap_world>(0)},
        {"heap_50", "the same from the drop on in steps that vary by 50 %", varied<&heap_world>(0.5)},
        {"drones", "n bodies that fly in a room with pillars, which is one mesh", &drones_world},
        {"room", "n bodies that fly in a room with rough walls, which is one mesh of 215,472 triangles", &room_scene},
        {"hills", "n bodies that fly over hills, which are a heightfield", &hills_scene},
        {"city", "n vehicles with four wheels on a heightfield, and 5 n trees", &city_world},
        {"rain", "n objects of which a fifth falls for ever, in steps of 0.1 s", &rain_world},
    };
    add_frames(all);
    all.push_back({"many", "worlds of n geoms that live for 60 ticks, one after the other", &many_world});
    all.push_back({"nested", "n robots of 7 geoms, each with a space of its own", &nested_world});
    all.push_back({"nested_empty", "n spaces without geoms and 10 balls", &empty_spaces_world});
    all.push_back({"lidar", "10 robots with 360 rays that ask one by one among n boxes", &chosen<false, &lidar_world>});
    all.push_back({"lidar_nested", "the same rays in a space for each robot", &chosen<true, &lidar_world>});
    all.push_back({"moon", "n bodies on a sphere of 1,700 km", &moon_world});
    for (const std::string later : {"", "_1", "_2"})
    {
        const std::string text = later.empty() ? "" : "; ticks after that: " + later.substr(1);
        all.push_back({"reset" + later, "n robots of 7 geoms, all set back every 200 ticks" + text, &reset_world});
        all.push_back({"recentre" + later, "n boxes, all shifted by 1 km" + text, varied<&boxes_world>(1000)});
        all.push_back({"first" + later, "the first tick of n boxes that fly" + text, varied<&boxes_world>(0)});
    }
    all.push_back({"conveyor", "n segments of a belt, a tenth leaps in each tick", &conveyor_world});
    return all;
}

const std::vector<Entry> &entries()
{
    static const std::vector<Entry> all = make_entries();
    return all;
}

const Entry *find(const std::string &name)
{
    const auto found =
        std::find_if(entries().begin(), entries().end(), [&](const Entry &entry) { return entry.name == name; });
    return found == entries().end() ? nullptr : &*found;
}

const Entry &entry_named(const std::string &name)
{
    const Entry *entry = find(name);
    if (entry == nullptr)
        throw std::invalid_argument("there is no world named \"" + name + "\"");
    return *entry;
}
} // namespace

const std::vector<std::string> &world_names()
{
    static const std::vector<std::string> names = [] {
        std::vector<std::string> result;
        for (const Entry &entry : entries())
            result.push_back(entry.name);
        return result;
    }();
    return names;
}

bool is_world(const std::string &name)
{
    return find(name) != nullptr;
}

std::string describe_world(const std::string &name)
{
    return entry_named(name).text;
}

SceneFactory world_factory(const SceneSpec &spec)
{
    const Entry &entry = entry_named(spec.name);
    if (spec.objects < 1)
        throw std::invalid_argument("a world needs at least one object");
    return {spec, entry.recipe(spec)};
}
} // namespace ode_predictive_space::scenes
