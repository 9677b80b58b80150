// The probe's geom in an ODE world.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_TOUCH_SENSOR_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_TOUCH_SENSOR_H

#include "ode_predictive_space/haptics/touch.h"

#include <functional>
#include <memory>
#include <ode/collision.h>
#include <ode/collision_space.h>
#include <ode/collision_trimesh.h>
#include <ode/objects.h>
#include <vector>

namespace ode_predictive_space::haptics
{
class ContactTracker;
class NearbyGeom;

/// Returns the material of a geom, or nothing for the force law's.
using MaterialOf = std::function<std::optional<Material>(dGeomID)>;

/// A geom that follows the hand, reports its touches, and pushes the touched bodies. In a predictive space it has the
/// interactive role. dGeomSetCategoryBits() and dGeomSetCollideBits() select its pairs.
///
/// Call order in each tick: clear(), pose(), the program's dSpaceCollide() with touch() in its near callback,
/// touches(), push(). In between the program may destroy all objects except this geom. For one thread.
///
/// The sensor's sphere keeps the side of entry of boxes, spheres, capsules, cylinders, planes, triangle meshes and,
/// with set_samples(), heightfields until the tool comes back out there, for any thickness, speed and depth. Geoms that
/// the near callback no longer reports are released, and so are meshes with changed triangles. Other geoms are
/// represented by the plane through the point that dCollide() finds nearest to the proxy. A geom of the program has no
/// proxy, and uses the contacts of dCollide().
///
/// A geom that contains the sensor at its beginning, or after a jump, is not touched until the sensor has been outside.
/// So is a solid that appears around the whole sphere, and a mesh that appears around its centre.
class TouchSensor
{
public:
    /// Makes a sphere.
    ///
    /// @param space not owned; must outlive the sensor.
    /// @param radius m, > 0.
    /// @throws std::invalid_argument for a radius or a space that is not valid.
    TouchSensor(dSpaceID space, double radius);

    /// Uses a geom of the program: of any class but planes and spaces, and without a body.
    ///
    /// Adds a disabled sphere without size to its space, which detects the destruction of the space. The destruction of
    /// the geom alone cannot be detected.
    ///
    /// @param geom not owned; must outlive the sensor, in the same space.
    /// @throws std::invalid_argument when it is 0, has a body, or cannot be placed.
    explicit TouchSensor(dGeomID geom);

    ~TouchSensor();
    TouchSensor(const TouchSensor &) = delete;
    TouchSensor &operator=(const TouchSensor &) = delete;

    /// Whether its geom was destroyed with its space, so that nothing is touched.
    bool is_gone() const;

    /// The geom; 0 when it is gone. The sensor's sphere covers the region of the search: it is larger than the tool
    /// while the tool moves or presses.
    dGeomID geom() const;

    /// Adds surfaces up to this distance to touches(), with a negative depth. For the sensor's sphere, which grows by
    /// it.
    ///
    /// @param margin m, >= 0.
    void set_margin(double margin);

    /// Sets the force law's view().
    void set_view(TouchView view);

    /// Sets the force law's stiffness, N/m, for objects without a material.
    void set_stiffness(double stiffness);

    /// Sets the function for materials, which touch() calls; may be empty.
    void set_materials(MaterialOf materials);

    /// Reads a mesh now: a hundred thousand triangles take some 0.1 s. A mesh that was not prepared is read in parts
    /// while it is near, and until then represented by a plane from dCollide().
    void prepare(dGeomID mesh);

    /// Whether a near mesh is still being read.
    bool is_reading() const;

    /// Reads all meshes in the sensor's outermost space and the spaces in it, as loops do before they begin; except in
    /// ODE's quadtree spaces, which cannot list their geoms.
    void prepare_all();

    /// Drops the copy of triangles that have changed in place. Each tick also compares the touched triangles and eight
    /// others.
    void forget_mesh(dTriMeshDataID data);

    /// Treats all geoms of a heightfield's data as a mesh, until forget_samples(). ODE gives no access to samples, so
    /// the program has to. Other samples end a contact. An infinite field needs one period.
    ///
    /// @param samples copied.
    /// @throws std::invalid_argument for samples that are not a field.
    void set_samples(dHeightfieldDataID data, const HeightfieldSamples &samples);

    /// Forgets samples. Call it before the data is destroyed, because ODE may reuse its id.
    void forget_samples(dHeightfieldDataID data);

    /// Forgets the sides of entry, because the tool was put elsewhere.
    void forget_sides();

    /// Leaves the geom in a space of ODE that an exception through dSpaceCollide() has locked: the geom is disabled,
    /// and remains after the sensor. No effect in predictive spaces.
    void abandon_locked_space();

    /// Sets the time (s) from one dSpaceCollide() to the next, which distinguishes moving geoms from geoms that appear.
    void set_tick_length(double seconds);

    /// Begins a tick: forgets the touches.
    void clear();

    /// Moves the geom to the tool. A geom that stays in place is not touched, to spare the space a notice.
    void pose(const ToolState &tool);

    /// For the near callback: measures the contact of the probe with another geom.
    ///
    /// @return true if one of the two is the probe and the other one is no space.
    bool touch(dGeomID first, dGeomID second);

    /// The touches since clear(). An object is a body with all its geoms, or a geom without a body. A geom of the
    /// program has the deepest contact with each object.
    const std::vector<Touch> &touches();

    /// Whether a contact, a pose, a velocity or a material since clear() was not finite, so that touches() is
    /// incomplete.
    bool saw_nonsense();

    /// Whether touches or near geoms since clear() exceeded touch_capacity.
    bool exceeds_capacity();

    /// The body of a touched object; 0 without one, and after its destruction.
    dBodyID body_of(std::uintptr_t object) const;

    /// The tracker of the sensor's sphere, for loops of two threads; 0 for other geoms.
    ContactTracker *tracker();

    /// For loops of two threads, after touches(): copies the geoms near the sensor's sphere, or those in contact with a geom of
    /// the program.
    void hand_over(std::vector<NearbyGeom> &geoms) const;

    /// The radius of the sensor's sphere, m.
    double radius() const;

    /// Adds the opposite of each share to its body at the touched point, and enables disabled bodies. Ignores objects
    /// without a body, and destroyed bodies.
    void push(const std::vector<ForceShare> &shares);

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};

/// The motion of a body.
ToolState tool_state_of(dBodyID body);

/// Calls dSpaceCollide() with a callback that may throw. An exception would leave ODE's own spaces locked, so it is
/// kept until ODE has returned, without further callbacks, and then rethrown.
void safe_collide(dSpaceID space, void *data, dNearCallback *callback);
/// Calls dSpaceCollide2() as safe_collide() does.
void safe_collide2(dGeomID first, dGeomID second, void *data, dNearCallback *callback);
} // namespace ode_predictive_space::haptics

#endif
