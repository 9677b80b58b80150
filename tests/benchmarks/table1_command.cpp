// predictive_bench table1: the paper's Table 1, measured here.

#include "tests/benchmarks/batches.h"
#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/comparison.h"

#include "demos/scenes/table.h"

#include <array>
#include <functional>
#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace scenes;

constexpr int usual_ticks = 16000;

/// Those that the paper compares itself with, and its gains in percent.
struct Other
{
    const char *name;
    const char *in_the_paper;
};

constexpr std::array<Other, 4> others = {
    {{"brute", "brute force"}, {"sap", "sweep & prune"}, {"quadtree", "quadtree"}, {"hash", "uniform grid"}}};

struct PaperRow
{
    int objects;
    std::array<double, others.size()> gains;
};

constexpr std::array<PaperRow, 5> paper = {{{20, {97.9, 83.3, 80.4, 82.1}},
                                            {40, {96.3, 51.8, 51.4, 49.9}},
                                            {60, {97.8, 60.7, 62.6, 64.6}},
                                            {80, {97.9, 46.1, 54.8, 59.7}},
                                            {100, {97.4, 32.7, 38.7, 39.9}}}};

const std::string ours = "predictive-box";

/// Mean times of one size, by contender: ours, then the others.
using Means = std::array<double, others.size() + 1>;

/// One way to look at the same runs.
struct Block
{
    std::string name;
    std::string text;
    std::array<Means, paper.size()> means{};

    double gain(std::size_t row, std::size_t other) const
    {
        return 100 * (means[row][other + 1] - means[row][0]) / means[row][other + 1];
    }
};

std::vector<std::string> contenders()
{
    std::vector<std::string> names = {ours};
    for (const Other &other : others)
    {
        names.emplace_back(other.name);
    }
    return names;
}

Means means_of(const Comparison &comparison, std::vector<double> Result::*times)
{
    Means means{};
    for (std::size_t i = 0; i < means.size(); ++i)
    {
        means[i] = summarise(comparison.results[i].*times).mean;
    }
    return means;
}

Means means_with_narrow_phase(const Plan &plan)
{
    const auto times =
        measure_batches(SceneFactory(plan.spec), plan.contenders, plan.ticks, NearCallback::find_contacts);
    Means means{};
    for (std::size_t i = 0; i < means.size(); ++i)
    {
        means[i] = summarise(times[i]).mean;
    }
    return means;
}

void print(std::ostream &out, const Block &block)
{
    out << block.name << ": " << block.text << "\n\n";
    Table::Row head = {"objects", "ours (µs)"};
    for (const Other &other : others)
    {
        head.push_back(std::string(other.name) + " (µs)");
    }
    for (const Other &other : others)
    {
        head.emplace_back(other.in_the_paper);
    }
    Table table(head);
    for (std::size_t row = 0; row < paper.size(); ++row)
    {
        Table::Row cells = {std::to_string(paper[row].objects)};
        for (const double mean : block.means[row])
        {
            cells.push_back(fixed(mean, 2));
        }
        for (std::size_t other = 0; other < others.size(); ++other)
        {
            cells.push_back(fixed(block.gain(row, other), 1) + " / " + fixed(paper[row].gains[other], 1));
        }
        table.add(cells);
    }
    table.print(out);
    out << '\n';
}

void record(const Block &block, std::uint64_t seed, Findings &findings)
{
    for (std::size_t row = 0; row < paper.size(); ++row)
    {
        for (std::size_t other = 0; other < others.size(); ++other)
        {
            findings.record({{"table", "table1"},
                             {"block", block.name},
                             {"scene", "mix"},
                             {"n", paper[row].objects},
                             {"seed", seed},
                             {"other", others[other].name},
                             {"ours_us", block.means[row][0]},
                             {"other_us", block.means[row][other + 1]},
                             {"gain_percent", block.gain(row, other)},
                             {"paper_gain_percent", paper[row].gains[other]}});
        }
    }
}

void require(const Block &block, Findings &findings)
{
    for (std::size_t row = 0; row < paper.size(); ++row)
    {
        for (std::size_t other = 0; other < others.size(); ++other)
        {
            findings.require({"P1",
                              "mix " + std::to_string(paper[row].objects) + ", gain over " + others[other].in_the_paper,
                              block.gain(row, other), Requirement::at_least, paper[row].gains[other], "%"});
        }
    }
}

class Table1Command : public Command
{
public:
    std::string name() const override { return "table1"; }
    std::string description() const override { return "The paper's Table 1, measured here, beside the paper's"; }

    void measure(const Options &options, Findings &findings) override
    {
        Block broad{"broad phase", "dSpaceCollide() with a callback that does nothing but note the pair", {}};
        Block narrow{"broad and narrow phase", "the callback calls dCollide()", {}};
        Block whole{"whole tick", "with contact joints and the step of the world", {}};
        Block clocked{"by the clock", "dSpaceCollide() within the whole tick, each call timed by itself", {}};
        for (std::size_t row = 0; row < paper.size(); ++row)
        {
            Options same_contenders = options;
            same_contenders.spaces.clear();
            const Plan plan = plan_for({"mix", paper[row].objects}, contenders(), usual_ticks, same_contenders);
            Plan with_floors = plan; // behind the others, and in no gain
            with_floors.contenders.insert(with_floors.contenders.end(), {"floor-boxes", "floor"});
            const Comparison comparison = compare(with_floors, findings);
            benchmarks::record(comparison, findings);
            broad.means[row] = means_of(comparison, &Result::times);
            whole.means[row] = means_of(comparison, &Result::tick_times);
            clocked.means[row] = means_of(comparison, &Result::clock_times);
            narrow.means[row] = means_with_narrow_phase(plan);
        }
        std::cout << "Table 1: mean times per tick in mix, and the gain (T_other - T_ours) / T_other in percent, "
                     "here / in the paper\n\n";
        for (const Block *block : {&broad, &narrow, &whole, &clocked})
        {
            print(std::cout, *block);
            record(*block, options.seed, findings);
        }
        require(broad, findings);
    }
};
} // namespace

std::unique_ptr<Command> make_table1_command()
{
    return std::make_unique<Table1Command>();
}
} // namespace ode_predictive_space::benchmarks
