// Ends of a program that no destructor sees.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_PROGRAM_END_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_PROGRAM_END_H

namespace ode_predictive_space::haptics
{
/// From the first call on, exit(), quick_exit(), std::terminate(), which an exception that is not caught calls, and abort() take
/// the force from all devices of open_gates. What the program installed for them before is called afterwards. Any thread.
void guard_program_end() noexcept;

/// What these do: no force on any device, ever again. The program ends within a second even where a driver hangs.
void end_all_forces() noexcept;
} // namespace ode_predictive_space::haptics

#endif
