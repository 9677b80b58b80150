// The text of the window: the run, its rates, the keys.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_OVERLAY_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_OVERLAY_H

#include "demos/window/canvas.h"
#include "demos/window/view.h"

#include <vector>

namespace ode_predictive_space::window
{
/// Readings, chart and keys.
void draw_overlay(Canvas &canvas, const View &view, const std::vector<KeyHelp> &keys);
} // namespace ode_predictive_space::window

#endif
