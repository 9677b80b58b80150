// The window shows a run in another thread, and passes on the inputs of the person.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_WINDOW_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_WINDOW_H

#include "demos/window/view.h"

#include <string>
#include <vector>

namespace ode_predictive_space::window
{
/// The pointer over the window.
struct Pointer
{
    int x = 0, y = 0;     ///< pixels from the upper left corner of the window
    unsigned buttons = 0; ///< held: bit 0 left, 1 middle, 2 right
    int wheel = 0;        ///< steps: +1 away from the person, -1 towards
};

/// The contents of the window. All functions are called from the thread that called run_window(), and must not wait.
class Shown
{
public:
    virtual ~Shown() = default;

    /// The latest state.
    virtual const View &view() = 0;

    /// Whether the window is to close.
    virtual bool ended() = 0;

    /// A key that is not one of the window's own. @return whether it has an effect.
    virtual bool key(char key) = 0;

    /// The keys that it handles.
    virtual std::vector<KeyHelp> keys() const = 0;

    /// The picture that WindowSettings asks for has been taken.
    virtual void picture_taken() = 0;

    /// An event of the pointer. @return whether it is handled: then it does not move the camera.
    virtual bool pointer(const Pointer &pointer) = 0;
};

/// Initial settings of the window.
struct WindowSettings
{
    int width = 1280;       ///< pixels
    int height = 800;       ///< pixels
    std::string screenshot; ///< file; empty: only screenshots requested by key
    double screenshot_time =
        0; ///< simulated seconds; the first view that is not earlier is taken. The window waits for it
};

/// Whether there is a display for a window.
bool has_display();

/// Show the window until the run has ended or the person closes it. Once per process.
///
/// @throws std::runtime_error when a screenshot cannot be written.
void run_window(Shown &shown, const WindowSettings &settings);
} // namespace ode_predictive_space::window

#endif
