#include "ode_predictive_space/haptics/recording.h"

#include "ode_predictive_space/haptics/record/recording_format.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <string_view>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double length_tolerance = 0.01; // of a quaternion, in a file of few digits

/// Takes the words of a line one by one.
class Words
{
public:
    explicit Words(std::string_view line) : rest_(line) {}

    /// @return an empty word at the end of the line.
    std::string_view next()
    {
        skip_blanks();
        const std::string_view word = rest_.substr(0, rest_.find_first_of(blanks));
        rest_.remove_prefix(word.size());
        return word;
    }

    std::string_view rest()
    {
        skip_blanks();
        return rest_;
    }

private:
    static constexpr const char *blanks = " \t\r";

    void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size())); }

    std::string_view rest_;
};

template <class Number> Number number_in(std::string_view word)
{
    Number number{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size())
        throw std::invalid_argument("\"" + std::string(word) + "\" is not a number that can be there");
    return number;
}

void read(std::string_view word, double &number)
{
    number = number_in<double>(word);
    if (!std::isfinite(number))
        throw std::invalid_argument("\"" + std::string(word) + "\" is not finite");
}

template <class Whole> void read(std::string_view word, Whole &number)
{
    number = number_in<Whole>(word);
}

/// What follows the mark that the line begins with.
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

/// Takes the lines of a file one by one.
class Lines
{
public:
    explicit Lines(std::istream &stream) : stream_(stream) {}

    /// @return false at the end of the file.
    bool next()
    {
        stream_.getline(characters_.data(), static_cast<std::streamsize>(characters_.size()));
        const bool cut = stream_.fail() && !stream_.eof() && !stream_.bad();
        if (!cut && stream_.fail())
            return false;
        ++number_;
        if (cut)
            throw std::invalid_argument("it has more than " + std::to_string(longest_recorded_line) + " characters");
        return true;
    }

    std::string_view line() const
    {
        const auto taken = static_cast<std::size_t>(stream_.gcount());
        return {characters_.data(), stream_.eof() ? taken : taken - 1}; // without the end of the line
    }

    std::size_t number() const { return number_; }

private:
    std::istream &stream_;
    std::array<char, longest_recorded_line + 1> characters_;
    std::size_t number_ = 0;
};

/// Makes a recording of lines. What it throws says what is wrong with the line.
class Reader
{
public:
    explicit Reader(std::size_t most_ticks) : most_ticks_(most_ticks) {}

    void take(std::string_view line)
    {
        if (const auto device = after(device_line_mark, line))
            recording_.device = device_in(*device);
        else if (const auto delay = after(delay_line_mark, line); delay && recording_.device)
            read(Words(*delay).next(), recording_.device->delay);
        else if (const auto law = after(law_line_mark, line))
            recording_.law = Words(*law).next();
        else if (const std::string_view first = Words(line).next(); !first.empty() && first[0] != '#')
            add(tick_in(line));
    }

    Recording finish()
    {
        if (recording_.ticks.empty())
            throw std::invalid_argument("there is no tick in it");
        recording_.has_forces = columns_ >= 12;
        recording_.has_velocities = columns_ >= 18;
        return std::move(recording_);
    }

private:
    static Capabilities device_in(std::string_view line)
    {
        Words words(line);
        Capabilities device;
        visit_device(device, [&](auto &number) { read(words.next(), number); });
        device.name = words.rest();
        return device;
    }

    RecordedTick tick_in(std::string_view line)
    {
        std::array<std::string_view, 18> words;
        const std::size_t count = split(line, words);
        RecordedTick tick;
        visit_tick(tick, [&, i = std::size_t{0}](auto &number) mutable {
            if (i < count)
                read(words[i], number);
            ++i;
        });
        tick.state.orientation = of_length_one(tick.state.orientation);
        return tick;
    }

    std::size_t split(std::string_view line, std::array<std::string_view, 18> &words)
    {
        Words all(line);
        std::size_t count = 0;
        for (std::string_view word = all.next(); !word.empty(); word = all.next(), ++count)
            if (count < words.size())
                words[count] = word;
        if (count != 8 && count != 12 && count != 18)
            throw std::invalid_argument(std::to_string(count) + " numbers where 8, 12 or 18 are expected");
        if (columns_ != 0 && count != columns_)
        {
            throw std::invalid_argument(std::to_string(count) + " numbers, and " + std::to_string(columns_) +
                                        " in the lines before");
        }
        columns_ = count;
        return count;
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
    Lines lines(stream);
    try
    {
        while (lines.next())
            reader.take(lines.line());
        return reader.finish();
    }
    catch (const std::invalid_argument &error)
    {
        throw DeviceError(DeviceFault::bad_file,
                          "recording " + file + ", line " + std::to_string(lines.number()) + ": " + error.what());
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
    const bool nothing_recorded = truth == 0;
    result.relative =
        nothing_recorded ? (errors == 0 ? 0 : std::numeric_limits<double>::infinity()) : std::sqrt(errors / truth);
    return result;
}
} // namespace ode_predictive_space::haptics
