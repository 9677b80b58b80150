// Reads the file of a program. Belongs to the half that is loaded into every process: it uses the C library alone.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_PROGRAM_FILE_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_PROGRAM_FILE_H

namespace ode_predictive_space::preload
{
/// Does this program define ODE's functions itself? Then it was linked with a static ODE, whose calls cannot be caught. The answer is
/// in its symbol tables: a program without symbols seems to define none.
bool has_ode_built_in(const char *program_file);
} // namespace ode_predictive_space::preload

#endif
