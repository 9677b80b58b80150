#include "demos/runs/table.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <ostream>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr std::size_t column_gap = 2;

std::string with_groups(std::string digits)
{
    for (auto position = static_cast<int>(digits.size()) - 3; position > 0; position -= 3)
        digits.insert(static_cast<std::size_t>(position), ",");
    return digits;
}

/// Characters on the screen: in UTF-8 all bytes but those that continue a character.
std::size_t width(const std::string &text)
{
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
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

void Table::print(std::ostream &out) const
{
    std::vector<std::size_t> widths(rows_.front().size(), 0);
    for (const Row &row : rows_)
    {
        for (std::size_t column = 0; column < row.size(); ++column)
            widths[column] = std::max(widths[column], width(row[column]));
    }
    std::size_t total = widths[0];
    for (std::size_t column = 1; column < widths.size(); ++column)
        total += column_gap + widths[column];
    for (const Row &row : rows_)
    {
        out << row[0] << std::string(widths[0] - width(row[0]), ' ');
        for (std::size_t column = 1; column < row.size(); ++column)
            out << std::string(column_gap + widths[column] - width(row[column]), ' ') << row[column];
        out << '\n';
        if (&row == &rows_.front())
            out << std::string(total, '-') << '\n';
    }
}
} // namespace ode_predictive_space::worlds
