// All devices that may render a force, for ends of the program without destructors.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_OPEN_GATES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_OPEN_GATES_H

#include "ode_predictive_space/haptics/safety/device_gate.h"

namespace ode_predictive_space::haptics
{
/// Each renderer registers its gate during its lifetime. From the first one on, exit(), quick_exit(), std::terminate() and
/// abort() set zero force on all; handlers that the program installed before are called afterwards. The gates are read without
/// a lock, so that the program may end anywhere, even while a gate is added.
namespace open_gates
{
void add(DeviceGate &gate);

void remove(DeviceGate &gate) noexcept;

/// Sets zero force on unguarded devices that a hung thread reads: probes that a program runs in a loop's callbacks.
/// @param now s; on the guard's clock. @return whether there was one.
bool close_unguarded(std::thread::id reader, double now) noexcept;

/// Sets zero force on all devices for good. From any thread and from handlers; a driver that hangs delays the end by at
/// most a second.
void end_all_forces() noexcept;
} // namespace open_gates
} // namespace ode_predictive_space::haptics

#endif
