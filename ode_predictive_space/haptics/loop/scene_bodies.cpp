#include "ode_predictive_space/haptics/loop/scene_bodies.h"

#include "ode_predictive_space/haptics/contact/scene_geoms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ode/objects.h>
#include <stdexcept>

namespace ode_predictive_space::haptics
{
namespace
{
bool is_finite(const dReal *numbers, int count)
{
    return std::all_of(numbers, numbers + count, [](dReal number) { return std::isfinite(number); });
}

/// @return 0 when all is finite.
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

/// The first members of a body. A world has its bodies in a list, the last one made first.
struct ListedBody
{
    const void *virtual_functions;
    dWorldID world;
    dBodyID next;
    dBodyID *tome; ///< the pointer in this list that points here
};

const ListedBody &listed(dBodyID body)
{
    return *reinterpret_cast<const ListedBody *>(body);
}

/// Asked of a world of its own.
bool keeps_bodies_as_expected()
{
    const dWorldID world = dWorldCreate();
    const dBodyID first = dBodyCreate(world);
    const dBodyID second = dBodyCreate(world);
    const bool as_expected = listed(second).world == world && listed(second).next == first &&
                             listed(first).next == nullptr && listed(first).tome == &listed(second).next;
    dWorldDestroy(world);
    return as_expected;
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

std::string broken_state_around(dGeomID geom)
{
    const dSpaceID scene = outermost_space_of(geom);
    dBodyID broken = nullptr;
    if (scene != nullptr)
    {
        for_each_geom(scene, [&](dGeomID other) {
            const dBodyID body = dGeomGetBody(other);
            if (broken == nullptr && body != nullptr && broken_part_of(body) != nullptr)
                broken = body;
        });
    }
    return broken_state_of(broken);
}

std::vector<dBodyID> bodies_of(dWorldID world)
{
    static const bool known = keeps_bodies_as_expected();
    if (!known)
        throw std::runtime_error("this version of ODE keeps the bodies of a world in an unknown way");
    std::vector<dBodyID> bodies;
    const dBodyID begin = dBodyCreate(world);
    for (dBodyID body = listed(begin).next; body != nullptr; body = listed(body).next)
        bodies.push_back(body);
    dBodyDestroy(begin);
    return bodies;
}
} // namespace ode_predictive_space::haptics
