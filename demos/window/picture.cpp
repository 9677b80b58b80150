#include "demos/window/picture.h"

#include "demos/window/canvas.h"

#include <GL/gl.h>
#include <algorithm>
#include <stdexcept>
#include <vector>

namespace ode_predictive_space::window
{
void save_picture(const std::string &file)
{
    GLint area[4]; // left, bottom, width, height
    glGetIntegerv(GL_VIEWPORT, area);
    const auto width = static_cast<std::size_t>(area[2]);
    const auto height = static_cast<std::size_t>(area[3]);
    std::vector<std::uint32_t> pixels(width * height);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, area[2], area[3], GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, pixels.data());
    // OpenGL begins with the lowest row, a picture with the highest.
    for (std::size_t row = 0; row < height / 2; ++row)
    {
        const auto begin = [&](std::size_t number) {
            return pixels.begin() + static_cast<std::ptrdiff_t>(number * width);
        };
        std::swap_ranges(begin(row), begin(row + 1), begin(height - 1 - row));
    }
    const OwnedSurface picture(cairo_image_surface_create_for_data(
        reinterpret_cast<unsigned char *>(pixels.data()), CAIRO_FORMAT_RGB24, area[2], area[3],
        cairo_format_stride_for_width(CAIRO_FORMAT_RGB24, area[2])));
    const cairo_status_t status = cairo_surface_write_to_png(picture.get(), file.c_str());
    if (status != CAIRO_STATUS_SUCCESS)
        throw std::runtime_error("cannot write " + file + ": " + cairo_status_to_string(status));
}
} // namespace ode_predictive_space::window
