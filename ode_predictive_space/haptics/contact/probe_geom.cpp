#include "ode_predictive_space/haptics/contact/probe_geom.h"

#include "ode_predictive_space/haptics/contact/ode_vector.h"
#include "ode_predictive_space/haptics/contact/scene_geoms.h"

#include <algorithm>
#include <cmath>
#include <ode/ode.h>
#include <ode_predictive_space/predictive_space.h>
#include <stdexcept>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int most_contacts = 256; // of one pair: a mesh gives many, of which one counts

// NaN is deeper than anything, so that it is never overlooked.
bool is_shallower(const dContactGeom &a, const dContactGeom &b)
{
    return !std::isnan(a.depth) && (std::isnan(b.depth) || a.depth < b.depth);
}

dGeomID make_sphere(dSpaceID space, double radius)
{
    if (space == nullptr || !(radius > 0) || !std::isfinite(radius))
        throw std::invalid_argument("The probe needs a space and a radius above 0");
    return dCreateSphere(space, static_cast<dReal>(radius));
}

dGeomID checked(dGeomID geom)
{
    if (geom == nullptr || dGeomIsSpace(geom) != 0 || dGeomGetClass(geom) == dPlaneClass ||
        dGeomGetBody(geom) != nullptr)
    {
        throw std::invalid_argument("The probe's geom must be placeable, must not be a space and must not have a body");
    }
    return geom;
}

void place(dGeomID geom, const Vector3 &position)
{
    const dVector3 there = {static_cast<dReal>(position.x()), static_cast<dReal>(position.y()),
                            static_cast<dReal>(position.z())};
    if (!std::equal(there, there + 3, dGeomGetPosition(geom)))
        dGeomSetPosition(geom, there[0], there[1], there[2]);
}
} // namespace

ProbeGeom::ProbeGeom(dSpaceID space, double radius)
    : geom_(make_sphere(space, radius)), tool_(dCreateSphere(nullptr, static_cast<dReal>(radius))), radius_(radius)
{
    watch(geom_);
    become_interactive();
}

ProbeGeom::ProbeGeom(dGeomID geom) : geom_(checked(geom)), tool_(geom)
{
    become_interactive();
    if (const dSpaceID space = dGeomGetSpace(geom))
    {
        watch(dCreateSphere(space, 0));
        dGeomDisable(watched_);
    }
}

/// In a locked space the body and its world are leaked, because destroying them would move the geom.
ProbeGeom::~ProbeGeom()
{
    if (watched_ != nullptr && may_be_touched())
        dGeomDestroy(watched_);
    if (watch_ != nullptr && (!abandoned_ || is_gone()))
        dWorldDestroy(dBodyGetWorld(watch_));
    if (is_own())
        dGeomDestroy(tool_);
}

void ProbeGeom::watch(dGeomID geom)
{
    watched_ = geom;
    watch_ = dBodyCreate(dWorldCreate());
    dBodySetKinematic(watch_);
    dGeomSetBody(geom, watch_);
}

bool ProbeGeom::is_gone() const
{
    return watch_ != nullptr && dBodyGetFirstGeom(watch_) == nullptr;
}

void ProbeGeom::become_interactive()
{
    const dSpaceID space = dGeomGetSpace(geom_);
    if (space != nullptr && dSpaceIsPredictive(space) != 0)
        dPredictiveSpaceSetGeomRole(space, geom_, dPredictiveRoleInteractive);
}

void ProbeGeom::abandon_locked_space()
{
    for_each_space_of(geom_, [this](dSpaceID space) { abandoned_ = abandoned_ || dSpaceIsPredictive(space) == 0; });
    if (abandoned_)
        dGeomDisable(geom_);
}

void ProbeGeom::set_margin(double margin)
{
    if (may_be_touched())
        dGeomSphereSetRadius(geom_, static_cast<dReal>(radius_ + margin));
}

std::optional<dContactGeom> ProbeGeom::contact_with(dGeomID other)
{
    contacts_.resize(most_contacts);
    const int count = dCollide(tool_, other, most_contacts, contacts_.data(), sizeof(dContactGeom));
    if (count == 0)
        return std::nullopt;
    return *std::max_element(contacts_.begin(), contacts_.begin() + count, is_shallower);
}

std::optional<dContactGeom> ProbeGeom::contact_with(dGeomID other, const Vector3 &centre, double radius)
{
    const Vector3 before = from_ode(dGeomGetPosition(tool_));
    dGeomSphereSetRadius(tool_, static_cast<dReal>(radius));
    place(tool_, centre);
    const std::optional<dContactGeom> contact = contact_with(other);
    dGeomSphereSetRadius(tool_, static_cast<dReal>(radius_));
    place(tool_, before);
    return contact;
}

void ProbeGeom::follow(const ToolState &tool)
{
    place(geom_, tool.position);
    if (dGeomGetClass(geom_) == dSphereClass || (orientation_ && orientation_->coeffs() == tool.orientation.coeffs()))
        return;
    orientation_ = tool.orientation;
    call_ode(&dGeomSetQuaternion, geom_, tool.orientation);
}

void ProbeGeom::look_around(const Vector3 &tool, const Vector3 &centre, double radius)
{
    place(tool_, tool);
    if (dGeomSphereGetRadius(geom_) != static_cast<dReal>(radius))
        dGeomSphereSetRadius(geom_, static_cast<dReal>(radius));
    place(geom_, centre);
}
} // namespace ode_predictive_space::haptics
