#include "demos/window/window.h"

#include "demos/window/overlay.h"
#include "demos/window/picture.h"
#include "demos/window/scene_drawing.h"

#include <GL/gl.h>
#include <X11/Xlib.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <drawstuff/drawstuff.h>
#include <exception>
#include <iostream>

namespace ode_predictive_space::window
{
namespace
{
constexpr double camera_heading = 158; // degrees from the x axis, counter-clockwise: roughly along -x
constexpr double camera_pitch = -20;   // degrees
constexpr double radians = 3.14159265358979323846 / 180;

/// drawstuff's callbacks take no data, and its loop runs once per process: there is one window.
class Window
{
public:
    Window(Shown &shown, const WindowSettings &settings) : shown_(shown), settings_(settings) { current = this; }
    ~Window() { current = nullptr; }
    Window(const Window &) = delete;
    Window &operator=(const Window &) = delete;

    void run();

private:
    void start();
    void step();
    void key(char key);
    bool toggle(char key);
    bool pointer(const dsPointerEvent &event);
    void place_camera(const SceneView &view);
    void take_picture(const std::string &file, double time);
    bool picture_is_due(const SceneView &view) const
    {
        return !settings_.screenshot.empty() && !view.geoms.empty() && view.time >= settings_.screenshot_time;
    }
    std::vector<KeyHelp> keys() const;

    /// Exceptions must not pass through drawstuff, which is C to its callers.
    template <typename Work> void guarded(Work work)
    {
        try
        {
            work();
        }
        catch (...)
        {
            failure_ = std::current_exception();
            dsStop();
        }
    }

    static Window *current;

    Shown &shown_;
    WindowSettings settings_;
    Layers layers_;
    bool camera_placed_ = false;
    bool picture_wanted_ = false;
    int pictures_ = 0;
    std::exception_ptr failure_;
};

Window *Window::current = nullptr;

void Window::run()
{
    dsFunctions functions{};
    functions.version = DS_VERSION;
    functions.start = [] { current->start(); };
    functions.step = [](int) { current->guarded([] { current->step(); }); };
    functions.command = [](int key) { current->guarded([key] { current->key(static_cast<char>(key)); }); };
    dsSetPointerCallback([](const dsPointerEvent *event) { return current->pointer(*event) ? 1 : 0; });
    char name[] = "predictive_haptic_demo";
    char no_shadows[] = "-noshadow"; // translucent objects have none
    char *arguments[] = {name, no_shadows, nullptr};
    dsSimulationLoop(2, arguments, settings_.width, settings_.height, &functions);
    dsSetPointerCallback(nullptr);
    if (failure_)
        std::rethrow_exception(failure_);
}

void Window::start()
{
    dsSetSphereQuality(3);
    dsSetCapsuleQuality(6);
}

void Window::step()
{
    const bool ended = shown_.ended();
    const View &view = shown_.view();
    if (ended && !picture_is_due(view))
        dsStop();
    if (view.geoms.empty())
        return;
    if (!camera_placed_)
    {
        place_camera(view); // effective from the next frame on
        return;
    }
    float eye[3];
    dsGetViewpoint(eye, nullptr);
    draw_scene(view, layers_, Vector3(eye[0], eye[1], eye[2]));
    if (layers_.text)
    {
        GLint area[4];
        glGetIntegerv(GL_VIEWPORT, area);
        Canvas canvas(area[2], area[3]);
        draw_overlay(canvas, view, keys());
        canvas.show();
    }
    if (picture_is_due(view))
    {
        take_picture(settings_.screenshot, view.time);
        settings_.screenshot.clear();
        shown_.picture_taken();
    }
    if (picture_wanted_)
    {
        char file[40];
        std::snprintf(file, sizeof file, "haptic_demo_%02d.png", ++pictures_);
        take_picture(file, view.time);
        picture_wanted_ = false;
    }
}

void Window::take_picture(const std::string &file, double time)
{
    save_picture(file);
    std::cout << "Picture of " << time << " s: " << file << std::endl;
}

void Window::place_camera(const SceneView &view)
{
    camera_placed_ = true;
    const Vector3 middle = (view.low + view.high) / 2 + shift_onto_floor(view);
    const Vector3 forwards(std::cos(camera_pitch * radians) * std::cos(camera_heading * radians),
                           std::cos(camera_pitch * radians) * std::sin(camera_heading * radians),
                           std::sin(camera_pitch * radians));
    const Vector3 eye = middle - 0.88 * (view.high - view.low).norm() * forwards;
    float position[3] = {static_cast<float>(eye.x()), static_cast<float>(eye.y()), static_cast<float>(eye.z())};
    float direction[3] = {static_cast<float>(camera_heading), static_cast<float>(camera_pitch), 0};
    dsSetViewpoint(position, direction);
}

bool Window::toggle(char key)
{
    bool *layer = nullptr;
    switch (key)
    {
    case 'e':
        layer = &layers_.envelopes;
        break;
    case 'o':
        layer = &layers_.object_envelopes;
        break;
    case 'n':
        layer = &layers_.near_pairs;
        break;
    case 'f':
        layer = &layers_.force;
        break;
    case 'h':
        layer = &layers_.text;
        break;
    case 'v':
        layer = &layers_.only_nearby;
        break;
    default:
        return false;
    }
    *layer = !*layer;
    return true;
}

void Window::key(char key)
{
    if (key == 'q')
        dsStop();
    else if (key == 's')
        picture_wanted_ = true;
    else if (!toggle(key))
        shown_.key(key);
}

std::vector<KeyHelp> Window::keys() const
{
    std::vector<KeyHelp> all = shown_.keys();
    all.push_back({"e", "envelope of the probe", layers_.envelopes});
    all.push_back({"o", "envelopes of objects", layers_.object_envelopes});
    all.push_back({"n", "near pairs", layers_.near_pairs});
    all.push_back({"f", "force", layers_.force});
    all.push_back({"v", "pale far away", layers_.only_nearby});
    all.push_back({"h", "text", layers_.text});
    all.push_back({"s", "screenshot", true});
    all.push_back({"q", "end", true});
    return all;
}

bool Window::pointer(const dsPointerEvent &event)
{
    return shown_.pointer({event.x, event.y, static_cast<unsigned>(event.buttons), event.wheel});
}
} // namespace

bool has_display()
{
    // A server restarts when its last client leaves, and accepts none meanwhile: this client stays until the program ends.
    static Display *const display = XOpenDisplay(nullptr);
    int ignored = 0;
    return display != nullptr && XQueryExtension(display, "GLX", &ignored, &ignored, &ignored) != 0;
}

void run_window(Shown &shown, const WindowSettings &settings)
{
    Window(shown, settings).run();
}
} // namespace ode_predictive_space::window
