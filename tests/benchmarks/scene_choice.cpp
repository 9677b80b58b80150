#include "tests/benchmarks/scene_choice.h"

#include <charconv>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
constexpr int largest_scene = 1000000;
} // namespace

const worlds::WorldEntry &stepped_world(const std::string &scene)
{
    for (const worlds::WorldEntry &world : worlds::all_worlds())
    {
        if (world.name == scene + "_stepped")
        {
            return world;
        }
    }
    return worlds::world_named(scene);
}

SceneChoice parse_scene_choice(const std::string &text)
{
    const std::size_t colon = text.find(':');
    SceneChoice choice{text.substr(0, colon)};
    bool valid = !choice.scene.empty();
    if (colon != std::string::npos)
    {
        int objects = 0;
        const char *end = text.data() + text.size();
        const auto parsed = std::from_chars(text.data() + colon + 1, end, objects);
        valid = valid && parsed.ec == std::errc() && parsed.ptr == end && objects >= 1 && objects <= largest_scene;
        choice.objects = objects;
    }
    if (!valid)
    {
        throw std::invalid_argument("\"" + text + "\" is neither a scene nor a scene with a size, like gas:1000");
    }
    return choice;
}

void refuse_scene(const std::string &scene)
{
    throw std::invalid_argument("this command has no scene named \"" + scene + "\"");
}
} // namespace ode_predictive_space::benchmarks
