// Text from files and other programs is printed so that it cannot control a terminal.

#ifndef ODE_PREDICTIVE_SPACE_RECORDING_PRINTABLE_H
#define ODE_PREDICTIVE_SPACE_RECORDING_PRINTABLE_H

#include <cstddef>
#include <string>

namespace ode_predictive_space
{
/// Bytes of the UTF-8 character with which a 0-terminated text begins; 0 for a control character and for anything else.
inline std::size_t printable_character(const char *text)
{
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    if (first < 0x80)
        return first >= ' ' && first != 0x7f ? 1 : 0;
    const std::size_t size = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
    for (std::size_t i = 1; i < size; ++i)
        if ((byte(i) & 0xc0) != 0x80)
            return 0;
    const bool is_control = first == 0xc2 && byte(1) < 0xa0;
    const bool has_shorter_form = (first == 0xe0 && byte(1) < 0xa0) || (first == 0xf0 && byte(1) < 0x90);
    return is_control || has_shorter_form ? 0 : size;
}

/// Calls `put` for each byte of a text, for one of no printable character with its escape, as \x1b. Uses the C library alone.
/// @param end where the text has a 0; it may have others before.
template <typename Put> void put_printable(const char *text, const char *end, Put put)
{
    constexpr char digits[] = "0123456789abcdef";
    while (text != end)
    {
        const std::size_t size = printable_character(text);
        for (std::size_t i = 0; i < size; ++i)
            put(*text++);
        if (size > 0)
            continue;
        const auto byte = static_cast<unsigned char>(*text++);
        for (const char each : {'\\', 'x', digits[byte >> 4], digits[byte & 15]})
            put(each);
    }
}

inline std::string printable(const std::string &text)
{
    std::string shown;
    put_printable(text.c_str(), text.c_str() + text.size(), [&](char each) { shown += each; });
    return shown;
}
} // namespace ode_predictive_space

#endif
