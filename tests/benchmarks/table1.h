// The paper's Table 1, measured here.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_TABLE1_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_TABLE1_H

#include "tests/benchmarks/findings.h"
#include "tests/benchmarks/options.h"

#include <array>
#include <iosfwd>

namespace ode_predictive_space::benchmarks
{
/// Those that the paper compares itself with.
struct Table1Other
{
    const char *name;
    const char *in_the_paper;
};

constexpr std::array<Table1Other, 4> table1_others = {
    {{"brute", "brute force"}, {"sap", "sweep & prune"}, {"quadtree", "quadtree"}, {"hash", "uniform grid"}}};

/// A row of the paper's table: its gains in percent.
struct Table1Row
{
    int objects;
    std::array<double, table1_others.size()> gains;
};

constexpr std::array<Table1Row, 5> table1_in_paper = {{{20, {97.9, 83.3, 80.4, 82.1}},
                                                       {40, {96.3, 51.8, 51.4, 49.9}},
                                                       {60, {97.8, 60.7, 62.6, 64.6}},
                                                       {80, {97.9, 46.1, 54.8, 59.7}},
                                                       {100, {97.4, 32.7, 38.7, 39.9}}}};

/// One way to look at the same runs.
struct Table1Block
{
    std::string name;
    std::string text;
    /// Mean times of each size, in microseconds: ours, then the others'.
    std::array<std::array<double, table1_others.size() + 1>, table1_in_paper.size()> means{};

    /// (T_other - T_ours) / T_other in percent.
    double gain(std::size_t row, std::size_t other) const
    {
        return 100 * (means[row][other + 1] - means[row][0]) / means[row][other + 1];
    }

    /// Cells in which the gain is that of the paper or more.
    int cells_reached() const;
};

struct Table1
{
    std::string ours; ///< the contender
    Table1Block broad{"broad phase", "dSpaceCollide() with a callback that does nothing but note the pair", {}};
    Table1Block narrow{"broad and narrow phase", "the callback calls dCollide()", {}};
    Table1Block whole{"whole tick", "with contact joints and the step of the world", {}};
    Table1Block clocked{"by the clock", "dSpaceCollide() within the whole tick, each call timed by itself", {}};
};

/// Measure it in mix. The options' contenders are not used: those of the table are fixed.
///
/// @param ours the contender whose gains these are.
Table1 measure_table1(const std::string &ours, const Options &options, Findings &findings);

/// Print a block and add a record for each of its cells.
void show(const Table1 &table, const Table1Block &block, std::uint64_t seed, Findings &findings);
} // namespace ode_predictive_space::benchmarks

#endif
