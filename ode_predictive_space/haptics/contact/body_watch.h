// Bodies that may be destroyed at any time.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_BODY_WATCH_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_BODY_WATCH_H

#include "ode_predictive_space/haptics/touch.h"

#include <memory>
#include <ode/objects.h>
#include <vector>

namespace ode_predictive_space::haptics
{
/// ODE does not report that a body is destroyed, but it detaches the body's joints. So each body gets a null joint, which adds
/// no constraint; when the joint has no body, the body is gone.
class BodyWatch
{
public:
    /// Begins a tick: drops bodies that have not been touched for long.
    void age();

    /// Notes that the body is touched now. Must not be called while its world is stepped.
    void keep(dBodyID body);

    /// @return 0 for a body that is gone or unknown.
    dBodyID find(std::uintptr_t object) const;

    /// Adds a force, and enables a disabled body. Both are in the world's frame; the arm (m) is from its centre of mass.
    bool push(std::uintptr_t object, const Vector3 &force, const Vector3 &arm);

private:
    struct DestroyGroup
    {
        void operator()(dJointGroupID group) const { dJointGroupDestroy(group); }
    };

    struct Watched
    {
        /// Holds the joint alone, because a joint in a group survives its world.
        std::unique_ptr<dxJointGroup, DestroyGroup> group;
        dJointID joint;
        int age; ///< ticks since it was touched

        dBodyID body() const { return dJointGetBody(joint, 0); }
    };

    std::vector<Watched> watched_;
};
} // namespace ode_predictive_space::haptics

#endif
