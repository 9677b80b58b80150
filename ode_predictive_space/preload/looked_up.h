// Functions of ODE that a program looks up by dlsym(). Part of the half that is loaded into every process: nothing but the C
// library here.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_LOOKED_UP_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_LOOKED_UP_H

namespace ode_predictive_space::preload
{
/// dlsym() of the C library, or of the next library that has one in its place. In a library that catches dlsym(), as this one
/// does, the name alone is the catcher's.
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

/// What a program gets that looks up one of these functions. Defined where calls are caught.
///
/// @param found the function that it would get without us; not 0.
void *answer_to_lookup(CaughtFunction function, void *found);

/// Whether the calling thread is to get functions of ODE as they are. Defined where calls are caught.
bool sees_ode_itself();
} // namespace ode_predictive_space::preload

#endif
