// All subcommands of predictive_bench.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_COMMANDS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_COMMANDS_H

#include "tests/benchmarks/command.h"

namespace ode_predictive_space::benchmarks
{
/// In the order in which they are listed, and in which `all` makes them.
Commands make_commands();

std::unique_ptr<Command> make_scene_command();
/// @param whole count whole ticks, as with --whole.
std::unique_ptr<Command> make_instructions_command(bool whole = false);
std::unique_ptr<Command> make_stepped_command();
std::unique_ptr<Command> make_worlds_command();
std::unique_ptr<Command> make_contact_command();
std::unique_ptr<Command> make_limits_command();
std::unique_ptr<Command> make_table1_command();
std::unique_ptr<Command> make_ratios_command();
std::unique_ptr<Command> make_sudden_command();
std::unique_ptr<Command> make_tail_command();
std::unique_ptr<Command> make_floor_command();
std::unique_ptr<Command> make_whole_command();
std::unique_ptr<Command> make_scale_command();

/// `all`: these, one after the other.
std::unique_ptr<Command> make_all_command(Commands parts);
std::unique_ptr<Command> make_query_command();
/// @param only_shapes only what the measure of shapes takes.
std::unique_ptr<Command> make_memory_command(bool only_shapes = false);
std::unique_ptr<Command> make_haptic_command();
std::unique_ptr<Command> make_servo_command();
} // namespace ode_predictive_space::benchmarks

#endif
