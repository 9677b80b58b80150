#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_ROWS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_ROWS_H

#include "demos/worlds/world.h"

#include <string>
#include <vector>

namespace ode_predictive_space::benchmarks
{
struct Ticks
{
    int first = 0; ///< ticks before the first measured one
    int count = 0; ///< 0: none
    int every = 1; ///< distance between measured ticks

    int to_make() const { return count > 0 ? first + (count - 1) * every + 1 : 0; }
};

struct Row
{
    std::string world;
    int objects;
    Ticks clocked{};    ///< timed by predictive_bench
    Ticks counted{};    ///< instructions counted by record_worlds and ode-predictive replay
    std::string part{}; ///< part of the world's time, if the row measures only a part

    std::string name() const { return part.empty() ? world : world + ":" + part; }
    worlds::WorldSpec spec() const { return {world, objects}; }
};

const std::vector<Row> &rows();
} // namespace ode_predictive_space::benchmarks

#endif
