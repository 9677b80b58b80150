// A device in a demo. Its probe is created when it is needed, and again in another space.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_ODE_HAND_H
#define ODE_PREDICTIVE_SPACE_DEMOS_ODE_HAND_H

#include "ode_predictive_space/haptics/mouse_device.h"
#include "ode_predictive_space/haptics/probe.h"

#include <deque>
#include <drawstuff/drawstuff.h>
#include <memory>
#include <optional>
#include <string>

namespace ode_predictive_space::ode_demos
{
using haptics::Vector3;

/// The volume of a demo, in the scene's frame, metres, and the direction in which the person looks.
struct Place
{
    dSpaceID space = nullptr;
    Eigen::AlignedBox3d bounds;
    double heading = 0; ///< degrees from the x axis, counter-clockwise: the direction of sight
};

/// The hand runs by the wall clock, at drawstuff's 60 frames per second, however long the demo's step is.
constexpr double frame_seconds = 1.0 / 60;

class Hand
{
public:
    /// @param device a name that make_device() knows. @throws std::invalid_argument, haptics::DeviceError.
    explicit Hand(const std::string &device);
    ~Hand();
    Hand(const Hand &) = delete;
    Hand &operator=(const Hand &) = delete;

    /// For the near callback: see HapticProbe::touch(). Nested spaces are searched; rays are left to the demo.
    bool touch(dGeomID first, dGeomID second);

    /// One frame: force and reactions; then the probe moves to the hand's next place. In a new volume it is only placed.
    void step(const Place &place);

    /// Destroys the geom; call it before its space is destroyed.
    void leave() { probe_.reset(); }

    /// Draw it, within a step of drawstuff's loop.
    void draw();

    /// From drawstuff's callback. With a button held, the camera moves instead of the probe.
    void pointer(const dsPointerEvent &event);

    int frames_with_force() const { return frames_with_force_; }
    double largest_force() const { return largest_force_; } ///< N, in the scene

private:
    void make_probe(const Place &place);
    double hand_stiffness() const;
    haptics::WorkspacePlacement placement_in(const Place &place) const;
    void draw_force() const;
    void draw_what_comes_next();

    std::unique_ptr<haptics::Device> device_;
    haptics::MouseDevice *mouse_; ///< null for other devices
    std::unique_ptr<haptics::HapticProbe> probe_;
    double radius_ = 0; ///< m; of the probe
    double time_ = 0;   ///< s; of the hand
    std::deque<Vector3> trail_;
    std::optional<dsPointerEvent> last_pointer_;
    int frames_with_force_ = 0;
    double largest_force_ = 0;
};
} // namespace ode_predictive_space::ode_demos

#endif
