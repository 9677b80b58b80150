// The scenes that a command measures, as the command line names them.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_SCENE_CHOICE_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_SCENE_CHOICE_H

#include "demos/worlds/world.h"

#include <optional>
#include <string>
#include <vector>

namespace ode_predictive_space::benchmarks
{
/// The world in which a scene is moved by steps and contacts: gas_stepped for gas, pile for pile.
///
/// @throws std::invalid_argument for a name that no world has.
const worlds::WorldEntry &stepped_world(const std::string &scene);

/// "gas" chooses a scene in all the sizes that the command has for it, "gas:1000" in this one.
struct SceneChoice
{
    std::string scene;
    std::optional<int> objects{};
};

/// @throws std::invalid_argument when the text is neither a name nor a name, a colon and a number from 1 to 1,000,000.
SceneChoice parse_scene_choice(const std::string &text);

/// The chosen of the cases a command has, in the order of the choices; all of them when there are no choices. A size that the
/// command does not have becomes a copy of the scene's first case with that size.
///
/// @tparam Case has the members std::string scene and int objects.
/// @throws std::invalid_argument when no case has the name of a choice.
template <typename Case>
std::vector<Case> chosen(const std::vector<Case> &cases, const std::vector<std::string> &choices);

[[noreturn]] void refuse_scene(const std::string &scene);

template <typename Case>
std::vector<Case> chosen(const std::vector<Case> &cases, const std::vector<std::string> &choices)
{
    std::vector<Case> result;
    for (const std::string &text : choices)
    {
        const SceneChoice choice = parse_scene_choice(text);
        std::vector<Case> of_scene;
        for (const Case &one : cases)
        {
            if (one.scene == choice.scene)
            {
                of_scene.push_back(one);
            }
        }
        if (of_scene.empty())
        {
            refuse_scene(choice.scene);
        }
        if (choice.objects)
        {
            Case of_size = of_scene.front();
            for (const Case &one : of_scene)
            {
                of_size = one.objects == *choice.objects ? one : of_size;
            }
            of_size.objects = *choice.objects;
            of_scene = {of_size};
        }
        result.insert(result.end(), of_scene.begin(), of_scene.end());
    }
    return choices.empty() ? cases : result;
}
} // namespace ode_predictive_space::benchmarks

#endif
