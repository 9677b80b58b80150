// Shapes that drawstuff cannot draw: cones, and translucent balls without a shadow. OpenGL, in drawstuff's frame.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_GL_SHAPES_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_GL_SHAPES_H

#include "demos/window/palette.h"
#include "demos/window/view.h"

#include <vector>

namespace ode_predictive_space::window
{
/// Fill the window with a calm background, in place of drawstuff's sky and ground.
void draw_background(const Colour &above, const Colour &below);

/// From, to.
using Segment = std::array<Vector3, 2>;

void draw_lines(const std::vector<Segment> &lines, const Colour &colour, float opacity, float width);

/// An arrow from a point, of this length and direction, `thickness` wide.
void draw_arrow(const Vector3 &from, const Vector3 &along, double thickness, const Colour &colour);

/// Balls of glass: transparent in the middle and nearly opaque at the rim. They hide nothing.
void draw_glass_balls(const std::vector<EnvelopeBall> &balls, const Colour &colour, float opacity);
} // namespace ode_predictive_space::window

#endif
