#include "tests/benchmarks/table1.h"

#include "tests/benchmarks/batches.h"
#include "tests/benchmarks/comparison.h"

#include "demos/runs/table.h"

#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

constexpr int table1_ticks = 16000;

using Means = std::array<double, table1_others.size() + 1>;

std::vector<std::string> contenders(const std::string &ours)
{
    std::vector<std::string> names = {ours};
    for (const Table1Other &other : table1_others)
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
        measure_batches(WorldFactory(plan.spec), plan.contenders, plan.ticks, NearCallback::find_contacts);
    Means means{};
    for (std::size_t i = 0; i < means.size(); ++i)
    {
        means[i] = summarise(times[i]).mean;
    }
    return means;
}

void print(std::ostream &out, const Table1Block &block)
{
    out << block.name << ": " << block.text << "\n\n";
    Table::Row head = {"objects", "ours (µs)"};
    for (const Table1Other &other : table1_others)
    {
        head.push_back(std::string(other.name) + " (µs)");
    }
    for (const Table1Other &other : table1_others)
    {
        head.emplace_back(other.in_the_paper);
    }
    Table table(head);
    for (std::size_t row = 0; row < table1_in_paper.size(); ++row)
    {
        Table::Row cells = {std::to_string(table1_in_paper[row].objects)};
        for (const double mean : block.means[row])
        {
            cells.push_back(fixed(mean, 2));
        }
        for (std::size_t other = 0; other < table1_others.size(); ++other)
        {
            cells.push_back(fixed(block.gain(row, other), 1) + " / " + fixed(table1_in_paper[row].gains[other], 1));
        }
        table.add(cells);
    }
    table.print(out);
    out << '\n';
}

void record(const std::string &ours, const Table1Block &block, std::uint64_t seed, Findings &findings)
{
    for (std::size_t row = 0; row < table1_in_paper.size(); ++row)
    {
        for (std::size_t other = 0; other < table1_others.size(); ++other)
        {
            findings.record({{"table", "table1"},
                             {"ours", ours},
                             {"block", block.name},
                             {"scene", "mix"},
                             {"n", table1_in_paper[row].objects},
                             {"seed", seed},
                             {"other", table1_others[other].name},
                             {"ours_us", block.means[row][0]},
                             {"other_us", block.means[row][other + 1]},
                             {"gain_percent", block.gain(row, other)},
                             {"paper_gain_percent", table1_in_paper[row].gains[other]}});
        }
    }
}

} // namespace

int Table1Block::cells_reached() const
{
    int reached = 0;
    for (std::size_t row = 0; row < table1_in_paper.size(); ++row)
    {
        for (std::size_t other = 0; other < table1_others.size(); ++other)
        {
            reached += gain(row, other) >= table1_in_paper[row].gains[other] ? 1 : 0;
        }
    }
    return reached;
}

Table1 measure_table1(const std::string &ours, const Options &options, Findings &findings)
{
    Table1 table;
    table.ours = ours;
    for (std::size_t row = 0; row < table1_in_paper.size(); ++row)
    {
        Options same_contenders = options;
        same_contenders.spaces.clear();
        const Plan plan =
            plan_for({"mix", table1_in_paper[row].objects}, contenders(ours), table1_ticks, same_contenders);
        Plan with_floors = plan; // behind the others, and in no gain
        with_floors.contenders.insert(with_floors.contenders.end(), {"floor-boxes", "floor"});
        const Comparison comparison = compare(with_floors, findings);
        benchmarks::record(comparison, findings);
        table.broad.means[row] = means_of(comparison, &Result::times);
        table.whole.means[row] = means_of(comparison, &Result::tick_times);
        table.clocked.means[row] = means_of(comparison, &Result::clock_times);
        table.narrow.means[row] = means_with_narrow_phase(plan);
    }
    return table;
}

void show(const Table1 &table, const Table1Block &block, std::uint64_t seed, Findings &findings)
{
    print(std::cout, block);
    record(table.ours, block, seed, findings);
}
} // namespace ode_predictive_space::benchmarks
