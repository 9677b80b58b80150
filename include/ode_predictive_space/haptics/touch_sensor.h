// The probe's place in an ODE world.

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

/// What a geom is made of; nothing: what the force law says.
using MaterialOf = std::function<std::optional<Material>(dGeomID)>;

/// A geom that follows the hand, tells what it touches, and pushes what it touches. In a predictive space it gets the interactive
/// role. Which geoms it cannot touch is set as everywhere in ODE, by dGeomSetCategoryBits() and dGeomSetCollideBits().
///
/// Each tick: clear(), pose(), the program's dSpaceCollide() with touch() in its near callback, push(). In between the
/// program may destroy anything except this geom: what is gone is not pushed.
///
/// The sphere that the sensor makes holds to boxes, spheres, capsules, cylinders, planes, triangle meshes and, with set_samples(),
/// heightfields: it is touched from the side by which the tool came, until it comes back through there, however thin the
/// object, fast the tool, or deep it is. What the near callback does not tell of any more is released, and so is a mesh with
/// other triangles. It holds to all other geoms by a plane through the point that dCollide() finds nearest to the proxy. A geom of the
/// program has no proxy: it touches what dCollide() says at the moment.
///
/// What the sensor is in when it begins, or begins elsewhere, is not touched until the sensor has been outside of it once.
/// The same holds for a solid that appears around the sphere and holds all of it, and for a mesh that holds its middle.
class TouchSensor
{
public:
    /// Makes a sphere.
    ///
    /// @param space is not owned, and must outlive the sensor.
    /// @param radius m, > 0.
    /// @throws std::invalid_argument when the radius or the space is not one.
    TouchSensor(dSpaceID space, double radius);

    /// A geom of the program: of any class but planes and spaces, and without a body.
    ///
    /// A disabled sphere without size is put beside it into its space: ODE does not tell when a space is destroyed with its geoms, but
    /// this sphere tells it. The destruction of the geom alone cannot be found out.
    ///
    /// @param geom is not owned, and must outlive the sensor. Its space stays the same.
    /// @throws std::invalid_argument when it is 0, has a body, or cannot be placed.
    explicit TouchSensor(dGeomID geom);

    ~TouchSensor();
    TouchSensor(const TouchSensor &) = delete;
    TouchSensor &operator=(const TouchSensor &) = delete;

    /// Whether its geom was destroyed with its space: nothing is touched then.
    bool is_gone() const;

    /// 0 when it is gone. A sphere that the sensor makes has the place and size of the region in which it looks for what it can
    /// touch: larger than the tool while the tool moves or is pressed into something.
    dGeomID geom() const;

    /// Notice what comes near before it is touched: touches() then has what is up to this far away, too, with a negative
    /// depth. Works for the sphere that the sensor makes, which grows by that; other geoms notice nothing before they touch it.
    ///
    /// @param margin m, >= 0.
    void set_margin(double margin);

    /// Which touches to tell of: the force law's view().
    void set_view(TouchView view);

    /// N/m; the force law's: of what has no material of its own.
    void set_stiffness(double stiffness);

    /// What to ask for the materials of what is touched, in touch(). Empty: nothing.
    void set_materials(MaterialOf materials);

    /// Read a mesh now rather than when the probe first comes near it: a hundred thousand triangles take some 0.1 s. A mesh that was
    /// not prepared is read in parts while it is near, and touched as dCollide() says until it has been read.
    void prepare(dGeomID mesh);

    /// Whether a mesh that is near has not been read yet.
    bool is_reading() const;

    /// The same for all meshes that there are in the sensor's space, in those within it, and in those that it is in. Loops
    /// do this before they begin. Meshes in ODE's quadtree spaces, which cannot list their geoms, are read when they are
    /// first touched.
    void prepare_all();

    /// The triangles behind this id have changed in place. They are compared from tick to tick, too: those that are touched
    /// at once, the others in turn, eight at a time.
    void forget_mesh(dTriMeshDataID data);

    /// Hold to a heightfield as to a mesh: to all geoms of this data, until forget_samples(). ODE does not give its samples
    /// back, so that the program has to. Samples of other heights end a contact. Of a field that
    /// repeats itself without end, one period.
    ///
    /// @param samples are copied.
    /// @throws std::invalid_argument when they make no field.
    void set_samples(dHeightfieldDataID data, const HeightfieldSamples &samples);

    /// To be called before the data is destroyed: ODE may use its id again.
    void forget_samples(dHeightfieldDataID data);

    /// The tool was put somewhere else, and nothing lies between: what is entered from now on is entered from there.
    void forget_sides();

    /// An exception came through dSpaceCollide(), and the geom is in one of ODE's own spaces, which stays locked from then on.
    /// The geom is not touched any more: it is disabled, and stays in its space when the sensor goes. In predictive spaces
    /// there is nothing to do.
    void abandon_locked_space();

    /// s; how much time passes from one dSpaceCollide() to the next, as far as it is known: what came by its own motion is told
    /// from what appeared by that.
    void set_tick_length(double seconds);

    /// Forget the touches.
    void clear();

    /// Move the geom to the tool. One that stays where it is is left alone, so that the space has nothing to do with it.
    void pose(const ToolState &tool);

    /// For the near callback: if the probe is one of the two, find out how deep it is in the other.
    ///
    /// @return true when this pair has been dealt with: one of the two is the probe, the other one no space.
    bool touch(dGeomID first, dGeomID second);

    /// What is touched since clear(). An object is a body with all its geoms, or a geom without a body. Of what only
    /// dCollide() knows, the deepest contact with each object.
    const std::vector<Touch> &touches();

    /// Whether dCollide(), a geom's place, a body's velocity or a material had something that is not a number since clear(). It is left out of
    /// touches(), which are not all, then.
    bool saw_nonsense();

    /// Whether there were more touches, or geoms near, than the touch_capacity since clear().
    bool exceeds_capacity();

    /// The body of a touched object; 0 for one that has none, and for one that is gone.
    dBodyID body_of(std::uintptr_t object) const;

    /// For loops that run in two threads: the contact of the sphere that the sensor makes, 0 for another geom.
    ContactTracker *tracker();
    /// Of the sphere that the sensor makes, m.
    double radius() const;

    /// Give each body the opposite of its share of the force on the hand, where it was touched. A disabled body that gets a
    /// force is enabled. Objects without a body are left alone, and so are bodies that are gone.
    void push(const std::vector<ForceShare> &shares);

private:
    class Parts;
    std::unique_ptr<Parts> parts_;
};

/// What a body's motion is to force laws.
ToolState tool_state_of(dBodyID body);

/// dSpaceCollide() and dSpaceCollide2(), with a callback that may throw. ODE's own spaces stay locked for ever when an exception
/// goes through them; these two keep it until ODE is done, without further calls of the callback, and throw it then.
void safe_collide(dSpaceID space, void *data, dNearCallback *callback);
/// See safe_collide().
void safe_collide2(dGeomID first, dGeomID second, void *data, dNearCallback *callback);
} // namespace ode_predictive_space::haptics

#endif
