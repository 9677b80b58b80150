#include "demos/window/overlay.h"

#include "demos/window/strip_chart.h"

namespace ode_predictive_space::window
{
namespace
{
constexpr double gap = 12;  // pixels; from the window's edge, and inside of panels
constexpr double line = 18; // pixels
constexpr double text_size = 12;
constexpr double heading_size = 15;
constexpr double readings_width = 330;
constexpr double keys_width = 210;
constexpr double chart_height = 190;
constexpr double widest_chart = 640;

void draw_readings(Canvas &canvas, const View &view)
{
    const Rectangle area{gap, gap, readings_width, line * (static_cast<double>(view.readings.size()) + 1) + 2 * gap};
    canvas.panel(area);
    const double left = area.left + gap;
    double y = area.top + gap + heading_size;
    canvas.text(left, y, view.heading, palette::text, heading_size);
    y += 4;
    for (const Reading &reading : view.readings)
    {
        y += line;
        canvas.text(left, y, reading.name, palette::faint_text, text_size);
        canvas.text(area.left + area.width - gap, y, reading.value, reading.alarming ? palette::alarm : palette::text,
                    text_size, Align::right);
    }
}

void draw_keys(Canvas &canvas, const std::vector<KeyHelp> &keys)
{
    const double height = line * static_cast<double>(keys.size()) + 2 * gap - 4;
    const Rectangle area{canvas.width() - gap - keys_width, gap, keys_width, height};
    canvas.panel(area);
    double y = area.top + gap - 6;
    for (const KeyHelp &key : keys)
    {
        y += line;
        canvas.text(area.left + gap, y, key.key, palette::near_probe, text_size);
        canvas.text(area.left + gap + 52, y, key.meaning, key.on ? palette::text : palette::faint_text, text_size);
    }
}

void draw_notice(Canvas &canvas, const std::string &notice, double bottom)
{
    if (notice.empty())
        return;
    cairo_set_font_size(canvas.context(), text_size);
    cairo_text_extents_t extents;
    cairo_text_extents(canvas.context(), notice.c_str(), &extents);
    const Rectangle area{gap, bottom - gap - line - gap, extents.x_advance + 2 * gap, line + gap};
    canvas.panel(area);
    canvas.text(area.left + gap, area.top + 20, notice, palette::alarm, text_size);
}
} // namespace

void draw_overlay(Canvas &canvas, const View &view, const std::vector<KeyHelp> &keys)
{
    const double width = std::min(widest_chart, canvas.width() - 2 * gap);
    const Rectangle chart{gap, canvas.height() - gap - chart_height, width, chart_height};
    draw_readings(canvas, view);
    draw_keys(canvas, keys);
    draw_strip_chart(canvas, view, chart);
    draw_notice(canvas, view.notice, chart.top);
}
} // namespace ode_predictive_space::window
