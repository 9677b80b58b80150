#include "ode_predictive_space/haptics/loop/world_bodies.h"

#include <stdexcept>

namespace ode_predictive_space::haptics
{
namespace
{
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
