// Reads the file of a program. Belongs to the half that is loaded into every process: it uses the C library alone.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_PROGRAM_FILE_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_PROGRAM_FILE_H

namespace ode_predictive_space::preload
{
/// Programs linked with a static ODE, whose calls cannot be caught, define its functions. One without symbols seems not to.
bool has_ode_built_in(const char *program_file);
} // namespace ode_predictive_space::preload

#endif
