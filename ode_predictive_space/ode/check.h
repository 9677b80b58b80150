#ifndef ODE_PREDICTIVE_SPACE_ODE_CHECK_H
#define ODE_PREDICTIVE_SPACE_ODE_CHECK_H

namespace ode_predictive_space
{
/// Compares the ODE library in this process, once, with this plugin's headers: precision, number of copies, layout. Inside ODE
/// nothing can differ. @return null if they agree, otherwise a constant string that describes the difference.
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
