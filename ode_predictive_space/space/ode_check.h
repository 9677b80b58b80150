#ifndef ODE_PREDICTIVE_SPACE_SPACE_ODE_CHECK_H
#define ODE_PREDICTIVE_SPACE_SPACE_ODE_CHECK_H

namespace ode_predictive_space
{
/// Compares the ODE library in this process with the headers that this plugin was compiled with: precision, number of
/// copies, and the layout of dxGeom and dxSpace. Evaluated once. (As a part of ODE it has been compiled with that library.)
///
/// @return 0 when they agree, otherwise a sentence saying what differs (a constant, never to be freed).
#ifdef ODE_PREDICTIVE_SPACE_INSIDE_ODE
inline const char *ode_mismatch()
{
    return nullptr;
}
#else
const char *ode_mismatch();
#endif
} // namespace ode_predictive_space

#endif
