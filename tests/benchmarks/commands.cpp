#include "tests/benchmarks/commands.h"

namespace ode_predictive_space::benchmarks
{
Commands make_commands()
{
    Commands commands;
    commands.push_back(make_scene_command());
    commands.push_back(make_query_command());
    commands.push_back(make_memory_command());
    commands.push_back(make_haptic_command());
    return commands;
}
} // namespace ode_predictive_space::benchmarks
