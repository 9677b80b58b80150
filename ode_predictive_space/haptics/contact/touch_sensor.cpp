#include "ode_predictive_space/haptics/touch_sensor.h"

#include "ode_predictive_space/haptics/contact/body_watch.h"
#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "ode_predictive_space/haptics/contact/excluded_geoms.h"
#include "ode_predictive_space/haptics/contact/material.h"
#include "ode_predictive_space/haptics/contact/ode_vector.h"
#include "ode_predictive_space/haptics/contact/other_probes.h"
#include "ode_predictive_space/haptics/contact/probe_geom.h"
#include "ode_predictive_space/haptics/contact/scene_geoms.h"
#include "ode_predictive_space/haptics/contact/short_list.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr std::size_t steps_of_tick = 16000; // of reading meshes
constexpr double widest_sphere = 8;          // radii of the probe; for dCollide()
constexpr double most_spheres = 8;           // for each geom and tick
} // namespace

class TouchSensor::Parts
{
public:
    template <typename... Arguments> explicit Parts(Arguments... arguments) : geom(arguments...)
    {
        touches.reserve(touch_capacity);
        collided.reserve(touch_capacity);
        place.radius = geom.radius();
    }

    void hold(dGeomID other)
    {
        const Motion motion = poses.motion_of(other, pose_of(other), place.centre, place.tick);
        std::optional<NearbyGeom> nearby = NearbyGeom::read(other, meshes, tracker->touched_triangles(other));
        const bool by_plane = !nearby;
        if (by_plane)
            nearby = behind_plane(other);
        nonsense = nonsense || (nearby && !nearby->is_finite());
        if (!nearby || !nearby->is_finite())
            return;
        nearby->set_motion(motion);
        const double depth = place.radius - nearby->distance(place.centre, place.radius);
        if (by_plane ? excluded.excludes(other, depth, place) : excluded.excludes(*nearby, place))
            return;
        if (const dBodyID body = dGeomGetBody(other))
            bodies.keep(body);
        nearby->set_material(material_of(other));
        tracker->add_if_near(std::move(*nearby));
    }

    /// A geom whose surface dCollide() alone knows. The contact is that of a sphere that covers the region of the search, about
    /// the proxy, or about the tool where each object is felt alone. ODE's memory and time for a heightfield grow with the fourth
    /// power of that sphere's radius. So the sphere is bounded, and moves from the proxy towards the tool until it touches.
    std::optional<NearbyGeom> behind_plane(dGeomID other)
    {
        const bool alone = wanted.view == TouchView::each_object_alone;
        const Vector3 start = alone ? tracker->tool() : tracker->start_beside(other);
        const Vector3 way = tracker->tool() - start;
        const ContactTracker::Region region = tracker->region();
        const double whole = (region.centre - start).norm() + region.radius;
        const double radius = std::min(whole, widest_sphere * geom.radius() + tracker->margin());
        const double length = way.norm();
        const double steps = radius < whole ? std::min(std::ceil(length / radius), most_spheres - 1) : 0;
        for (int step = 0; step <= steps; ++step)
        {
            const double gone = step * radius;
            const Vector3 centre = gone < length ? Vector3(start + gone / length * way) : tracker->tool();
            if (const std::optional<dContactGeom> contact = geom.contact_with(other, centre, radius))
                return behind_plane(other, *contact, centre, radius);
        }
        return std::nullopt;
    }

    std::optional<NearbyGeom> behind_plane(dGeomID other, const dContactGeom &contact, const Vector3 &centre,
                                           double radius)
    {
        const Vector3 normal = from_ode(contact.normal);
        const Vector3 point = centre - (radius - static_cast<double>(contact.depth)) * normal;
        nonsense = nonsense || !point.allFinite();
        return point.allFinite() ? std::optional(NearbyGeom::behind_plane(other, point, normal)) : std::nullopt;
    }

    /// Adds the tools of other probes. Both use the lower stiffness, so that both feel the same force.
    void hold_other_probes()
    {
        others.update();
        for (const ProbeTool &other : others.near())
        {
            NearbyGeom tool = NearbyGeom::of(other);
            if (!tool.is_finite() || excluded.excludes(tool, place))
                continue;
            Material material;
            material.stiffness = std::min(wanted.stiffness, other.stiffness);
            tool.set_material(material);
            tracker->add_if_near(std::move(tool));
        }
    }

    void announce(const ToolState &tool)
    {
        ProbeTool self;
        self.region = geom.id();
        self.sphere = geom.tool();
        self.object = object_of(geom.id());
        self.scene = outermost_space_of(geom.id());
        self.category = dGeomGetCategoryBits(geom.id());
        self.collides = dGeomGetCollideBits(geom.id());
        self.centre = tool.position;
        self.velocity = tool.linear_velocity;
        self.radius = geom.radius();
        self.stiffness = wanted.stiffness;
        others.announce(self);
    }

    void collide(dGeomID other)
    {
        const Motion motion = poses.motion_of(other, pose_of(other), place.centre, place.tick);
        const std::optional<dContactGeom> contact = geom.contact_with(other);
        if (!contact || excluded.excludes(other, static_cast<double>(contact->depth), place))
            return;
        NearbyGeom nearby = NearbyGeom::at_contact(other, *contact, place.centre);
        nearby.set_motion(motion);
        nearby.set_material(material_of(other));
        if (const dBodyID body = dGeomGetBody(other))
            bodies.keep(body);
        const Touch touch = nearby.touch_at(place.centre);
        nonsense = nonsense || !is_finite(touch);
        if (!is_finite(touch))
            return;
        NearbyGeom *known = find_in(collided, [&](const NearbyGeom &geom) { return geom.object() == touch.object; });
        if (known == nullptr)
            collided.push_back(std::move(nearby));
        else if (touch.depth > known->touch_at(place.centre).depth)
            *known = std::move(nearby);
    }

    std::optional<Material> material_of(dGeomID other)
    {
        std::optional<Material> material = wanted.materials ? wanted.materials(other) : std::nullopt;
        if (material && !is_valid(*material))
        {
            nonsense = true;
            material.reset();
        }
        return material;
    }

    void resolve()
    {
        if (resolved)
            return;
        resolved = true;
        exceeds_capacity = false;
        touches.clear();
        for (const NearbyGeom &nearby : collided)
            touches.push_back(nearby.touch_at(place.centre));
        if (tracker)
        {
            if (geom.may_be_touched())
                hold_other_probes();
            tracker->follow();
            nonsense = !tracker->touches(wanted.view, touches) || nonsense;
            exceeds_capacity = tracker->exceeds_capacity();
        }
        exceeds_capacity = keep_within_capacity(touches) || exceeds_capacity;
    }

    struct Wanted
    {
        MaterialOf materials;
        TouchView view = TouchView::each_object_alone;
        double stiffness = 0; ///< N/m; for objects without a material
    };

    ProbeGeom geom;
    std::optional<ContactTracker> tracker; ///< of the sphere that the sensor makes
    ExcludedGeoms excluded;
    PoseWatch poses;
    OtherProbes others;
    MeshStore meshes;
    BodyWatch bodies;
    Wanted wanted;
    std::vector<Touch> touches;
    std::vector<NearbyGeom> collided; ///< with a geom of the program, by dCollide()
    ProbePlace place;                 ///< `begins` is set from forget_sides() to the next touches()
    bool nonsense = false;
    bool exceeds_capacity = false;
    bool resolved = true; ///< touches is complete
};

TouchSensor::TouchSensor(dSpaceID space, double radius) : parts_(std::make_unique<Parts>(space, radius))
{
    parts_->tracker.emplace(radius);
}

TouchSensor::TouchSensor(dGeomID geom) : parts_(std::make_unique<Parts>(geom)) {}

TouchSensor::~TouchSensor() = default;

bool TouchSensor::is_gone() const
{
    return parts_->geom.is_gone();
}

dGeomID TouchSensor::geom() const
{
    return is_gone() ? nullptr : parts_->geom.id();
}

void TouchSensor::abandon_locked_space()
{
    parts_->geom.abandon_locked_space();
}

void TouchSensor::set_margin(double margin)
{
    if (parts_->tracker)
    {
        parts_->tracker->set_margin(margin);
        parts_->geom.set_margin(margin);
    }
}

void TouchSensor::set_view(TouchView view)
{
    parts_->wanted.view = view;
}

void TouchSensor::set_stiffness(double stiffness)
{
    parts_->wanted.stiffness = stiffness;
    if (parts_->tracker)
        parts_->tracker->set_stiffness(stiffness);
}

void TouchSensor::set_materials(MaterialOf materials)
{
    parts_->wanted.materials = std::move(materials);
}

void TouchSensor::set_tick_length(double seconds)
{
    parts_->place.tick = seconds;
    if (parts_->tracker)
        parts_->tracker->set_tick_length(seconds);
}

void TouchSensor::prepare(dGeomID mesh)
{
    if (parts_->tracker && parts_->meshes.knows(mesh))
        parts_->meshes.prepare(mesh);
}

void TouchSensor::prepare_all()
{
    const dSpaceID scene = outermost_space_of(geom());
    if (parts_->tracker && scene != nullptr)
        for_each_geom(scene, [this](dGeomID geom) { prepare(geom); });
}

bool TouchSensor::is_reading() const
{
    return parts_->meshes.is_reading();
}

void TouchSensor::forget_mesh(dTriMeshDataID data)
{
    parts_->meshes.forget(data);
}

void TouchSensor::set_samples(dHeightfieldDataID data, const HeightfieldSamples &samples)
{
    if (parts_->tracker)
        parts_->meshes.set_samples(data, samples);
}

void TouchSensor::forget_samples(dHeightfieldDataID data)
{
    parts_->meshes.forget_samples(data);
}

void TouchSensor::forget_sides()
{
    parts_->place.begins = true;
    if (parts_->tracker)
        parts_->tracker->forget();
}

void TouchSensor::clear()
{
    if (parts_->tracker)
    {
        parts_->resolve(); // also for a tick whose touches were not queried
        parts_->tracker->begin();
    }
    parts_->touches.clear();
    parts_->collided.clear();
    parts_->bodies.age();
    parts_->excluded.begin();
    parts_->poses.begin();
    parts_->meshes.begin(steps_of_tick);
    parts_->nonsense = false;
}

void TouchSensor::pose(const ToolState &tool)
{
    ProbeGeom &geom = parts_->geom;
    if (!geom.may_be_touched())
        return parts_->others.leave();
    if (!parts_->tracker)
    {
        parts_->place.centre = tool.position;
        geom.follow(tool);
        return;
    }
    parts_->announce(tool);
    parts_->tracker->aim(tool.position);
    parts_->place.centre = parts_->tracker->start();
    const ContactTracker::Region region = parts_->tracker->region();
    const double reach = PoseWatch::fastest * parts_->place.tick; // m; the distance that a geom may travel in a tick
    geom.look_around(tool.position, region.centre, region.radius + std::max(0.0, reach - parts_->tracker->margin()));
    parts_->resolved = false;
}

bool TouchSensor::touch(dGeomID first, dGeomID second)
{
    const dGeomID geom = parts_->geom.id();
    if (first != geom && second != geom)
        return false;
    const dGeomID other = first == geom ? second : first;
    if (dGeomIsSpace(other) != 0)
        return false;
    parts_->resolved = false;
    if (const ProbeTool *probe = parts_->others.find(other))
    {
        if (!parts_->tracker)
            parts_->collide(probe->sphere);
        return true; // OtherProbes has it
    }
    if (parts_->tracker)
        parts_->hold(other);
    else
        parts_->collide(other);
    return true;
}

const std::vector<Touch> &TouchSensor::touches()
{
    parts_->resolve();
    parts_->place.begins = false;
    return parts_->touches;
}

bool TouchSensor::saw_nonsense()
{
    parts_->resolve();
    return parts_->nonsense;
}

bool TouchSensor::exceeds_capacity()
{
    parts_->resolve();
    return parts_->exceeds_capacity;
}

void TouchSensor::push(const std::vector<ForceShare> &shares)
{
    for (const ForceShare &share : shares)
        if (!share.force.isZero(0))
            parts_->bodies.push(share.object, -share.force, share.arm);
}

void TouchSensor::hand_over(std::vector<NearbyGeom> &geoms) const
{
    geoms = parts_->collided;
    if (parts_->tracker)
        for (const HeldGeom &held : parts_->tracker->near())
            geoms.push_back(held.geom);
    for (NearbyGeom &nearby : geoms)
        nearby.note_contacts();
}

dBodyID TouchSensor::body_of(std::uintptr_t object) const
{
    return parts_->bodies.find(object);
}

ContactTracker *TouchSensor::tracker()
{
    return parts_->tracker ? &*parts_->tracker : nullptr;
}

double TouchSensor::radius() const
{
    return parts_->geom.radius();
}

std::uintptr_t object_of(dGeomID geom)
{
    const dBodyID body = dGeomGetBody(geom);
    return body != nullptr ? reinterpret_cast<std::uintptr_t>(body) : reinterpret_cast<std::uintptr_t>(geom);
}

ToolState tool_state_of(dBodyID body)
{
    ToolState state;
    state.position = from_ode(dBodyGetPosition(body));
    const dReal *quaternion = dBodyGetQuaternion(body);
    state.orientation = Quaternion(quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
    state.linear_velocity = from_ode(dBodyGetLinearVel(body));
    state.angular_velocity = from_ode(dBodyGetAngularVel(body));
    return state;
}
} // namespace ode_predictive_space::haptics
