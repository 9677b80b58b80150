// Draws the objects of a view, in the frame that drawstuff has set up.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_SCENE_DRAWING_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_SCENE_DRAWING_H

#include "demos/window/view.h"

namespace ode_predictive_space::window
{
/// What is shown beside the objects and the probe.
struct Layers
{
    bool envelopes = true;         ///< along the probe's path
    bool object_envelopes = false; ///< of the moving objects around the probe
    bool near_pairs = true;
    bool force = true;
    bool text = true;
    bool only_nearby = true; ///< objects far from the probe are pale
};

/// Drawstuff's floor is the plane z = 0, that of a scene can be anywhere. Add this to all drawn positions.
Vector3 shift_onto_floor(const SceneView &view);

/// Everything but the text.
///
/// @param eye the camera's position, in drawstuff's frame.
void draw_scene(const SceneView &view, const Layers &layers, const Vector3 &eye);
} // namespace ode_predictive_space::window

#endif
