#include "ode_predictive_space/haptics/touch_sensor.h"

#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "ode_predictive_space/haptics/contact/excluded_geoms.h"
#include "ode_predictive_space/haptics/contact/geom_watch.h"
#include "ode_predictive_space/haptics/contact/ode_vector.h"
#include "ode_predictive_space/haptics/contact/scene_geoms.h"
#include "ode_predictive_space/haptics/contact/usual_touches.h"

#include <algorithm>
#include <cmath>
#include <ode/collision_space.h>
#include <ode_predictive_space/predictive_space.h>
#include <stdexcept>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
dGeomID make_sphere(dSpaceID space, double radius)
{
    if (space == nullptr || !(radius > 0) || !std::isfinite(radius))
    {
        throw std::invalid_argument("The probe needs a space to be in, and a radius above 0");
    }
    return dCreateSphere(space, static_cast<dReal>(radius));
}

dGeomID checked(dGeomID geom)
{
    if (geom == nullptr || dGeomIsSpace(geom) != 0 || dGeomGetClass(geom) == dPlaneClass ||
        dGeomGetBody(geom) != nullptr)
    {
        throw std::invalid_argument(
            "The probe's geom must be one that can be placed: no plane, no space, without a body");
    }
    return geom;
}

Vector3 velocity_at(dBodyID body, const Vector3 &point)
{
    dVector3 velocity;
    dBodyGetPointVel(body, static_cast<dReal>(point.x()), static_cast<dReal>(point.y()), static_cast<dReal>(point.z()),
                     velocity);
    return from_ode(velocity);
}

// NaN is deeper than anything, so that it is never overlooked.
bool is_shallower(const dContactGeom &a, const dContactGeom &b)
{
    return !std::isnan(a.depth) && (std::isnan(b.depth) || a.depth < b.depth);
}
} // namespace

TouchSensor::TouchSensor(dSpaceID space, double radius)
    : geom_(make_sphere(space, radius)), tool_(dCreateSphere(nullptr, static_cast<dReal>(radius))), own_(true),
      turns_(false), radius_(radius), tracker_(std::make_unique<ContactTracker>(radius)),
      excluded_(std::make_unique<ExcludedGeoms>()), watch_(std::make_unique<GeomWatch>(geom_)),
      meshes_(std::make_unique<MeshStore>()), contacts_(most_contacts)
{
    become_interactive();
}

TouchSensor::TouchSensor(dGeomID geom)
    : geom_(checked(geom)), own_(false), turns_(dGeomGetClass(geom) != dSphereClass),
      excluded_(std::make_unique<ExcludedGeoms>()), contacts_(most_contacts)
{
    become_interactive();
    if (const dSpaceID space = dGeomGetSpace(geom))
    {
        sentinel_ = dCreateSphere(space, 0);
        dGeomDisable(sentinel_);
        watch_ = std::make_unique<GeomWatch>(sentinel_);
    }
}

TouchSensor::~TouchSensor()
{
    if (const dGeomID watched = own_ ? geom_ : sentinel_; watched != nullptr && may_touch_geom())
    {
        dGeomDestroy(watched);
    }
    if (watch_ && abandoned_ && !is_gone())
    {
        watch_->leave();
    }
    if (own_)
    {
        dGeomDestroy(tool_);
    }
}

bool TouchSensor::is_gone() const
{
    return watch_ && !watch_->is_there();
}

void TouchSensor::abandon_locked_space()
{
    for (dSpaceID space = dGeomGetSpace(geom_); space != nullptr;
         space = dGeomGetSpace(reinterpret_cast<dGeomID>(space)))
    {
        abandoned_ = abandoned_ || dSpaceIsPredictive(space) == 0;
    }
    if (abandoned_)
    {
        dGeomDisable(geom_);
    }
}

void TouchSensor::become_interactive()
{
    touches_.reserve(usual_touches);
    collided_.reserve(usual_touches);
    const dSpaceID space = dGeomGetSpace(geom_);
    if (space != nullptr && dSpaceIsPredictive(space) != 0)
    {
        dPredictiveSpaceSetGeomRole(space, geom_, dPredictiveRoleInteractive);
    }
}

void TouchSensor::set_margin(double margin)
{
    if (own_)
    {
        margin_ = margin;
        tracker_->set_margin(margin);
        dGeomSphereSetRadius(tool_, static_cast<dReal>(radius_ + margin_));
        if (may_touch_geom())
        {
            dGeomSphereSetRadius(geom_, static_cast<dReal>(radius_ + margin_));
        }
    }
}

void TouchSensor::set_stiffness(double stiffness)
{
    if (own_)
    {
        tracker_->set_stiffness(stiffness);
    }
}

void TouchSensor::prepare(dGeomID mesh)
{
    if (own_ && dGeomGetClass(mesh) == dTriMeshClass && dGeomTriMeshGetData(mesh) != nullptr)
    {
        meshes_->tree_of(mesh, {});
    }
}

void TouchSensor::prepare_all()
{
    const dSpaceID scene = outermost_space_of(geom());
    if (own_ && scene != nullptr)
    {
        prepare_space(scene);
    }
}

void TouchSensor::prepare_space(dSpaceID space)
{
    for_each_geom(space, [this](dGeomID geom) { prepare(geom); });
}

void TouchSensor::forget_mesh(dTriMeshDataID data)
{
    if (own_)
    {
        meshes_->forget(data);
    }
}

void TouchSensor::set_samples(dHeightfieldDataID data, const HeightfieldSamples &samples)
{
    if (own_)
    {
        meshes_->set_samples(data, samples);
    }
}

void TouchSensor::forget_samples(dHeightfieldDataID data)
{
    if (own_)
    {
        meshes_->forget_samples(data);
    }
}

void TouchSensor::forget_sides()
{
    begins_ = true;
    if (own_)
    {
        tracker_->forget();
    }
}

void TouchSensor::clear()
{
    touches_.clear();
    collided_.clear();
    bodies_.age();
    excluded_->begin();
    nonsense_ = false;
    if (own_)
    {
        resolve(); // a tick whose touches were not asked for counts all the same
        tracker_->begin();
        touches_.clear();
    }
}

void TouchSensor::pose(const ToolState &tool)
{
    if (!may_touch_geom())
    {
        return;
    }
    if (own_)
    {
        position_ = tool.position;
        tracker_->aim(position_);
        look_around();
        posed_ = true;
        resolved_ = false;
        return;
    }
    if (!posed_ || tool.position != position_)
    {
        position_ = tool.position;
        dGeomSetPosition(geom_, static_cast<dReal>(position_.x()), static_cast<dReal>(position_.y()),
                         static_cast<dReal>(position_.z()));
    }
    if (turns_ && (!posed_ || tool.orientation.coeffs() != orientation_.coeffs()))
    {
        orientation_ = tool.orientation;
        const dQuaternion quaternion = {static_cast<dReal>(orientation_.w()), static_cast<dReal>(orientation_.x()),
                                        static_cast<dReal>(orientation_.y()), static_cast<dReal>(orientation_.z())};
        dGeomSetQuaternion(geom_, quaternion);
    }
    posed_ = true;
}

void TouchSensor::look_around()
{
    dGeomSetPosition(tool_, static_cast<dReal>(position_.x()), static_cast<dReal>(position_.y()),
                     static_cast<dReal>(position_.z()));
    const ContactTracker::Region region = tracker_->region();
    const auto radius = static_cast<dReal>(region.radius);
    if (dGeomSphereGetRadius(geom_) != radius)
    {
        dGeomSphereSetRadius(geom_, radius);
    }
    const dVector3 centre = {static_cast<dReal>(region.centre.x()), static_cast<dReal>(region.centre.y()),
                             static_cast<dReal>(region.centre.z())};
    if (!posed_ || !std::equal(centre, centre + 3, dGeomGetPosition(geom_)))
    {
        dGeomSetPosition(geom_, centre[0], centre[1], centre[2]);
    }
}

bool TouchSensor::touch(dGeomID first, dGeomID second)
{
    if (first != geom_ && second != geom_)
    {
        return false;
    }
    const dGeomID other = first == geom_ ? second : first;
    if (dGeomIsSpace(other) != 0)
    {
        return false;
    }
    resolved_ = false;
    if (!own_ || !hold(other))
    {
        collide(other);
    }
    return true;
}

/// @return false when only dCollide() knows its surface.
bool TouchSensor::hold(dGeomID other)
{
    std::optional<NearbyGeom> nearby = NearbyGeom::read(other, *meshes_, tracker_->touched_triangles(other));
    if (!nearby)
    {
        return false;
    }
    if (!nearby->is_finite())
    {
        nonsense_ = true;
        return true;
    }
    if (excluded_->excludes(*nearby, probe()))
    {
        return true;
    }
    if (const dBodyID body = dGeomGetBody(other))
    {
        bodies_.keep(body);
    }
    nearby->set_material(material_of(other));
    tracker_->add_if_near(std::move(*nearby));
    return true;
}

ProbePlace TouchSensor::probe() const
{
    ProbePlace probe;
    probe.centre = tracker_ ? tracker_->start() : position_;
    probe.radius = radius_;
    probe.begins = begins_;
    probe.tick = tick_length_;
    return probe;
}

void TouchSensor::collide(dGeomID other)
{
    const int count = dCollide(own_ ? tool_ : geom_, other, most_contacts, contacts_.data(), sizeof(dContactGeom));
    if (count > 0)
    {
        add(*std::max_element(contacts_.begin(), contacts_.begin() + count, is_shallower), other);
    }
}

std::optional<Material> TouchSensor::material_of(dGeomID geom)
{
    std::optional<Material> material = materials_ ? materials_(geom) : std::nullopt;
    if (material && !is_valid(*material))
    {
        nonsense_ = true;
        material.reset();
    }
    return material;
}

void TouchSensor::resolve()
{
    if (resolved_)
    {
        return;
    }
    resolved_ = true;
    touches_ = collided_;
    if (!own_)
    {
        return;
    }
    tracker_->follow();
    const bool all = tracker_->touches(view_, touches_);
    nonsense_ = nonsense_ || !all;
}

const std::vector<Touch> &TouchSensor::touches()
{
    resolve();
    begins_ = false;
    return touches_;
}

bool TouchSensor::saw_nonsense()
{
    resolve();
    return nonsense_;
}

// ODE's normal is the way out for the first of the two geoms, which is the probe.
void TouchSensor::add(const dContactGeom &contact, dGeomID other)
{
    const dBodyID body = dGeomGetBody(other);
    Touch touch;
    touch.point = from_ode(contact.pos);
    touch.normal = from_ode(contact.normal);
    touch.depth = static_cast<double>(contact.depth) - margin_;
    if (excluded_->excludes(other, touch.depth, probe()))
    {
        return;
    }
    touch.object = object_of(other);
    touch.material = material_of(other);
    if (body != nullptr)
    {
        bodies_.keep(body);
        touch.surface_velocity = velocity_at(body, touch.point);
    }
    if (!is_finite(touch))
    {
        nonsense_ = true;
        return;
    }
    const auto known = std::find_if(collided_.begin(), collided_.end(),
                                    [&](const Touch &earlier) { return earlier.object == touch.object; });
    if (known == collided_.end())
    {
        collided_.push_back(touch);
    }
    else if (touch.depth > known->depth)
    {
        *known = touch;
    }
}

void TouchSensor::push(const std::vector<ForceShare> &shares)
{
    for (const ForceShare &share : shares)
    {
        if (!share.force.isZero(0))
        {
            bodies_.push(share.object, -share.force, share.point);
        }
    }
}

std::uintptr_t object_of(dGeomID geom)
{
    const dBodyID body = dGeomGetBody(geom);
    return body != nullptr ? reinterpret_cast<std::uintptr_t>(body) : reinterpret_cast<std::uintptr_t>(geom);
}

void add_wrench(dBodyID body, const Wrench &wrench)
{
    if (wrench.force.isZero(0) && wrench.torque.isZero(0))
    {
        return;
    }
    dBodyEnable(body);
    dBodyAddForce(body, static_cast<dReal>(wrench.force.x()), static_cast<dReal>(wrench.force.y()),
                  static_cast<dReal>(wrench.force.z()));
    dBodyAddTorque(body, static_cast<dReal>(wrench.torque.x()), static_cast<dReal>(wrench.torque.y()),
                   static_cast<dReal>(wrench.torque.z()));
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
