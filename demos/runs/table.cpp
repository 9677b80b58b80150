#include "demos/runs/table.h"

#include <algorithm>
#include <iomanip>
#include <locale>
#include <sstream>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr int column_gap = 2;

struct GroupsOfThree : std::numpunct<char>
{
    char do_thousands_sep() const override { return ','; }
    std::string do_grouping() const override { return "\3"; }
};
} // namespace

std::string grouped(std::uint64_t number)
{
    return fixed(static_cast<double>(number), 0);
}

std::string fixed(double number, int decimals)
{
    std::ostringstream text;
    text.imbue(std::locale(std::locale::classic(), new GroupsOfThree));
    text << std::fixed << std::setprecision(decimals) << number;
    return text.str();
}

std::string hexadecimal(std::uint64_t hash)
{
    std::ostringstream text;
    text << std::hex << std::setw(16) << std::setfill('0') << hash;
    return text.str();
}

void print_table(std::ostream &out, const std::vector<std::vector<std::string>> &rows)
{
    std::vector<int> widths;
    for (std::size_t column = 0; column < rows.front().size(); ++column)
    {
        std::size_t widest = 0;
        for (const auto &row : rows)
            widest = std::max(widest, row[column].size());
        widths.push_back(static_cast<int>(widest) + (column > 0 ? column_gap : 0));
    }
    for (const auto &row : rows)
    {
        for (std::size_t column = 0; column < row.size(); ++column)
            out << (column == 0 ? std::left : std::right) << std::setw(widths[column]) << row[column];
        out << '\n';
    }
}
} // namespace ode_predictive_space::worlds
