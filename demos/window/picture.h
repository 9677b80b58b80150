// Screenshots.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_PICTURE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_PICTURE_H

#include <string>

namespace ode_predictive_space::window
{
/// Write the present picture of OpenGL to a PNG file.
///
/// @throws std::runtime_error when it cannot be written; the message names the file.
void save_picture(const std::string &file);
} // namespace ode_predictive_space::window

#endif
