// What every subcommand of predictive_bench can be told.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_OPTIONS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_OPTIONS_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace ode_predictive_space::benchmarks
{
struct Options
{
    std::optional<int> objects;      ///< n; not given: what the subcommand is about
    std::optional<int> ticks;        ///< to measure; not given: enough for a steady mean, fewer when quick
    std::uint64_t seed = 1;          ///< of places, motions and the hand
    std::vector<std::string> spaces; ///< contenders; empty: those that the subcommand is about
    std::string json_file;           ///< empty: none
    bool quick = false;              ///< be done soon: fewer ticks, and the slow only where they are not too slow
    bool check = false;              ///< check the predictive spaces by brute force after every tick
};

/// Add the options to a subcommand; what the command line gives is written to `options`, which must outlive it.
void declare_options(CLI::App &command, Options &options);
} // namespace ode_predictive_space::benchmarks

#endif
