// The words that writing and reading a recording have in common.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_RECORDING_FORMAT_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_RECORDING_FORMAT_H

namespace ode_predictive_space::haptics
{
/// Then: input axes, force axes, largest force, stiffness and damping, rate, least and largest corner of the workspace, and,
/// up to the end of the line, the name.
constexpr const char *device_line_mark = "# ode_predictive_space device:";

/// Then, up to the end of the line: the name of the force law.
constexpr const char *law_line_mark = "# ode_predictive_space law:";

/// Then the device's delay in s. Only where there is one.
constexpr const char *delay_line_mark = "# ode_predictive_space delay:";

/// How far from 1 the length of a quaternion may be that is recorded and read as it is.
constexpr double exact_length_tolerance = 1e-6;
} // namespace ode_predictive_space::haptics

#endif
