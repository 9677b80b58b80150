// Lookups of ODE's functions by dlsym(). Belongs to the half that is loaded into every process: it uses the C library alone.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_LOOKED_UP_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_LOOKED_UP_H

namespace ode_predictive_space::preload
{
/// dlsym() of the C library, or of the next library that replaces it. Inside this library the plain name is our own function.
void *find_symbol(void *handle, const char *name);

/// Functions of ODE whose calls are caught, also when a program has looked them up by dlsym().
enum CaughtFunction
{
    simple_space_create,
    hash_space_create,
    quadtree_space_create,
    sap_space_create,
    space_collide,
    space_collide2,
    caught_function_count // none of them
};

/// The answer to a program's lookup of one of these functions; `found`, not 0, is the answer without us. In catch_calls.cpp.
void *answer_to_lookup(CaughtFunction function, void *found);

/// Is the calling thread to get ODE's own functions? In catch_calls.cpp.
bool sees_ode_itself();
} // namespace ode_predictive_space::preload

#endif
