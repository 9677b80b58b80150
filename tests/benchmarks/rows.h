// The worlds that are measured: in which size, and which of their ticks.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_ROWS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_ROWS_H

#include "demos/worlds/world.h"

#include <string>
#include <vector>

namespace ode_predictive_space::benchmarks
{
struct Ticks
{
    int first = 0; ///< ticks before them
    int count = 0; ///< 0: none
    int every = 1; ///< from one to the next

    int to_make() const { return count > 0 ? first + (count - 1) * every + 1 : 0; }
};

/// A world in one size.
struct Row
{
    std::string world;
    int objects;
    Ticks clocked{};    ///< by predictive_bench
    Ticks counted{};    ///< of their instructions, by record_worlds and ode-predictive replay
    std::string part{}; ///< of the world's time, where a row measures less than the world's row

    /// "gas", "heap:0.5s".
    std::string name() const { return part.empty() ? world : world + ":" + part; }
    worlds::WorldSpec spec() const { return {world, objects}; }
};

/// All rows.
const std::vector<Row> &rows();
} // namespace ode_predictive_space::benchmarks

#endif
