// predictive_bench table1: the paper's Table 1, measured here.

#include "tests/benchmarks/commands.h"
#include "tests/benchmarks/table1.h"

#include <iostream>

namespace ode_predictive_space::benchmarks
{
namespace
{
void require(const Table1Block &block, Findings &findings)
{
    for (std::size_t row = 0; row < table1_in_paper.size(); ++row)
    {
        for (std::size_t other = 0; other < table1_others.size(); ++other)
        {
            findings.require({"P1",
                              "mix " + std::to_string(table1_in_paper[row].objects) + ", gain over " +
                                  table1_others[other].in_the_paper,
                              block.gain(row, other), Requirement::at_least, table1_in_paper[row].gains[other], "%"});
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
        const Table1 table = measure_table1("predictive-box", options, findings);
        std::cout << "Table 1: mean times per tick in mix, and the gain (T_other - T_ours) / T_other in percent, "
                     "here / in the paper\n\n";
        for (const Table1Block *block : {&table.broad, &table.narrow, &table.whole, &table.clocked})
        {
            show(table, *block, options.seed, findings);
        }
        require(table.broad, findings);
    }
};
} // namespace

std::unique_ptr<Command> make_table1_command()
{
    return std::make_unique<Table1Command>();
}
} // namespace ode_predictive_space::benchmarks
