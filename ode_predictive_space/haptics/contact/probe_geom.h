// The geom by which the probe is in the scene.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PROBE_GEOM_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PROBE_GEOM_H

#include "ode_predictive_space/haptics/device.h"

#include <ode/contact.h>
#include <optional>
#include <vector>

namespace ode_predictive_space::haptics
{
/// A sphere of the library's own, or a geom of the program: see TouchSensor.
///
/// ODE does not tell when a space is destroyed with its geoms, but a geom that is destroyed leaves its body. So a geom of ours in
/// the space gets a kinematic body of a world of its own, in which nothing happens.
class ProbeGeom
{
public:
    /// Makes a sphere. @throws std::invalid_argument when the radius or the space is not one.
    ProbeGeom(dSpaceID space, double radius);

    /// Of the program. @throws std::invalid_argument when it is 0, has a body, or cannot be placed.
    explicit ProbeGeom(dGeomID geom);
    ~ProbeGeom();
    ProbeGeom(const ProbeGeom &) = delete;
    ProbeGeom &operator=(const ProbeGeom &) = delete;

    /// Whether it was destroyed with its space.
    bool is_gone() const;

    /// Whether it may be moved: it is not gone, and not in a space that stays locked.
    bool may_be_touched() const { return !abandoned_ && !is_gone(); }

    /// To compare only: it may be gone.
    dGeomID id() const { return geom_; }

    /// Of the tool's place and size.
    dGeomID tool() const { return tool_; }

    double radius() const { return radius_; } ///< m; of a sphere of its own
    double margin() const { return margin_; } ///< m; see TouchSensor::set_margin()

    /// Of a sphere of its own.
    void set_margin(double margin);

    /// The deepest contact of a geom with the tool, or with a sphere of its own that is elsewhere meanwhile; nothing when they do not touch.
    std::optional<dContactGeom> contact_with(dGeomID other);
    std::optional<dContactGeom> contact_with(dGeomID other, const Vector3 &centre, double radius);

    /// See TouchSensor.
    void abandon_locked_space();

    /// Of the program's: it goes to the tool. One that stays where it is is left alone, so that the space has nothing to do with it.
    void follow(const ToolState &tool);

    /// Of a sphere of its own: the tool goes there, and the sphere to the region (m) that is looked into; left alone as above.
    void look_around(const Vector3 &tool, const Vector3 &centre, double radius);

private:
    bool is_own() const { return tool_ != geom_; }
    void become_interactive();
    void watch(dGeomID geom);

    dGeomID geom_;
    dGeomID tool_;                          ///< of a sphere of its own, another one: in no space, for dCollide()
    dGeomID watched_ = nullptr;             ///< geom_, or a sentinel beside a geom of the program that is in a space
    dBodyID watch_ = nullptr;               ///< of watched_; alone in its world
    bool abandoned_ = false;                ///< nothing may be done to geom_
    double radius_ = 0;                     ///< m; without the margin
    double margin_ = 0;                     ///< m
    std::optional<Quaternion> orientation_; ///< as set last
    std::vector<dContactGeom> contacts_;    ///< room for those of a pair
};
} // namespace ode_predictive_space::haptics

#endif
