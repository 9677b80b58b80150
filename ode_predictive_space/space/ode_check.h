#ifndef ODE_PREDICTIVE_SPACE_SPACE_ODE_CHECK_H
#define ODE_PREDICTIVE_SPACE_SPACE_ODE_CHECK_H

namespace ode_predictive_space
{
/// Compares the ODE library in this process with the headers that this plugin was compiled with: precision, number of
/// copies, and the layout of dxGeom and dxSpace. Evaluated once.
///
/// @return 0 when they agree, otherwise a sentence saying what differs (a constant, never to be freed).
const char *ode_mismatch();
} // namespace ode_predictive_space

#endif
