#include "ode_predictive_space/haptics/recording.h"

#include "ode_predictive_space/haptics/record/recording_format.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double length_tolerance = 0.01; // of a quaternion, in a file of few digits

/// Removes the first word, with the blanks around it, from the text; empty at its end.
std::string_view take_word(std::string_view &text)
{
    constexpr const char *blanks = " \t\r";
    const auto skip_blanks = [&] { text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size())); };
    skip_blanks();
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    skip_blanks();
    return word;
}

template <class Number> void read(std::string_view word, Number &number)
{
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number))
        throw std::invalid_argument("\"" + std::string(word) +
                                    "\" is not a number of the expected kind, or it is not finite");
}

std::optional<std::string_view> after(std::string_view mark, std::string_view line)
{
    return line.substr(0, mark.size()) == mark ? std::optional(line.substr(mark.size())) : std::nullopt;
}

Quaternion of_length_one(const Quaternion &q)
{
    const double error = q.norm() - 1;
    if (std::abs(error) > length_tolerance)
        throw std::invalid_argument("the quaternion is not of length 1");
    return std::abs(error) > exact_length_tolerance ? Quaternion(q.normalized()) : q;
}

/// Builds a recording from lines. Its exceptions say what is wrong with a line.
class Reader
{
public:
    explicit Reader(std::size_t most_ticks) : most_ticks_(most_ticks) {}

    void take(std::string_view line)
    {
        if (auto device = after(device_line_mark, line))
            recording_.device = device_in(*device);
        else if (auto delay = after(delay_line_mark, line); delay && recording_.device)
            read(take_word(*delay), recording_.device->delay);
        else if (auto law = after(law_line_mark, line))
            recording_.law = take_word(*law);
        else if (std::string_view rest = line; !is_comment(take_word(rest)))
            add(tick_in(line));
    }

    Recording finish()
    {
        if (recording_.ticks.empty())
            throw std::invalid_argument("it has no ticks");
        recording_.has_forces = columns_ >= 12;
        recording_.has_velocities = columns_ >= 18;
        return std::move(recording_);
    }

private:
    static bool is_comment(std::string_view first_word) { return first_word.empty() || first_word[0] == '#'; }

    static Capabilities device_in(std::string_view line)
    {
        Capabilities device;
        visit_device(device, [&](auto &number) { read(take_word(line), number); });
        device.name = line;
        return device;
    }

    RecordedTick tick_in(std::string_view line)
    {
        std::size_t count = 0;
        RecordedTick tick;
        visit_tick(tick, [&](auto &number) {
            if (const std::string_view word = take_word(line); !word.empty())
            {
                read(word, number);
                ++count;
            }
        });
        while (!take_word(line).empty())
            ++count;
        check_columns(count);
        tick.state.orientation = of_length_one(tick.state.orientation);
        return tick;
    }

    void check_columns(std::size_t count)
    {
        if (count != 8 && count != 12 && count != 18)
            throw std::invalid_argument(std::to_string(count) + " numbers where 8, 12 or 18 are expected");
        if (columns_ != 0 && count != columns_)
        {
            throw std::invalid_argument(std::to_string(count) + " numbers, and " + std::to_string(columns_) +
                                        " in the lines before");
        }
        columns_ = count;
    }

    void add(const RecordedTick &tick)
    {
        if (!recording_.ticks.empty() && !(tick.state.time > recording_.ticks.back().state.time))
            throw std::invalid_argument("its time is not later than that of the tick before");
        if (recording_.ticks.size() >= most_ticks_)
            throw std::invalid_argument("more than " + std::to_string(most_ticks_) + " ticks");
        recording_.ticks.push_back(tick);
    }

    std::size_t most_ticks_;
    std::size_t columns_ = 0; // of the lines so far
    Recording recording_;
};
} // namespace

Recording read_recording(const std::string &file, std::size_t most_ticks)
{
    errno = 0;
    std::ifstream stream(file);
    if (!stream)
        throw file_error(file, errno);
    Reader reader(most_ticks);
    std::array<char, longest_recorded_line + 1> line;
    std::size_t number = 0;
    try
    {
        while (stream.getline(line.data(), line.size()))
        {
            ++number;
            const auto taken = static_cast<std::size_t>(stream.gcount()); // including the end of the line, if any
            reader.take({line.data(), stream.eof() ? taken : taken - 1});
        }
        if (stream.eof() || stream.bad())
            return reader.finish();
        ++number;
        throw std::invalid_argument("it has more than " + std::to_string(longest_recorded_line) + " characters");
    }
    catch (const std::invalid_argument &error)
    {
        throw DeviceError(DeviceFault::bad_file,
                          "recording " + file + ", line " + std::to_string(number) + ": " + error.what());
    }
}

ForceError compare_forces(const std::vector<Vector3> &recorded, const std::vector<Vector3> &rendered)
{
    if (recorded.size() != rendered.size() || recorded.empty())
    {
        throw std::invalid_argument("compare_forces: " + std::to_string(recorded.size()) + " recorded forces and " +
                                    std::to_string(rendered.size()) + " rendered ones");
    }
    double errors = 0;
    double truth = 0;
    ForceError result;
    for (std::size_t i = 0; i < recorded.size(); ++i)
    {
        const Vector3 error = rendered[i] - recorded[i];
        errors += error.squaredNorm();
        truth += recorded[i].squaredNorm();
        result.max = std::max(result.max, error.norm());
    }
    result.rms = std::sqrt(errors / static_cast<double>(recorded.size()));
    result.relative = errors == 0 ? 0 : std::sqrt(errors / truth); // infinite for a recording without force
    return result;
}
} // namespace ode_predictive_space::haptics
