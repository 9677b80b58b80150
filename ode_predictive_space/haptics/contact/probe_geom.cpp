#include "ode_predictive_space/haptics/contact/probe_geom.h"

#include <algorithm>
#include <cmath>
#include <ode_predictive_space/predictive_space.h>
#include <stdexcept>

namespace ode_predictive_space::haptics
{
namespace
{
dGeomID make_sphere(dSpaceID space, double radius)
{
    if (space == nullptr || !(radius > 0) || !std::isfinite(radius))
        throw std::invalid_argument("The probe needs a space to be in, and a radius above 0");
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

void place(dGeomID geom, const Vector3 &position)
{
    dGeomSetPosition(geom, static_cast<dReal>(position.x()), static_cast<dReal>(position.y()),
                     static_cast<dReal>(position.z()));
}
} // namespace

ProbeGeom::ProbeGeom(dSpaceID space, double radius)
    : geom_(make_sphere(space, radius)), tool_(dCreateSphere(nullptr, static_cast<dReal>(radius))), own_(true),
      turns_(false), radius_(radius), watch_(std::make_unique<GeomWatch>(geom_))
{
    become_interactive();
}

ProbeGeom::ProbeGeom(dGeomID geom) : geom_(checked(geom)), own_(false), turns_(dGeomGetClass(geom) != dSphereClass)
{
    become_interactive();
    if (const dSpaceID space = dGeomGetSpace(geom))
    {
        sentinel_ = dCreateSphere(space, 0);
        dGeomDisable(sentinel_);
        watch_ = std::make_unique<GeomWatch>(sentinel_);
    }
}

ProbeGeom::~ProbeGeom()
{
    if (const dGeomID watched = own_ ? geom_ : sentinel_; watched != nullptr && may_be_touched())
        dGeomDestroy(watched);
    if (watch_ && abandoned_ && !is_gone())
        watch_->leave();
    if (own_)
        dGeomDestroy(tool_);
}

void ProbeGeom::become_interactive()
{
    const dSpaceID space = dGeomGetSpace(geom_);
    if (space != nullptr && dSpaceIsPredictive(space) != 0)
        dPredictiveSpaceSetGeomRole(space, geom_, dPredictiveRoleInteractive);
}

void ProbeGeom::abandon_locked_space()
{
    for (dSpaceID space = dGeomGetSpace(geom_); space != nullptr;
         space = dGeomGetSpace(reinterpret_cast<dGeomID>(space)))
        abandoned_ = abandoned_ || dSpaceIsPredictive(space) == 0;
    if (abandoned_)
        dGeomDisable(geom_);
}

void ProbeGeom::set_margin(double margin)
{
    margin_ = margin;
    dGeomSphereSetRadius(tool_, static_cast<dReal>(radius_ + margin_));
    if (may_be_touched())
        dGeomSphereSetRadius(geom_, static_cast<dReal>(radius_ + margin_));
}

void ProbeGeom::follow(const ToolState &tool)
{
    if (!posed_ || tool.position != position_)
    {
        position_ = tool.position;
        place(geom_, position_);
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

void ProbeGeom::look_around(const Vector3 &tool, const Vector3 &centre, double radius)
{
    position_ = tool;
    place(tool_, tool);
    if (dGeomSphereGetRadius(geom_) != static_cast<dReal>(radius))
        dGeomSphereSetRadius(geom_, static_cast<dReal>(radius));
    const dVector3 there = {static_cast<dReal>(centre.x()), static_cast<dReal>(centre.y()),
                            static_cast<dReal>(centre.z())};
    if (!posed_ || !std::equal(there, there + 3, dGeomGetPosition(geom_)))
        place(geom_, centre);
    posed_ = true;
}
} // namespace ode_predictive_space::haptics
