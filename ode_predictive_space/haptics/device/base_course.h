// Placement of a device's workspace, and motion of its base between two steps of the scene.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_BASE_COURSE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_BASE_COURSE_H

#include "ode_predictive_space/haptics/exchange.h"
#include "ode_predictive_space/haptics/workspace.h"

#include <algorithm>
#include <utility>

namespace ode_predictive_space::haptics
{
/// The scene's thread sets a target in each step. The servo moves the base there evenly within one step: it never
/// overshoots, and stops when the scene is late.
class BaseCourse
{
public:
    /// For the scene's thread. @throws std::invalid_argument as WorkspaceMapping::move_base() does with these scales.
    void aim(const WorkspacePlacement &scales, const WorkspacePlacement &placement, const BaseMotion &motion)
    {
        WorkspacePlacement before;
        before.scale = scales.scale;
        before.force_scale = scales.force_scale;
        WorkspaceMapping(before).move_base(placement, motion); // throws here, because the servo must not
        aims_.draft() = {placement, motion};
        aims_.publish();
    }

    /// For the servo: moves the base in a tick.
    void follow(double elapsed, double step, WorkspaceMapping &mapping)
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

    /// For the servo: the base was put elsewhere.
    void forget()
    {
        aims_.take();
        left_ = 0;
        moves_ = false;
    }

private:
    static constexpr double rounding = 1e-6; // of a period that is a sum of ticks

    struct Aim
    {
        WorkspacePlacement placement;
        BaseMotion motion;
    };

    Snapshot<Aim> aims_;
    double left_ = 0; ///< s; remaining time
    bool moves_ = false;
};

/// Placement of the workspace by the program, the clutch and the base. For the servo's thread, except base.aim().
struct HandWorkspace
{
    explicit HandWorkspace(const WorkspacePlacement &placement) : mapping(placement) {}

    void place(const WorkspacePlacement &placement)
    {
        mapping = WorkspaceMapping(placement);
        base.forget();
    }

    void move_clutch(bool held, const DeviceState &state)
    {
        const bool was_held = mapping.clutched();
        mapping.clutch(held, state);
        clutch_released = was_held && !held;
    }

    /// Whether the clutch was released since the last call.
    bool take_release() { return std::exchange(clutch_released, false); }

    WorkspaceMapping mapping;
    BaseCourse base;
    bool clutch_released = false;
};
} // namespace ode_predictive_space::haptics

#endif
