#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_BUILT_IN_ODE_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_BUILT_IN_ODE_H

namespace ode_predictive_space::preload
{
/// Does this program file define ODE's functions itself? Then it was linked with a static ODE, whose calls never leave it.
/// Seen in its symbol tables; a program from which all symbols were stripped does not tell.
bool has_ode_built_in(const char *program_file);
} // namespace ode_predictive_space::preload

#endif
