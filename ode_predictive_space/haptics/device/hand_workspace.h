// The device's workspace in the scene, as the program, the clutch and the base's motion place it.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_HAND_WORKSPACE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_HAND_WORKSPACE_H

#include "ode_predictive_space/haptics/exchange.h"
#include "ode_predictive_space/haptics/workspace.h"

#include <algorithm>
#include <utility>

namespace ode_predictive_space::haptics
{
/// The scene's thread sets a target of the base in each step. The servo moves the base there evenly within one step: it never
/// overshoots, and stops when the scene is late. For the servo's thread, except aim().
class HandWorkspace
{
public:
    explicit HandWorkspace(const WorkspacePlacement &placement) : mapping(placement) {}

    /// Ends a motion of the base.
    void place(const WorkspacePlacement &placement)
    {
        mapping = WorkspaceMapping(placement);
        aims_.take();
        left_ = 0;
        moves_ = false;
    }

    /// For the scene's thread. @throws std::invalid_argument as WorkspaceMapping::move_base() does with these scales.
    void aim(const WorkspacePlacement &placement, const BaseMotion &motion)
    {
        WorkspacePlacement before;
        before.scale = mapping.base().scale;
        before.force_scale = mapping.base().force_scale;
        WorkspaceMapping(before).move_base(placement, motion); // throws here, because the servo must not
        aims_.draft() = {placement, motion};
        aims_.publish();
    }

    /// Moves the base in a tick. @param elapsed s; since the tick before. @param step s; of the scene.
    void move_base(double elapsed, double step)
    {
        if (aims_.take())
            left_ = step;
        else if (!(left_ > 0))
        {
            if (std::exchange(moves_, false))
                mapping.move_base(mapping.base(), {});
            return;
        }
        moves_ = true;
        const bool arrives = elapsed >= left_ * (1 - rounding);
        const double part = arrives ? 1 : std::max(0.0, elapsed / left_);
        left_ = arrives ? 0 : left_ - part * left_;
        const Aim &aim = aims_.latest();
        WorkspacePlacement base = mapping.base();
        base.offset += part * (aim.placement.offset - base.offset);
        base.rotation = Quaternion(base.rotation.slerp(part, aim.placement.rotation));
        mapping.move_base(base, aim.motion);
    }

    void move_clutch(bool held, const DeviceState &state)
    {
        clutch_released_ = mapping.clutched() && !held;
        mapping.clutch(held, state);
    }

    /// Whether the clutch was released since the last call.
    bool take_release() { return std::exchange(clutch_released_, false); }

    WorkspaceMapping mapping;

private:
    static constexpr double rounding = 1e-6; // of a period that is a sum of ticks

    struct Aim
    {
        WorkspacePlacement placement;
        BaseMotion motion;
    };

    Snapshot<Aim> aims_;
    double left_ = 0; ///< s; remaining time of the base's motion
    bool moves_ = false;
    bool clutch_released_ = false;
};
} // namespace ode_predictive_space::haptics

#endif
