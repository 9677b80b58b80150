// The probe's place in an ODE world.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_TOUCH_SENSOR_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_TOUCH_SENSOR_H

#include "ode_predictive_space/haptics/body_watch.h"
#include "ode_predictive_space/haptics/force_shares.h"

#include <ode/collision.h>
#include <ode/objects.h>

namespace ode_predictive_space::haptics
{
/// A geom that follows the hand, tells what it touches, and pushes what it touches.
///
/// Each tick: clear(), pose(), the program's dSpaceCollide() with touch() in its near callback, push(). In between the program may
/// destroy what it likes, except this geom: what is gone is not pushed.
///
/// What the probe cannot touch is said as everywhere in ODE: by dGeomSetCategoryBits() and dGeomSetCollideBits().
class TouchSensor
{
public:
    /// A sphere of its own. In a predictive space it gets the interactive role.
    ///
    /// @param space is not owned, and must outlive the sensor.
    /// @param radius m, > 0.
    /// @throws std::invalid_argument when the radius or the space is not one.
    TouchSensor(dSpaceID space, double radius);

    /// A geom of the program: of any class but planes and spaces, and without a body. In a predictive space it gets the
    /// interactive role.
    ///
    /// @param geom is not owned, and must outlive the sensor.
    /// @throws std::invalid_argument when it is 0, has a body, or cannot be placed.
    explicit TouchSensor(dGeomID geom);

    ~TouchSensor();
    TouchSensor(const TouchSensor &) = delete;
    TouchSensor &operator=(const TouchSensor &) = delete;

    dGeomID geom() const { return geom_; }

    /// Notice what comes near before it is touched: touches() then has what is up to this far away, too, with a negative depth.
    /// Works for the sphere of its own, which grows by that; other geoms notice nothing before they touch it.
    ///
    /// @param margin m, >= 0.
    void set_margin(double margin);

    /// Forget the touches.
    void clear();

    /// Move the geom to the tool. One that stays where it is is left alone, so that the space has nothing to do with it.
    void pose(const ToolState &tool);

    /// For the near callback: if the probe is one of the two, find out how deep it is in the other.
    ///
    /// @return true when this pair has been dealt with: one of the two is the probe, the other one no space.
    bool touch(dGeomID first, dGeomID second);

    /// The deepest contact with each object since clear(), in the order in which the objects came. An object is a body with all
    /// its geoms, or a geom without a body.
    const std::vector<Touch> &touches() const { return touches_; }

    /// Whether dCollide() or a body's velocity gave something that is not a number since clear(). It is left out of touches(),
    /// which are not all, then.
    bool saw_nonsense() const { return nonsense_; }

    /// Give each body the opposite of its share of the force on the hand, where it was touched. A disabled body that gets a force is
    /// enabled. Objects without a body are left alone, and so are bodies that are gone.
    void push(const std::vector<ForceShare> &shares);

private:
    void become_interactive();
    void add(const dContactGeom &contact, dGeomID other);

    static constexpr int most_contacts = 256; ///< of one pair: a mesh gives many, of which one counts

    dGeomID geom_;
    bool own_;
    bool turns_ = true; ///< whether the orientation matters
    double radius_ = 0; ///< m; of the own sphere, without the margin
    double margin_ = 0; ///< m
    bool posed_ = false;
    Vector3 position_ = Vector3::Zero();
    Quaternion orientation_ = Quaternion::Identity();
    bool nonsense_ = false;
    std::vector<Touch> touches_;
    BodyWatch bodies_;
    std::vector<dContactGeom> contacts_; ///< most_contacts of them, for dCollide() to write to
};

/// What Touch::object is for a geom: its body, or itself if it has none.
std::uintptr_t object_of(dGeomID geom);

/// What a body's motion is to force laws.
ToolState tool_state_of(dBodyID body);

/// Add a force and a torque at the body's centre of mass; enables a disabled body unless both are zero.
void add_wrench(dBodyID body, const Wrench &wrench);
} // namespace ode_predictive_space::haptics

#endif
