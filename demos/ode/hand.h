// A device in a demo: a probe that is made when it is needed, and made anew in another space.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_ODE_HAND_H
#define ODE_PREDICTIVE_SPACE_DEMOS_ODE_HAND_H

#include "ode_predictive_space/haptics/mouse_device.h"
#include "ode_predictive_space/haptics/probe.h"

#include <deque>
#include <drawstuff/drawstuff.h>
#include <memory>
#include <string>

namespace ode_predictive_space::ode_demos
{
using haptics::Vector3;

/// Where a demo takes place, in the scene's frame, metres, and from where the person looks at it.
struct Place
{
    dSpaceID space = nullptr;
    Eigen::AlignedBox3d bounds;
    double heading = 0; ///< degrees from the x axis, counter-clockwise: the direction of sight
};

/// The hand lives by the wall clock, on which drawstuff shows 60 frames a second, however long the demo's step is.
constexpr double frame_seconds = 1.0 / 60;

class Hand
{
public:
    /// Opens the device.
    ///
    /// @param device as make_device() names it.
    /// @throws std::invalid_argument, haptics::DeviceError: see make_device() and Device::open().
    explicit Hand(const std::string &device);
    ~Hand();
    Hand(const Hand &) = delete;
    Hand &operator=(const Hand &) = delete;

    /// For the near callback: see HapticProbe::touch(). Spaces are looked into; rays are the demo's own business.
    bool touch(dGeomID first, dGeomID second);

    /// One frame: force and reactions; then the probe is moved to where the hand is next. In a new place it only gets there.
    void step(const Place &place);

    /// The geom goes, before its space.
    void leave() { probe_.reset(); }

    /// Draw it: inside of a step of drawstuff's loop.
    void draw();

    /// From drawstuff's callback. A button held moves the camera, not the probe.
    void pointer(const dsPointerEvent &event);

    const std::string &name() const { return name_; }
    int frames_with_force() const { return frames_with_force_; }
    double largest_force() const { return largest_force_; } ///< N, in the scene

private:
    void make_probe(const Place &place);
    double hand_stiffness() const;
    haptics::WorkspacePlacement placement_in(const Place &place) const;
    void touch_inside(dSpaceID space);
    void draw_force() const;
    void draw_what_comes_next();

    std::string name_;
    std::unique_ptr<haptics::Device> device_;
    haptics::MouseDevice *mouse_; ///< null when the device is none
    std::unique_ptr<haptics::HapticProbe> probe_;
    double radius_ = 0; ///< m; of the probe
    double time_ = 0;   ///< s; of the hand
    std::deque<Vector3> trail_;
    bool has_pointer_ = false;
    int last_x_ = 0;
    int last_y_ = 0;
    int frames_with_force_ = 0;
    double largest_force_ = 0;
};
} // namespace ode_predictive_space::ode_demos

#endif
