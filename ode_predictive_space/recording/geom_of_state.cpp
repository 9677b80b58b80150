#include "ode_predictive_space/recording/geom_of_state.h"

#include <algorithm>

#include "ode_predictive_space/ode/internals.h"
#include "ode_predictive_space/recording/format.h"

namespace ode_predictive_space::recording
{
namespace
{
void box_of_stand_in(dGeomID geom, dReal *aabb)
{
    const dReal *box = *static_cast<const dReal *const *>(dGeomGetClassData(geom));
    if (box)
        std::copy_n(box, 6, aabb);
    else
        std::fill_n(aabb, 6, dReal{0});
}

int collide_nothing(dGeomID /*first*/, dGeomID /*second*/, int /*flags*/, dContactGeom * /*contacts*/, int /*skip*/)
{
    return 0;
}

dColliderFn *collider_of_stand_in(int /*other_class*/)
{
    return collide_nothing;
}

int class_of_stand_ins()
{
    static const int number = [] {
        dGeomClass stand_in_class{};
        stand_in_class.bytes = sizeof(const dReal *);
        stand_in_class.collider = collider_of_stand_in;
        stand_in_class.aabb = box_of_stand_in;
        return dCreateGeomClass(&stand_in_class);
    }();
    return number;
}
} // namespace

void copy_rotation(const Pose &pose, dReal *rotation)
{
    for (std::size_t row = 0; row < 3; ++row)
        std::copy_n(pose.begin() + 3 + 3 * static_cast<std::ptrdiff_t>(row), 3, rotation + 4 * row);
}

void set_size(dGeomID geom, const GeomState &state)
{
    const auto &size = state.size;
    switch (state.geom_class)
    {
    case dSphereClass:
        return dGeomSphereSetRadius(geom, size[0]);
    case dBoxClass:
        return dGeomBoxSetLengths(geom, size[0], size[1], size[2]);
    case dCapsuleClass:
        return dGeomCapsuleSetParams(geom, size[0], size[1]);
    case dCylinderClass:
        return dGeomCylinderSetParams(geom, size[0], size[1]);
    case dRayClass:
        return dGeomRaySetLength(geom, size[0]);
    case dPlaneClass:
        dGeomPlaneSetParams(geom, size[0], size[1], size[2], size[3]);
        std::copy_n(size.begin(), 4, static_cast<dxPlane *>(geom)->p); // it has scaled them
        return;
    default:
        return;
    }
}

void set_levels(dSpaceID space, const GeomState &state)
{
    dSpaceSetSublevel(space, state.space.sublevel);
    if (state.geom_class == dHashSpaceClass && dSpaceGetClass(space) == dHashSpaceClass && !dSpaceIsPredictive(space))
        dHashSpaceSetLevels(space, state.space.min_level, state.space.max_level);
}

void set_flags(dGeomID geom, const GeomState &state)
{
    if (state.flags & geom_enabled)
        dGeomEnable(geom);
    else
        dGeomDisable(geom);
    if (state.geom_class != dRayClass)
        return;
    dGeomRaySetFirstContact(geom, (state.flags & ray_first_contact) != 0);
    dGeomRaySetBackfaceCull(geom, (state.flags & ray_backface_cull) != 0);
    dGeomRaySetClosestHit(geom, (state.flags & ray_closest_hit) != 0);
}

dGeomID make_simple_shape(const GeomState &state)
{
    const auto &size = state.size;
    switch (state.geom_class)
    {
    case dSphereClass:
        return dCreateSphere(nullptr, size[0]);
    case dBoxClass:
        return dCreateBox(nullptr, size[0], size[1], size[2]);
    case dCapsuleClass:
        return dCreateCapsule(nullptr, size[0], size[1]);
    case dCylinderClass:
        return dCreateCylinder(nullptr, size[0], size[1]);
    case dRayClass:
        return dCreateRay(nullptr, size[0]);
    case dPlaneClass:
        return dCreatePlane(nullptr, size[0], size[1], size[2], size[3]);
    default:
        return dCreateGeom(class_of_stand_ins());
    }
}
} // namespace ode_predictive_space::recording
