#include "demos/runs/table.h"

#include "demos/runs/narrow_output.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <ostream>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr std::size_t column_gap = 2;
constexpr std::size_t narrowest_label = 26; // of a first column that is too wide for the others

std::string with_groups(std::string digits)
{
    for (auto position = static_cast<int>(digits.size()) - 3; position > 0; position -= 3)
        digits.insert(static_cast<std::size_t>(position), ",");
    return digits;
}
} // namespace

std::string grouped(std::uint64_t number)
{
    return with_groups(std::to_string(number));
}

std::string fixed(double number, int decimals)
{
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, std::abs(number));
    const std::string digits = text;
    const std::size_t point = std::min(digits.find('.'), digits.size());
    const bool is_zero = digits.find_first_not_of("0.") == std::string::npos;
    return (number < 0 && !is_zero ? "-" : "") + with_groups(digits.substr(0, point)) + digits.substr(point);
}

std::string hexadecimal(std::uint64_t hash)
{
    char text[17];
    std::snprintf(text, sizeof text, "%016" PRIx64, hash);
    return text;
}

std::vector<std::size_t> Table::column_widths() const
{
    std::vector<std::size_t> widths(rows_.front().size(), 0);
    for (const Row &row : rows_)
    {
        for (std::size_t column = 0; column < row.size(); ++column)
            widths[column] = std::max(widths[column], width(row[column]));
    }
    return widths;
}

void Table::print(std::ostream &out) const
{
    std::vector<std::size_t> widths = column_widths();
    const std::size_t others = std::accumulate(widths.begin() + 1, widths.end(), column_gap * (widths.size() - 1));
    const std::size_t room = output_width - std::min(others, output_width - narrowest_label);
    widths[0] = std::min(widths[0], room);
    for (std::size_t begin = 1; begin < widths.size();)
    {
        std::size_t total = widths[0];
        std::size_t end = begin;
        while (end < widths.size() && (end == begin || total + column_gap + widths[end] <= output_width))
            total += column_gap + widths[end++];
        out << (begin > 1 ? "\n" : "");
        print_columns(out, widths, begin, end);
        begin = end;
    }
}

void Table::print_columns(std::ostream &out, const std::vector<std::size_t> &widths, std::size_t begin,
                          std::size_t end) const
{
    const auto first = widths.begin();
    const std::size_t total =
        std::accumulate(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end),
                        widths[0] + column_gap * (end - begin));
    for (std::size_t i = 0; i < rows_.size(); ++i)
    {
        const Row &row = rows_[i];
        const bool too_long = width(row[0]) > widths[0];
        out << row[0] << (too_long ? "\n" : "") << std::string(widths[0] - (too_long ? 0 : width(row[0])), ' ');
        for (std::size_t column = begin; column < std::min(end, row.size()); ++column)
            out << std::string(column_gap + widths[column] - width(row[column]), ' ') << row[column];
        out << '\n';
        if (i == 0)
            out << std::string(total, '-') << '\n';
    }
}
} // namespace ode_predictive_space::worlds
