// The interface between the two halves of the preload.
//
// libode_predictive_space_preload.so is loaded into every process, needs the C library alone, and catches calls. When it catches the
// first call, it loads libode_predictive_space_substitute.so, which needs ODE and the C++ library.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_SUBSTITUTE_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_SUBSTITUTE_H

#include <ode/collision_space.h>
#include <ode/common.h>

namespace ode_predictive_space::preload
{
/// The functions of the ODE that the program would call without us.
struct OdeCalls
{
    dSpaceID (*simple_create)(dSpaceID);
    dSpaceID (*hash_create)(dSpaceID);
    dSpaceID (*quadtree_create)(dSpaceID, const dReal *center, const dReal *extents, int depth);
    dSpaceID (*sap_create)(dSpaceID, int axis_order);
    void (*collide)(dSpaceID, void *, dNearCallback *);
    void (*collide2)(dGeomID, dGeomID, void *, dNearCallback *);
};

/// The functions of the substitute. The last three are 0 unless the program is watched.
struct Hooks
{
    /// Makes a space in place of one of this class. Returns 0 when the program is to have its own.
    dSpaceID (*create)(int space_class, dSpaceID parent);

    /// Is called when the program got one of ODE's spaces.
    void (*made)(dSpaceID);

    void (*collide)(dSpaceID, void *, dNearCallback *);
    void (*collide2)(dGeomID, dGeomID, void *, dNearCallback *);
};

/// The only exported function of the substitute, to be called once. It does not call the dynamic linker: all lookups are made
/// when the substitute is loaded. @param calls stays valid.
/// @return 0, after a line on standard error, when this ODE cannot be served. Otherwise the hooks, valid to the end.
using Attach = const Hooks *(*)(const OdeCalls *calls);
constexpr const char *attach_name = "ode_predictive_space_attach";
} // namespace ode_predictive_space::preload

#endif
