// The window: it shows a run that goes on in another thread, and passes on what the person does.

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

/// What the window shows. All functions are called from the thread that called run_window(), and must not wait.
class Shown
{
public:
    virtual ~Shown() = default;

    /// The latest state.
    virtual const View &view() = 0;

    /// Whether the window is to close.
    virtual bool ended() = 0;

    /// A key that is not one of the window's own. @return whether it means something.
    virtual bool key(char key) = 0;

    /// What keys there are for it.
    virtual std::vector<KeyHelp> keys() const = 0;

    /// The picture that WindowSettings asks for has been taken.
    virtual void picture_taken() = 0;

    /// The pointer did something. @return whether it is taken: then it does not move the camera.
    virtual bool pointer(const Pointer &pointer) = 0;
};

/// How the window begins.
struct WindowSettings
{
    int width = 1280;       ///< pixels
    int height = 800;       ///< pixels
    std::string screenshot; ///< file; empty: none but those that are asked for by key
    double screenshot_time =
        0; ///< simulated seconds; the first view that is not earlier is the one. The window waits for it
};

/// Whether there is a display that a window can be opened on.
bool has_display();

/// Show it until it has ended or the person closes the window. Once per process.
///
/// @throws std::runtime_error when a screenshot cannot be written.
void run_window(Shown &shown, const WindowSettings &settings);
} // namespace ode_predictive_space::window

#endif
