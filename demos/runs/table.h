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

/// Columns are as wide as their widest cell, the first aligned on the left, the others on the right. @param rows the first is
/// the head; all have as many cells.
void print_table(std::ostream &out, const std::vector<std::vector<std::string>> &rows);
} // namespace ode_predictive_space::worlds

#endif
