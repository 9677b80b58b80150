#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CLOCK_CLOCKS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CLOCK_CLOCKS_H

#include "tests/benchmarks/rows.h"

#include <benchmark/benchmark.h>
#include <string>
#include <vector>

namespace ode_predictive_space::benchmarks
{
enum class Extent
{
    full, ///< complete rows
    brief ///< at most 40 objects and 20 ticks, to see that everything runs and all spaces agree
};

constexpr int brief_objects = 40;
constexpr int brief_ticks = 20;

/// collide/WORLD/N/SPACE  the world's calls for its pairs
/// tick/WORLD/N/SPACE     the whole tick: motion with the step of the world, the pairs, contacts
/// contact/WORLD/N/SPACE  the pairs, and dCollide() for each of them
void register_worlds(Extent extent);

/// query/WHAT/N/SPACE  dSpaceCollide2() of 20 spheres, of 20 rays
void register_queries(Extent extent);

/// life/WORLD/N/SPACE  the life of a space, from the first geom to the last
void register_lives(Extent extent);

/// p50, p99, p99.9 and maximum of a series of microseconds, which is not empty, as counters.
void count_percentiles(benchmark::State &state, std::vector<double> microseconds);

/// For example "collide/gas/1000/sap".
std::string benchmark_name(const std::string &kind, const std::string &world, int objects, const std::string &space);

/// Limit above which a contender is left out: a tick takes seconds (brute, simple), its table gigabytes (hash, n^2 / 8 bytes),
/// its first tick (quadtree) or its filling and emptying (bullet-sap) minutes.
int most_objects(const std::string &contender);
} // namespace ode_predictive_space::benchmarks

#endif
