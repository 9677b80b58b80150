// The table of a scene whose ticks are timed one by one: dSpaceCollide() and whole ticks in each space.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_SPAN_TABLE_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_SPAN_TABLE_H

#include "tests/benchmarks/comparison.h"

#include <string>

namespace ode_predictive_space::benchmarks
{
/// A scene, or a part of it.
struct Span
{
    std::string table; ///< for the records: what the scene is one of
    std::string scene;
    double begin = 0;                      ///< seconds since the scene began
    double end = 0;                        ///< 0: all that was measured
    std::string calls = "dSpaceCollide()"; ///< what is timed

    bool is_window() const { return end > 0; }
};

/// Print and record it.
void show(const Span &span, const Comparison &comparison, Findings &findings);

/// The mean of the best ODE space over that of this space; not a number when there is nothing to compare with.
double collide_ratio(const Comparison &comparison, const std::string &space);

/// The same of whole ticks.
double tick_ratio(const Comparison &comparison, const std::string &space);
} // namespace ode_predictive_space::benchmarks

#endif
