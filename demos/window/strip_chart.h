// The last seconds of force and loop period, drawn as by a strip chart recorder.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_STRIP_CHART_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_STRIP_CHART_H

#include "demos/window/canvas.h"
#include "demos/window/view.h"

namespace ode_predictive_space::window
{
/// The force above, the periods below, one column of the view's chart per pixel, the latest at the right edge.
void draw_strip_chart(Canvas &canvas, const View &view, const Rectangle &area);

/// The number of columns of a chart of this width.
int chart_columns(const Rectangle &area);
} // namespace ode_predictive_space::window

#endif
