// The place of a device's workspace in the scene, and the motion of its base between two steps of the scene.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_BASE_COURSE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_BASE_COURSE_H

#include "ode_predictive_space/haptics/exchange.h"
#include "ode_predictive_space/haptics/workspace.h"

#include <algorithm>
#include <utility>

namespace ode_predictive_space::haptics
{
/// The scene's thread gives a place for each of its steps. The servo takes the base there evenly within the time of one step: the base
/// never overshoots, and it stands still when the scene is late.
class BaseCourse
{
public:
    /// From the scene's thread. @throws std::invalid_argument as WorkspaceMapping::move_base() does with these scales.
    void aim(const WorkspacePlacement &scales, const WorkspacePlacement &placement, const BaseMotion &motion)
    {
        WorkspacePlacement before;
        before.scale = scales.scale;
        before.force_scale = scales.force_scale;
        WorkspaceMapping(before).move_base(placement, motion); // throws, where the servo must not
        aims_.draft() = {placement, motion};
        aims_.publish();
    }

    /// The servo's: a tick begins.
    ///
    /// @param elapsed s; since the tick before. @param step s; of the scene.
    void follow(double elapsed, double step, WorkspaceMapping &mapping)
    {
        if (aims_.take())
            left_ = step;
        else if (!(left_ > 0))
            return stop(mapping);
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

    /// The servo's: the base was put elsewhere.
    void forget()
    {
        aims_.take();
        left_ = 0;
        moves_ = false;
    }

private:
    static constexpr double rounding = 1e-6; // of a period that is a sum of ticks

    /// The placement of the base at the end of a step of the scene.
    struct Aim
    {
        WorkspacePlacement placement;
        BaseMotion motion;
    };

    void stop(WorkspaceMapping &mapping)
    {
        if (moves_)
            mapping.move_base(mapping.base(), {});
        moves_ = false;
    }

    Snapshot<Aim> aims_;
    double left_ = 0; ///< s; until the base is there
    bool moves_ = false;
};

/// The place of the device's workspace in the scene, which follows from the program, the clutch and the base. Only the servo's thread uses it,
/// except for base.aim().
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

    /// Whether the clutch was released, and nothing has been rendered since. Once for each release.
    bool take_release() { return std::exchange(clutch_released, false); }

    WorkspaceMapping mapping;
    BaseCourse base;
    bool clutch_released = false;
};
} // namespace ode_predictive_space::haptics

#endif
