#include "demos/window/canvas.h"

#include <GL/gl.h>
#include <cmath>

namespace ode_predictive_space::window
{
namespace
{
constexpr double corner_radius = 8; // pixels
constexpr double right_angle = 3.14159265358979323846 / 2;

void trace_round_rectangle(cairo_t *context, const Rectangle &area)
{
    const double r = corner_radius;
    const double right = area.left + area.width;
    const double bottom = area.top + area.height;
    cairo_new_sub_path(context);
    cairo_arc(context, right - r, area.top + r, r, -right_angle, 0);
    cairo_arc(context, right - r, bottom - r, r, 0, right_angle);
    cairo_arc(context, area.left + r, bottom - r, r, right_angle, 2 * right_angle);
    cairo_arc(context, area.left + r, area.top + r, r, 2 * right_angle, 3 * right_angle);
    cairo_close_path(context);
}
} // namespace

Canvas::Canvas(int width, int height)
    : width_(width), height_(height), surface_(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height)),
      context_(cairo_create(surface_.get()))
{
    cairo_select_font_face(context(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
}

void Canvas::colour(const Colour &colour, double opacity)
{
    cairo_set_source_rgba(context(), colour.red, colour.green, colour.blue, opacity);
}

void Canvas::panel(const Rectangle &area)
{
    trace_round_rectangle(context(), area);
    colour(palette::panel, 0.78);
    cairo_fill(context());
}

void Canvas::text(double x, double y, const std::string &line, const Colour &ink, double size, Align align)
{
    cairo_set_font_size(context(), size);
    cairo_text_extents_t extents;
    cairo_text_extents(context(), line.c_str(), &extents);
    colour(ink);
    cairo_move_to(context(), align == Align::right ? std::round(x - extents.x_advance) : x, y);
    cairo_show_text(context(), line.c_str());
}

void Canvas::show()
{
    cairo_surface_flush(surface_.get());
    glPushAttrib(GL_ALL_ATTRIB_BITS);
    glMatrixMode(GL_PROJECTION);
    glPushMatrix();
    glLoadIdentity();
    glMatrixMode(GL_MODELVIEW);
    glPushMatrix();
    glLoadIdentity();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_LIGHTING);
    glDisable(GL_TEXTURE_2D);
    glEnable(GL_BLEND);
    // Cairo's colours are multiplied by their opacity already.
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glRasterPos2f(-1, 1);
    glPixelZoom(1, -1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glDrawPixels(width_, height_, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, cairo_image_surface_get_data(surface_.get()));
    glPopMatrix();
    glMatrixMode(GL_PROJECTION);
    glPopMatrix();
    glMatrixMode(GL_MODELVIEW);
    glPopAttrib();
}
} // namespace ode_predictive_space::window
