// Where the device's workspace is in the scene: by the program, the clutch, and a base that moves.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_HAND_WORKSPACE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_HAND_WORKSPACE_H

#include "ode_predictive_space/haptics/device/base_course.h"

#include <utility>

namespace ode_predictive_space::haptics
{
/// As far as a renderer is concerned. Used from the servo's thread, apart from base.aim().
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
