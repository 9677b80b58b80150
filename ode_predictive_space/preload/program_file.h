// What the file of a program says of it. Nothing but the C library here, as in the half that is loaded into every process.

#ifndef ODE_PREDICTIVE_SPACE_PRELOAD_PROGRAM_FILE_H
#define ODE_PREDICTIVE_SPACE_PRELOAD_PROGRAM_FILE_H

#include <cstddef>

namespace ode_predictive_space::preload
{
/// Does this program file define ODE's functions itself? Then it was linked with a static ODE, whose calls never leave it.
/// Seen in its symbol tables; a program from which all symbols were stripped does not tell.
bool has_ode_built_in(const char *program_file);

/// Finds a library that a program is linked with.
///
/// @param beginning of its name.
/// @param name gets the whole name; empty: the program is linked with none.
void find_needed_library(const char *program_file, const char *beginning, char *name, std::size_t size);
} // namespace ode_predictive_space::preload

#endif
