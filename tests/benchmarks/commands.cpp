#include "tests/benchmarks/commands.h"

namespace ode_predictive_space::benchmarks
{
namespace
{
void add_parts_of_all(Commands &commands)
{
    commands.push_back(make_table1_command());
    commands.push_back(make_ratios_command());
    commands.push_back(make_sudden_command());
    commands.push_back(make_query_command());
    commands.push_back(make_tail_command());
    commands.push_back(make_floor_command());
    commands.push_back(make_whole_command());
    commands.push_back(make_memory_command());
    commands.push_back(make_scale_command());
    commands.push_back(make_haptic_command());
    commands.push_back(make_servo_command());
}
} // namespace

Commands make_commands()
{
    Commands commands;
    commands.push_back(make_scene_command());
    commands.push_back(make_instructions_command());
    commands.push_back(make_stepped_command());
    commands.push_back(make_worlds_command());
    commands.push_back(make_contact_command());
    commands.push_back(make_limits_command());
    add_parts_of_all(commands);
    Commands parts;
    add_parts_of_all(parts);
    commands.push_back(make_all_command(std::move(parts)));
    return commands;
}
} // namespace ode_predictive_space::benchmarks
