// What the two halves of the preload say to each other.
//
// The first, libode_predictive_space_preload.so, is loaded into every process, needs nothing but the C library, and catches
// calls. When the first call is caught, it loads the second, libode_predictive_space_substitute.so, which brings ODE's and the
// C++ library's code with it, but only into a process that has ODE.

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

/// What the substitute wants to be asked. The last three are 0 unless the program is watched.
struct Hooks
{
    /// A space in place of one of this class; 0 when the program is to have its own.
    dSpaceID (*create)(int space_class, dSpaceID parent);

    /// The program got a space of its own.
    void (*made)(dSpaceID);

    void (*collide)(dSpaceID, void *, dNearCallback *);
    void (*collide2)(dGeomID, dGeomID, void *, dNearCallback *);
};

/// The substitute's only symbol. To be called once. It asks nothing of the dynamic linker: that is done when the substitute is
/// loaded.
///
/// @param calls stays valid.
/// @return 0, after a line on standard error, when this ODE cannot be served. Otherwise the hooks, valid to the end.
using Attach = const Hooks *(*)(const OdeCalls *calls);
constexpr const char *attach_name = "ode_predictive_space_attach";
} // namespace ode_predictive_space::preload

#endif
