#include "demos/window/strip_chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace ode_predictive_space::window
{
namespace
{
constexpr double margin = 12;       // pixels
constexpr double axis_width = 46;   // pixels; for the numbers on the left
constexpr double title_height = 20; // pixels
constexpr double label_size = 11;

using Measure = float ChartColumn::*;

/// A strip of the chart: its quantity and its range.
struct Strip
{
    Rectangle area;
    double top; ///< the value at its upper edge
    const char *unit;
};

std::string number_with_unit(double value, const char *unit)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.3g %s", value, unit);
    return text;
}

double height_of(const Strip &strip, double value)
{
    const double share = std::clamp(value / strip.top, 0.0, 1.0);
    return strip.area.top + (1 - share) * strip.area.height;
}

/// The next round number that is not smaller.
double round_up(double value)
{
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double step : {1.0, 2.0, 5.0})
    {
        if (value <= step * power)
            return step * power;
    }
    return 10 * power;
}

double largest(const std::vector<ChartColumn> &chart, Measure measure)
{
    double result = 0;
    for (const ChartColumn &column : chart)
        result = std::max(result, static_cast<double>(column.*measure));
    return result;
}

void draw_level(Canvas &canvas, const Strip &strip, double value)
{
    const double y = std::round(height_of(strip, value)) + 0.5;
    canvas.colour(palette::faint_text, 0.35);
    cairo_set_line_width(canvas.context(), 1);
    cairo_move_to(canvas.context(), strip.area.left, y);
    cairo_line_to(canvas.context(), strip.area.left + strip.area.width, y);
    cairo_stroke(canvas.context());
    canvas.text(strip.area.left - 6, y + 4, number_with_unit(value, strip.unit), palette::faint_text, label_size,
                Align::right);
}

void draw_curve(Canvas &canvas, const Strip &strip, const std::vector<ChartColumn> &chart, Measure measure,
                const Colour &colour, bool filled)
{
    const double right = strip.area.left + strip.area.width;
    const auto shown = std::min<std::size_t>(chart.size(), static_cast<std::size_t>(strip.area.width));
    if (shown < 2)
        return;
    cairo_t *context = canvas.context();
    cairo_new_path(context); // text leaves a point behind
    for (std::size_t i = 0; i < shown; ++i)
        cairo_line_to(context, right - static_cast<double>(shown - 1 - i),
                      height_of(strip, chart[chart.size() - shown + i].*measure));
    canvas.colour(colour);
    cairo_set_line_width(context, 1.5);
    if (!filled)
    {
        cairo_stroke(context);
        return;
    }
    cairo_stroke_preserve(context);
    cairo_line_to(context, right, strip.area.top + strip.area.height);
    cairo_line_to(context, right - static_cast<double>(shown - 1), strip.area.top + strip.area.height);
    cairo_close_path(context);
    canvas.colour(colour, 0.35);
    cairo_fill(context);
}

void draw_legend(Canvas &canvas, const Strip &strip, double right, const char *text, const Colour &colour)
{
    canvas.text(right, strip.area.top - 6, text, colour, label_size, Align::right);
}

void draw_force(Canvas &canvas, const View &view, const Rectangle &area)
{
    const Strip strip{
        area, round_up(std::max(1.0, std::max(1.05 * largest(view.chart, &ChartColumn::force), view.probe.max_force))),
        "N"};
    draw_level(canvas, strip, 0);
    draw_level(canvas, strip, strip.top);
    draw_curve(canvas, strip, view.chart, &ChartColumn::force, palette::force, true);
    canvas.text(area.left, area.top - 6, "last " + number_with_unit(area.width * view.chart_seconds, "s"),
                palette::faint_text, label_size);
    draw_legend(canvas, strip, area.left + area.width, "force", palette::force);
}

void draw_times(Canvas &canvas, const View &view, const Rectangle &area)
{
    const Strip strip{area, 2 * view.nominal_period, "ms"};
    const double right = area.left + area.width;
    draw_level(canvas, strip, 0);
    draw_level(canvas, strip, view.nominal_period);
    draw_level(canvas, strip, strip.top);
    draw_curve(canvas, strip, view.chart, &ChartColumn::compute, palette::compute, true);
    draw_curve(canvas, strip, view.chart, &ChartColumn::period, palette::period, false);
    draw_legend(canvas, strip, right, "longest period", palette::period);
    draw_legend(canvas, strip, right - 100, "longest computation", palette::compute);
}
} // namespace

int chart_columns(const Rectangle &area)
{
    return static_cast<int>(area.width - axis_width - 2 * margin);
}

void draw_strip_chart(Canvas &canvas, const View &view, const Rectangle &area)
{
    canvas.panel(area);
    const double left = area.left + margin + axis_width;
    const double width = chart_columns(area);
    const int strips = view.nominal_period > 0 ? 2 : 1;
    const double height = (area.height - strips * title_height - 1.5 * margin) / strips;
    draw_force(canvas, view, {left, area.top + title_height, width, height});
    if (view.nominal_period > 0)
        draw_times(canvas, view, {left, area.top + 2 * title_height + height, width, height});
}
} // namespace ode_predictive_space::window
