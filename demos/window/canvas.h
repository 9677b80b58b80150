// Text and charts over the scene: a picture as large as the window, drawn by Cairo, laid over it by OpenGL.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_CANVAS_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_CANVAS_H

#include "demos/window/palette.h"

#include <cairo.h>
#include <memory>
#include <string>

namespace ode_predictive_space::window
{
struct SurfaceDeleter
{
    void operator()(cairo_surface_t *surface) const { cairo_surface_destroy(surface); }
};
using OwnedSurface = std::unique_ptr<cairo_surface_t, SurfaceDeleter>;

struct ContextDeleter
{
    void operator()(cairo_t *context) const { cairo_destroy(context); }
};
using OwnedContext = std::unique_ptr<cairo_t, ContextDeleter>;

/// In pixels.
struct Rectangle
{
    double left, top, width, height;
};

enum class Align
{
    left, ///< the text begins there
    right ///< the text ends there
};

/// Clear at first. Coordinates are in pixels, from the upper left corner.
class Canvas
{
public:
    Canvas(int width, int height);

    /// A dark, translucent ground for text, with round corners.
    void panel(const Rectangle &area);

    /// One line of text whose base line is at `y`.
    void text(double x, double y, const std::string &line, const Colour &colour, double size,
              Align align = Align::left);

    void colour(const Colour &colour, double opacity = 1);

    /// For all else: lines and shapes.
    cairo_t *context() { return context_.get(); }

    double width() const { return width_; }
    double height() const { return height_; }

    /// Lay it over what OpenGL has drawn in the window, which is as large.
    void show();

private:
    int width_;
    int height_;
    OwnedSurface surface_;
    OwnedContext context_;
};
} // namespace ode_predictive_space::window

#endif
