// Times the worlds of demos/worlds in all spaces and broad phases. Every claim is a ratio of one run, with the same motion.

#include "demos/worlds/spaces.h"
#include "tests/benchmarks/clock/agreement.h"
#include "tests/benchmarks/clock/clocks.h"
#include "tests/benchmarks/contenders/statistics.h"
#include "tests/benchmarks/which_ode.h"

#include <algorithm>
#include <cstring>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
void count_percentiles(benchmark::State &state, std::vector<double> microseconds)
{
    std::sort(microseconds.begin(), microseconds.end());
    state.counters["p50"] = percentile(microseconds, 500);
    state.counters["p99"] = percentile(microseconds, 990);
    state.counters["p99.9"] = percentile(microseconds, 999);
    state.counters["max"] = microseconds.back();
}

std::string benchmark_name(const std::string &kind, const std::string &world, int objects, const std::string &space)
{
    return kind + "/" + world + "/" + std::to_string(objects) + "/" + space;
}

int most_objects(const std::string &contender)
{
    if (contender == "brute")
        return 1000;
    if (contender == "simple")
        return 5000;
    return contender == "hash" || contender == "quadtree" || contender == "bullet-sap" ? 20000 : 1000000;
}
} // namespace ode_predictive_space::benchmarks

namespace
{
using namespace ode_predictive_space::benchmarks;

constexpr char help[] = "Usage: predictive_bench [--brief] [--benchmark_filter=PATTERN] [...]\n"
                        "\n"
                        "Clocks worlds in the predictive space, in ODE's own and in others. Benchmarks:\n"
                        "  collide/WORLD/N/SPACE  the calls that find a world's pairs\n"
                        "  tick/WORLD/N/SPACE     the whole tick, with motion, step and contacts\n"
                        "  contact/WORLD/N/SPACE  the pairs, and dCollide() for each of them\n"
                        "  query/WHAT/N/SPACE     dSpaceCollide2() of 20 spheres or 20 rays\n"
                        "  life/WORLD/N/SPACE     a space from its first geom to its last\n"
                        "--brief runs them with few objects and ticks. The label is the hash of the\n"
                        "pairs. Exit status: 1 when a space reported other pairs than the simple one,\n"
                        "2 when nothing was measured.\n"
                        "\n";

void print_help()
{
    std::cout << help;
    benchmark::PrintDefaultHelp();
}

bool take_option(const char *option, int &argc, char **argv)
{
    char **const end = argv + argc;
    char **const rest = std::remove_if(argv + 1, end, [&](char *word) { return std::strcmp(word, option) == 0; });
    argc = static_cast<int>(rest - argv);
    return rest != end;
}
} // namespace

int main(int argc, char **argv)
{
    const Extent extent = take_option("--brief", argc, argv) ? Extent::brief : Extent::full;
    benchmark::Initialize(&argc, argv, &print_help);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    const ode_predictive_space::worlds::OdeSession ode;
    benchmark::AddCustomContext("ode", which_ode());
    register_worlds(extent);
    register_queries(extent);
    register_lives(extent);
    if (benchmark::RunSpecifiedBenchmarks() == 0 || !std::cout.flush())
        return 2;
    return Agreement::all().holds() ? 0 : 1;
}
