// The probe's geom in the scene: the library's sphere or a geom of the program (see TouchSensor).

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PROBE_GEOM_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PROBE_GEOM_H

#include "ode_predictive_space/haptics/device.h"

#include <ode/contact.h>
#include <optional>
#include <vector>

namespace ode_predictive_space::haptics
{
/// ODE does not report that a space is destroyed with its geoms, but a destroyed geom leaves its body. So a geom in the space
/// is attached to a kinematic body in a separate, empty world.
class ProbeGeom
{
public:
    /// Makes a sphere. @throws std::invalid_argument for a radius or a space that is not valid.
    ProbeGeom(dSpaceID space, double radius);

    /// Takes a geom of the program. @throws std::invalid_argument when it is 0, has a body, or cannot be placed.
    explicit ProbeGeom(dGeomID geom);
    ~ProbeGeom();
    ProbeGeom(const ProbeGeom &) = delete;
    ProbeGeom &operator=(const ProbeGeom &) = delete;

    /// Whether the geom was destroyed with its space.
    bool is_gone() const;

    /// Whether the geom may be moved: it exists, and its space is not locked for good.
    bool may_be_touched() const { return !abandoned_ && !is_gone(); }

    /// For comparisons only: the geom may be gone.
    dGeomID id() const { return geom_; }

    dGeomID tool() const { return tool_; }

    double radius() const { return radius_; } ///< m; of the library's sphere

    /// Changes the radius of the library's sphere at once; look_around() sets it in each tick.
    void set_margin(double margin);

    /// The deepest contact of a geom with the tool, or with a sphere (m); nothing if they do not touch.
    std::optional<dContactGeom> contact_with(dGeomID other);
    std::optional<dContactGeom> contact_with(dGeomID other, const Vector3 &centre, double radius);

    void abandon_locked_space();

    /// Moves a geom of the program to the tool. A geom that stays in place is not touched, to spare the space a notice.
    void follow(const ToolState &tool);

    /// Moves the library's sphere to the region of the search (m), and the tool to its place.
    void look_around(const Vector3 &tool, const Vector3 &centre, double radius);

private:
    bool is_own() const { return tool_ != geom_; }
    void become_interactive();
    void watch(dGeomID geom);

    dGeomID geom_;
    dGeomID tool_;                          ///< for the library's sphere a second one, in no space, for dCollide()
    dGeomID watched_ = nullptr;             ///< geom_, or a sentinel beside a geom of the program that is in a space
    dBodyID watch_ = nullptr;               ///< of watched_; alone in its world
    bool abandoned_ = false;                ///< geom_ must not be touched
    double radius_ = 0;                     ///< m
    std::optional<Quaternion> orientation_; ///< as set last
    std::vector<dContactGeom> contacts_;    ///< buffer for dCollide()
};
} // namespace ode_predictive_space::haptics

#endif
