// All devices that may have a force on them: for the ends of a program that no destructor sees.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_OPEN_GATES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_OPEN_GATES_H

#include "ode_predictive_space/haptics/device_gate.h"

namespace ode_predictive_space::haptics
{
/// A gate is in here as long as its renderer lives. The first one installs what takes the force away at exit(), quick_exit() and
/// std::terminate(), which an exception that is not caught calls. The program's terminate handler from before is called afterwards.
namespace open_gates
{
/// @throws std::logic_error when there is a gate to the same device.
void add(DeviceGate &gate);
void remove(DeviceGate &gate) noexcept;

/// No force on those that are read in this thread, which hangs, and have no guard of their own: probes that a program runs in a loop's
/// callbacks. @param now s; on the guard's clock. @return whether there was one.
bool close_unguarded(std::thread::id reader, double now) noexcept;

/// No force, ever again. From any thread.
void shut_all() noexcept;
} // namespace open_gates
} // namespace ode_predictive_space::haptics

#endif
