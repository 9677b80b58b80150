#include "tests/benchmarks/options.h"

#include "tests/benchmarks/contenders/contenders.h"

#include <CLI/CLI.hpp>

namespace ode_predictive_space::benchmarks
{
namespace
{
std::vector<std::string> accepted_names()
{
    std::vector<std::string> names = contender_names();
    names.emplace_back("predictive");
    return names;
}
} // namespace

void declare_options(CLI::App &command, Options &options)
{
    command.add_option("--n", options.objects, "Objects")->check(CLI::Range(1, 1000000));
    command.add_option("--ticks", options.ticks, "Ticks to measure")->check(CLI::Range(1, 100000000));
    command.add_option("--seed", options.seed, "Of places, motions and the hand")->capture_default_str();
    command.add_option("--spaces", options.spaces, "What is compared, separated by commas")
        ->delimiter(',')
        ->check(CLI::IsMember(accepted_names()));
    command.add_option("--json", options.json_file, "Write the results to this file, too")->type_name("FILE");
    command.add_flag("--quick", options.quick, "Be done soon: fewer ticks, the slow left out where they are too slow");
    command.add_flag("--check", options.check, "Check the predictive spaces by brute force after every tick");
}
} // namespace ode_predictive_space::benchmarks
