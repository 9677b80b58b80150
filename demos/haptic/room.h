// The free space of a scene.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_ROOM_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_ROOM_H

#include "demos/worlds/world.h"

namespace ode_predictive_space::worlds
{
/// The box that ODE reports for a geom, metres.
Eigen::AlignedBox3d bounds_of(dGeomID geom);

/// The room inside the walls of a scene: its bounds without the large boxes without a body at their sides, within a large mesh
/// without a body, and above a heightfield. Metres.
Eigen::AlignedBox3d room_inside_walls(const World &scene, const Bounds &bounds);
} // namespace ode_predictive_space::worlds

#endif
