// Tables and numbers as text.

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

/// A 64-bit hash as 16 hexadecimal digits.
std::string hexadecimal(std::uint64_t hash);

/// Columns as wide as their widest cell, the first aligned on the left, the others on the right. A table that is wider than
/// output_width is printed in several parts, each with the first column. A first cell that is too wide for
/// others beside it is printed on a line of its own.
class Table
{
public:
    using Row = std::vector<std::string>;

    explicit Table(Row head) : rows_{std::move(head)} {}

    void add(Row row) { rows_.push_back(std::move(row)); }

    /// Write it with a line under the head.
    void print(std::ostream &out) const;

private:
    std::vector<std::size_t> column_widths() const;
    void print_columns(std::ostream &out, const std::vector<std::size_t> &widths, std::size_t begin,
                       std::size_t end) const;

    std::vector<Row> rows_;
};
} // namespace ode_predictive_space::worlds

#endif
