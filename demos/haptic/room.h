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

/// A place for a sphere that touches nothing of a scene: the wish, or one near it in the room, with a margin of half a radius;
/// without such a place one without a margin, up to two radii beyond the room; otherwise the wish. The space of the scene is not
/// asked, so that its first tick remains its first. Metres.
Vector3 free_place(const World &scene, const Vector3 &wish, double radius, const Eigen::AlignedBox3d &room);
} // namespace ode_predictive_space::worlds

#endif
