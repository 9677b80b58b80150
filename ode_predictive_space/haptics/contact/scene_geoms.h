// All geoms of the scene that a geom is in.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_GEOMS_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SCENE_GEOMS_H

#include <ode/collision.h>
#include <ode/collision_space.h>

namespace ode_predictive_space::haptics
{
/// Visits the spaces around a geom, which may be 0, from the innermost to the outermost.
template <typename Visit> void for_each_space_of(dGeomID geom, const Visit &visit)
{
    for (dSpaceID space = geom != nullptr ? dGeomGetSpace(geom) : nullptr; space != nullptr;
         space = dGeomGetSpace(reinterpret_cast<dGeomID>(space)))
        visit(space);
}

inline dSpaceID outermost_space_of(dGeomID geom)
{
    dSpaceID outermost = nullptr;
    for_each_space_of(geom, [&](dSpaceID space) { outermost = space; });
    return outermost;
}

/// Also of the spaces within. ODE's quadtree cannot list its geoms and aborts: those in one are left out.
template <typename Visit> void for_each_geom(dSpaceID space, const Visit &visit)
{
    if (dGeomGetClass(reinterpret_cast<dGeomID>(space)) == dQuadTreeSpaceClass)
        return;
    const int count = dSpaceGetNumGeoms(space);
    for (int i = 0; i < count; ++i)
    {
        const dGeomID geom = dSpaceGetGeom(space, i);
        if (dGeomIsSpace(geom) != 0)
            for_each_geom(reinterpret_cast<dSpaceID>(geom), visit);
        else
            visit(geom);
    }
}
} // namespace ode_predictive_space::haptics

#endif
