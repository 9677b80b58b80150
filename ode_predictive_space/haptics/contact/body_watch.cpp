#include "ode_predictive_space/haptics/contact/body_watch.h"

#include "ode_predictive_space/haptics/contact/ode_vector.h"
#include "ode_predictive_space/haptics/contact/short_list.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int longest_age = 100; // ticks
}

void BodyWatch::age()
{
    for (Watched &watched : watched_)
        ++watched.age;
    remove_from(watched_,
                [](const Watched &watched) { return watched.age > longest_age || watched.body() == nullptr; });
}

dBodyID BodyWatch::find(std::uintptr_t object) const
{
    const Watched *found = find_in(
        watched_, [&](const Watched &watched) { return reinterpret_cast<std::uintptr_t>(watched.body()) == object; });
    return found != nullptr ? found->body() : nullptr;
}

void BodyWatch::keep(dBodyID body)
{
    if (Watched *known = find_in(watched_, [&](const Watched &watched) { return watched.body() == body; }))
    {
        known->age = 0;
        return;
    }
    Watched watched = {decltype(Watched::group)(dJointGroupCreate(0)), nullptr, 0};
    watched.joint = dJointCreateNull(dBodyGetWorld(body), watched.group.get());
    dJointAttach(watched.joint, body, nullptr);
    watched_.push_back(std::move(watched));
}

bool BodyWatch::push(std::uintptr_t object, const Vector3 &force, const Vector3 &arm)
{
    const dBodyID body = find(object);
    if (body == nullptr)
        return false;
    push_body(body, force, arm.cross(force));
    return true;
}
} // namespace ode_predictive_space::haptics
