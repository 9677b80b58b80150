#include "tests/faults/gas.h"

namespace ode_predictive_space
{
dGeomID UserClass::create(dSpaceID space)
{
    static dGeomClass description = {0, [](int) -> dColliderFn * { return nullptr; }, bounds, overlaps, nullptr};
    static const int number = dCreateGeomClass(&description);
    dGeomID geom = dCreateGeom(number);
    dSpaceAdd(space, geom);
    return geom;
}

void UserClass::count_call()
{
    if (spared_ >= 0 && spared_-- == 0)
        throw Thrown();
}

void UserClass::bounds(dGeomID geom, dReal aabb[6])
{
    count_call();
    const dReal *position = dGeomGetPosition(geom);
    for (int axis = 0; axis < 3; ++axis)
    {
        aabb[2 * axis] = position[axis] - 0.3;
        aabb[2 * axis + 1] = position[axis] + 0.3;
    }
}

int UserClass::overlaps(dGeomID, dGeomID, dReal[6])
{
    count_call();
    return 1;
}
} // namespace ode_predictive_space
