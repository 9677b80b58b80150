// Bodies that may be destroyed at any time.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_BODY_WATCH_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_BODY_WATCH_H

#include "ode_predictive_space/haptics/touch.h"

#include <memory>
#include <ode/objects.h>
#include <vector>

namespace ode_predictive_space::haptics
{
/// Bodies that were touched lately, to be pushed if they are still there.
///
/// ODE does not tell when a body is destroyed, but it takes the body's joints off it. So each body in here gets a null joint,
/// which constrains nothing and adds nothing to the world's equations; a joint without a body is a body that is gone.
class BodyWatch
{
public:
    /// A tick begins: what was not touched for long is forgotten.
    void age();

    /// The body is touched now. Not while its world is stepped.
    void keep(dBodyID body);

    /// @param object the body's address, as Touch::object has it.
    /// @return 0 when there is no such body: it is gone, or was never one.
    dBodyID find(std::uintptr_t object) const;

    /// Add a force. A disabled body is enabled by it.
    ///
    /// @param arm m; from the body's centre of mass to where the force acts. The world's frame, as the force's.
    /// @return false when find() finds nothing.
    bool push(std::uintptr_t object, const Vector3 &force, const Vector3 &arm);

private:
    struct DestroyGroup
    {
        void operator()(dJointGroupID group) const { dJointGroupDestroy(group); }
    };

    struct Watched
    {
        /// Of the joint alone: what is in a group survives its world.
        std::unique_ptr<dxJointGroup, DestroyGroup> group;
        dJointID joint;
        int age; ///< ticks since it was touched

        dBodyID body() const { return dJointGetBody(joint, 0); } ///< 0 when it is gone
    };

    std::vector<Watched> watched_;
};
} // namespace ode_predictive_space::haptics

#endif
