// All devices that may have a force on them: for the ends of a program that no destructor sees.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_OPEN_GATES_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_OPEN_GATES_H

#include "ode_predictive_space/haptics/safety/device_gate.h"

namespace ode_predictive_space::haptics
{
/// A gate is in here as long as its renderer lives. From the first one on, exit(), quick_exit(), std::terminate(), which an exception
/// that is not caught calls, and abort() take the force from all of them; what the program installed for these before is called
/// afterwards.
///
/// The gates are read without a lock, so that the program may end anywhere: while a gate is added, or within a driver that a
/// gate is just about to call.
namespace open_gates
{
/// @throws std::logic_error when there is a gate to the same device.
void add(DeviceGate &gate);

/// Returns when no other thread uses the gate any more.
void remove(DeviceGate &gate) noexcept;

/// No force on those that are read in this thread, which hangs, and have no guard of their own: probes that a program runs in a loop's
/// callbacks. @param now s; on the guard's clock. @return whether there was one.
bool close_unguarded(std::thread::id reader, double now) noexcept;

/// No force on any device, ever again. From any thread, and from handlers. The program ends within a second even where a driver hangs.
void end_all_forces() noexcept;
} // namespace open_gates
} // namespace ode_predictive_space::haptics

#endif
