#include "ode_predictive_space/haptics/loop/scene_bodies.h"

#include "ode_predictive_space/haptics/contact/short_list.h"

#include <array>
#include <cstddef>
#include <cstdio>
#include <ode/objects.h>
#include <optional>
#include <stdexcept>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr std::ptrdiff_t furthest_begin = 64; // bytes

/// The product of zero and a number that is not finite is NaN.
bool is_finite(const dReal *numbers, int count)
{
    dReal sum = 0;
    for (int i = 0; i < count; ++i)
        sum += 0 * numbers[i];
    return sum == 0;
}

const char *broken_part_of(dBodyID body)
{
    return !is_finite(dBodyGetPosition(body), 3)     ? "position"
           : !is_finite(dBodyGetQuaternion(body), 4) ? "rotation"
           : !is_finite(dBodyGetLinearVel(body), 3)  ? "velocity"
           : !is_finite(dBodyGetAngularVel(body), 3) ? "spin"
           : !is_finite(dBodyGetForce(body), 3)      ? "force"
           : !is_finite(dBodyGetTorque(body), 3)     ? "torque"
                                                     : nullptr;
}

/// The first members of a body. A world lists its bodies, the newest first.
struct ListedBody
{
    const void *virtual_functions;
    dWorldID world;
    dBodyID next;
    dBodyID *tome; ///< the pointer to this body
};

const ListedBody &listed(dBodyID body)
{
    return *reinterpret_cast<const ListedBody *>(body);
}

/// The offset of the list in a world, found by a test world; none if bodies are not listed as expected.
std::optional<std::ptrdiff_t> find_begin_of_list()
{
    const dWorldID world = dWorldCreate();
    const dBodyID first = dBodyCreate(world);
    const dBodyID second = dBodyCreate(world);
    const bool as_expected = listed(second).world == world && listed(second).next == first &&
                             listed(first).next == nullptr && listed(first).tome == &listed(second).next;
    const std::ptrdiff_t begin = reinterpret_cast<char *>(listed(second).tome) - reinterpret_cast<char *>(world);
    dWorldDestroy(world);
    return as_expected && begin >= 0 && begin <= furthest_begin ? std::optional(begin) : std::nullopt;
}
} // namespace

std::string broken_state_of(dBodyID body)
{
    const char *const part = body != nullptr ? broken_part_of(body) : nullptr;
    if (part == nullptr)
        return {};
    const dReal *const at = dBodyGetPosition(body);
    std::array<char, 240> sentence;
    std::snprintf(sentence.data(), sentence.size(),
                  "The %s of body %p is not finite (its data: %p, its geom: %p, at %.3g %.3g %.3g m)", part,
                  static_cast<void *>(body), dBodyGetData(body), static_cast<void *>(dBodyGetFirstGeom(body)),
                  static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2]));
    return sentence.data();
}

dBodyID first_body_of(dWorldID world)
{
    static const std::optional<std::ptrdiff_t> begin = find_begin_of_list();
    if (!begin)
        throw std::runtime_error(
            "this version of ODE stores the bodies of a world in an unknown way: use a loop in one thread");
    return *reinterpret_cast<dBodyID *>(reinterpret_cast<char *>(world) + *begin);
}

dBodyID next_body_of_world(dBodyID body)
{
    return listed(body).next;
}

void SceneBodies::DestroyMark::operator()(dGeomID geom) const
{
    if (const dBodyID body = dGeomGetBody(geom))
        dBodyDestroy(body);
    dGeomDestroy(geom);
}

dWorldID SceneBodies::world_of(const Mark &mark)
{
    const dBodyID body = dGeomGetBody(mark.get());
    return body != nullptr ? dBodyGetWorld(body) : nullptr;
}

std::string SceneBodies::broken_state(dBodyID tool, dGeomID geom)
{
    const dSpaceID scene = outermost_space_of(geom);
    const std::size_t known = worlds_.size();
    remove_from(worlds_, [](const Mark &mark) { return world_of(mark) == nullptr; });
    if (worlds_.size() != known || (worlds_.empty() && scene != nullptr && dSpaceGetNumGeoms(scene) != searched_))
        find_worlds(scene);
    add_world_of(tool);
    for (const Mark &mark : worlds_)
        for (dBodyID body = first_body_of(world_of(mark)); body != nullptr; body = next_body_of_world(body))
            if (broken_part_of(body) != nullptr)
                return broken_state_of(body);
    return {};
}

void SceneBodies::find_worlds(dSpaceID scene)
{
    if (scene == nullptr)
        return;
    for_each_geom(scene, [this](dGeomID geom) { add_world_of(dGeomGetBody(geom)); });
    searched_ = dSpaceGetNumGeoms(scene);
}

void SceneBodies::add_world_of(dBodyID body)
{
    if (body == nullptr)
        return;
    const dWorldID world = dBodyGetWorld(body);
    if (find_in(worlds_, [world](const Mark &mark) { return world_of(mark) == world; }) != nullptr)
        return;
    const dBodyID marked = dBodyCreate(world);
    dBodyDisable(marked);
    worlds_.emplace_back(dCreateSphere(nullptr, 1));
    dGeomSetBody(worlds_.back().get(), marked);
}
} // namespace ode_predictive_space::haptics
