#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_TABLE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_TABLE_H

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace ode_predictive_space::worlds
{
/// A whole number with its digits in groups of three: 1,234,567.
std::string grouped(std::uint64_t number);

/// A number with the given number of digits after the point, grouped before it: 1,234.5.
std::string fixed(double number, int decimals);

std::string hexadecimal(std::uint64_t hash);

/// Columns as wide as their widest cell, the first aligned on the left, the others on the right.
class Table
{
public:
    using Row = std::vector<std::string>;

    explicit Table(Row head) : rows_{std::move(head)} {}

    void add(Row row) { rows_.push_back(std::move(row)); }

    void print(std::ostream &out) const;

private:
    std::vector<Row> rows_;
};
} // namespace ode_predictive_space::worlds

#endif
