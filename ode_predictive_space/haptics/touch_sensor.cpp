#include "ode_predictive_space/haptics/touch_sensor.h"

#include <algorithm>
#include <cmath>
#include <ode/collision_space.h>
#include <ode_predictive_space/predictive_space.h>
#include <stdexcept>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr std::size_t usual_touches = 32;

Vector3 from_ode(const dReal *v)
{
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

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

bool is_finite(const Touch &touch)
{
    return touch.point.allFinite() && touch.normal.allFinite() && std::isfinite(touch.depth) &&
           touch.surface_velocity.allFinite();
}

// NaN is deeper than anything, so that it is never overlooked.
bool is_shallower(const dContactGeom &a, const dContactGeom &b)
{
    return !std::isnan(a.depth) && (std::isnan(b.depth) || a.depth < b.depth);
}
} // namespace

TouchSensor::TouchSensor(dSpaceID space, double radius)
    : geom_(make_sphere(space, radius)), own_(true), turns_(false), radius_(radius), contacts_(most_contacts)
{
    become_interactive();
}

TouchSensor::TouchSensor(dGeomID geom)
    : geom_(checked(geom)), own_(false), turns_(dGeomGetClass(geom) != dSphereClass), contacts_(most_contacts)
{
    become_interactive();
}

TouchSensor::~TouchSensor()
{
    if (own_)
    {
        dGeomDestroy(geom_);
    }
}

void TouchSensor::become_interactive()
{
    touches_.reserve(usual_touches);
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
        dGeomSphereSetRadius(geom_, static_cast<dReal>(radius_ + margin_));
    }
}

void TouchSensor::clear()
{
    touches_.clear();
    bodies_.age();
    nonsense_ = false;
}

void TouchSensor::pose(const ToolState &tool)
{
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
    const int count = dCollide(geom_, other, most_contacts, contacts_.data(), sizeof(dContactGeom));
    if (count > 0)
    {
        add(*std::max_element(contacts_.begin(), contacts_.begin() + count, is_shallower), other);
    }
    return true;
}

// ODE's normal is the way out for the first of the two geoms, which is the probe.
void TouchSensor::add(const dContactGeom &contact, dGeomID other)
{
    const dBodyID body = dGeomGetBody(other);
    Touch touch;
    touch.point = from_ode(contact.pos);
    touch.normal = from_ode(contact.normal);
    touch.depth = static_cast<double>(contact.depth) - margin_;
    touch.object = object_of(other);
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
    const auto known = std::find_if(touches_.begin(), touches_.end(),
                                    [&](const Touch &earlier) { return earlier.object == touch.object; });
    if (known == touches_.end())
    {
        touches_.push_back(touch);
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
