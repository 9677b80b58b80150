#include "demos/runs/narrow_output.h"

#include <algorithm>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr std::size_t widest_label = 40;

std::size_t hanging_indent(const std::string &line)
{
    const std::size_t text = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t gap = line.find("  ", text);
    const std::size_t after_gap = line.find_first_not_of(' ', std::min(gap, line.size()));
    return after_gap <= widest_label ? after_gap : text;
}

/// Bytes of the line that fit; 0 when they cannot be parted from the rest.
std::size_t place_to_break(const std::string &line, std::size_t indent)
{
    std::size_t place = 0;
    std::size_t columns = 0;
    for (std::size_t i = 0; i < line.size() && columns <= output_width; ++i)
    {
        columns += width(line.substr(i, 1));
        if (i > indent && (line[i] == ' ' || (line[i] == ',' && columns <= output_width)))
            place = line[i] == ' ' ? i : i + 1;
    }
    return place;
}
} // namespace

std::size_t width(const std::string &text)
{
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string folded(const std::string &line)
{
    const std::size_t indent = hanging_indent(line);
    std::string lines;
    std::string rest = line;
    while (width(rest) > output_width)
    {
        const std::size_t place = place_to_break(rest, indent);
        if (place == 0)
            break;
        const std::size_t next = rest.find_first_not_of(' ', place);
        lines += rest.substr(0, place) + '\n';
        rest = std::string(indent, ' ') + (next < rest.size() ? rest.substr(next) : "");
    }
    return lines + rest;
}

NarrowOutput::~NarrowOutput()
{
    finish();
    stream_.rdbuf(out_); // and a good state
}

bool NarrowOutput::finish()
{
    const std::string last = folded(line_);
    line_.clear();
    const auto size = static_cast<std::streamsize>(last.size());
    if (out_->sputn(last.data(), size) != size)
        stream_.setstate(std::ios::badbit);
    return stream_.flush().good();
}

NarrowOutput::int_type NarrowOutput::overflow(int_type letter)
{
    if (traits_type::eq_int_type(letter, traits_type::eof()))
        return traits_type::not_eof(letter);
    line_ += traits_type::to_char_type(letter);
    if (letter != '\n')
        return letter;
    line_.pop_back();
    const std::string lines = folded(line_) + '\n';
    line_.clear();
    const auto size = static_cast<std::streamsize>(lines.size());
    return out_->sputn(lines.data(), size) == size ? letter : traits_type::eof();
}
} // namespace ode_predictive_space::worlds
