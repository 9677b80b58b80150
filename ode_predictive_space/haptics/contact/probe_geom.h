// The geom by which the probe is in the scene.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PROBE_GEOM_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PROBE_GEOM_H

#include "ode_predictive_space/haptics/contact/geom_watch.h"
#include "ode_predictive_space/haptics/device.h"

#include <memory>

namespace ode_predictive_space::haptics
{
/// A sphere of the library's own, which covers the region in which it looks for what it can touch, or a geom of the program, which goes
/// where the tool is. In a predictive space it gets the interactive role.
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
    bool is_gone() const { return watch_ && !watch_->is_there(); }

    /// Whether it may be moved: it is not gone, and not in a space that stays locked.
    bool may_be_touched() const { return !abandoned_ && !is_gone(); }

    /// To compare only: it may be gone.
    dGeomID id() const { return geom_; }

    /// Of the tool's place and size.
    dGeomID tool() const { return own_ ? tool_ : geom_; }

    /// m; the scene's frame: of the tool.
    const Vector3 &position() const { return position_; }
    double radius() const { return radius_; } ///< m; of a sphere of its own
    double margin() const { return margin_; } ///< m; see TouchSensor::set_margin()

    /// Of a sphere of its own.
    void set_margin(double margin);

    /// See TouchSensor.
    void abandon_locked_space();

    /// Of the program's: it goes to the tool. One that stays where it is is left alone, so that the space has nothing to do with it.
    void follow(const ToolState &tool);

    /// Of a sphere of its own: the tool goes there, and the sphere to the region (m) that is looked into; left alone as above.
    void look_around(const Vector3 &tool, const Vector3 &centre, double radius);

private:
    void become_interactive();

    dGeomID geom_;
    dGeomID sentinel_ = nullptr; ///< of a geom of the program that is in a space: it goes with that
    dGeomID tool_ = nullptr;     ///< of a sphere of its own: in no space, for dCollide()
    bool own_;
    bool abandoned_ = false; ///< nothing may be done to geom_
    bool turns_;             ///< whether the orientation matters
    bool posed_ = false;
    double radius_ = 0; ///< m; without the margin
    double margin_ = 0; ///< m
    Vector3 position_ = Vector3::Zero();
    Quaternion orientation_ = Quaternion::Identity();
    std::unique_ptr<GeomWatch> watch_; ///< of the sphere of its own or the sentinel
};
} // namespace ode_predictive_space::haptics

#endif
