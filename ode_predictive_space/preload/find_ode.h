// Finds the ODE that a call was meant for. Belongs to the half that is loaded into every process: it uses the C library alone.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_FIND_ODE_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_FIND_ODE_H

#include <link.h>

#include "ode_predictive_space/preload/substitute.h"

namespace ode_predictive_space::preload
{
/// A loaded object, kept loaded.
struct Object
{
    void *handle = nullptr;
    link_map *map = nullptr;
};

/// The object that an address lies in; 0 when it lies in none.
link_map *object_at(const void *address);

/// Finds the object whose definition of a function the dynamic linker would have taken for a caller if ours were not there:
/// first the program and the libraries that all can see, in their order; then the caller's own libraries, which are not in
/// there when it was loaded with RTLD_LOCAL (as Python does).
/// @return an object with map 0 when the caller sees none: then the call came by a jump, as a compiler makes of the last call
/// of a function, and the caller seems to be the function that called that one.
Object find_definition(const char *function, const link_map *caller);

/// The only object that defines a function, besides us. @return an object with map 0 when none defines it, or several do.
Object find_only_definition(const char *function);

OdeCalls calls_of(const Object &ode);

Object object_of(const link_map *map);

Object find_loaded(const char *soname);
} // namespace ode_predictive_space::preload

#endif
