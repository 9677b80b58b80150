// The scenes whose objects follow a motion that nothing disturbs: gas, game, classes, still, probe, churn, explosion,
// teleport.
//
// Their bodies are moved by dBodySetPosition() and dBodySetQuaternion() and have the velocities of that motion; their world is
// never stepped, and objects fly through one another.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_KINEMATIC_SCENES_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_KINEMATIC_SCENES_H

#include "demos/scenes/scene.h"

namespace ode_predictive_space::scenes
{
/// In the scene explosion all velocities change in every tick whose number, counted from 1, is a multiple of this.
constexpr int ticks_between_explosions = 200;

/// Half the side of the room, in metres.
double kinematic_half_room(const std::string &name, int objects);

std::unique_ptr<Scene> make_kinematic_scene(const SceneSpec &spec, dSpaceID space);
} // namespace ode_predictive_space::scenes

#endif
