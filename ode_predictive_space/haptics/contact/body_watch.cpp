#include "ode_predictive_space/haptics/contact/body_watch.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int longest_age = 100; // ticks
}

BodyWatch::~BodyWatch()
{
    for (const Watched &watched : watched_)
        dJointGroupDestroy(watched.group);
}

void BodyWatch::age()
{
    for (Watched &watched : watched_)
        ++watched.age;
    const auto first_old = std::partition( // the stable one allocates
        watched_.begin(), watched_.end(), [](const Watched &watched) {
            return watched.age <= longest_age && dJointGetBody(watched.joint, 0) != nullptr;
        });
    std::for_each(first_old, watched_.end(), [](const Watched &watched) { dJointGroupDestroy(watched.group); });
    watched_.erase(first_old, watched_.end());
}

dBodyID BodyWatch::find(std::uintptr_t object) const
{
    const auto found = std::find_if(watched_.begin(), watched_.end(), [&](const Watched &watched) {
        return watched.object == object && dJointGetBody(watched.joint, 0) != nullptr;
    });
    return found != watched_.end() ? dJointGetBody(found->joint, 0) : nullptr;
}

void BodyWatch::keep(dBodyID body)
{
    const auto object = reinterpret_cast<std::uintptr_t>(body);
    const auto known = std::find_if(watched_.begin(), watched_.end(), [&](const Watched &watched) {
        return watched.object == object && dJointGetBody(watched.joint, 0) != nullptr;
    });
    if (known != watched_.end())
    {
        known->age = 0;
        return;
    }
    const dJointGroupID group = dJointGroupCreate(0);
    const dJointID joint = dJointCreateNull(dBodyGetWorld(body), group);
    dJointAttach(joint, body, nullptr);
    watched_.push_back({object, group, joint, 0});
}

bool BodyWatch::has(dBodyID body) const
{
    return find(reinterpret_cast<std::uintptr_t>(body)) != nullptr;
}

bool BodyWatch::push(std::uintptr_t object, const Vector3 &force, const Vector3 &point)
{
    const dBodyID body = find(object);
    if (body == nullptr)
        return false;
    dBodyEnable(body);
    dBodyAddForceAtPos(body, static_cast<dReal>(force.x()), static_cast<dReal>(force.y()),
                       static_cast<dReal>(force.z()), static_cast<dReal>(point.x()), static_cast<dReal>(point.y()),
                       static_cast<dReal>(point.z()));
    return true;
}
} // namespace ode_predictive_space::haptics
