#include "ode_predictive_space/haptics/record/recording_format.h"
#include "ode_predictive_space/haptics/recording.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr std::chrono::milliseconds flush_period(50);
constexpr std::size_t most_text = 1 << 16; // bytes; written at once

template <class Number> void append(std::string &text, Number number)
{
    std::array<char, 32> digits;
    // Without a precision, this prints the shortest digits that read back as the same double.
    const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    text += ' ';
    text.append(digits.data(), result.ptr);
}

/// Truncates a text to a line that the reader accepts.
std::string line_of(std::string text)
{
    std::replace(text.begin(), text.end(), '\n', ' ');
    text.resize(std::min(text.size(), longest_recorded_line));
    return text + '\n';
}

bool can_be_read_back(const DeviceState &state, const Vector3 &force)
{
    return state.position.allFinite() && state.orientation.coeffs().allFinite() &&
           std::abs(state.orientation.norm() - 1) <= exact_length_tolerance && state.linear_velocity.allFinite() &&
           state.angular_velocity.allFinite() && force.allFinite();
}
} // namespace

Recorder::Recorder(const std::string &file, const Capabilities &device, const std::string &law, Flush flush,
                   std::size_t capacity)
    : name_(file), buffer_(capacity)
{
    if (capacity == 0)
        throw std::invalid_argument("recording " + file + ": the buffer must hold at least one tick");
    errno = 0;
    file_.open(file);
    if (!file_)
        throw file_error(file, errno);
    text_.reserve(most_text + longest_recorded_line);
    write_header(device, law);
    if (flush == Flush::by_itself)
        thread_ = std::thread([this] { flush_often(); });
}

Recorder::~Recorder()
{
    try
    {
        close();
    }
    catch (...)
    {
        // close() reports errors to the caller.
    }
}

bool Recorder::add(double time, const DeviceState &state, const Vector3 &force) noexcept
{
    Entry entry{{state, force}, lost_};
    entry.tick.state.time = time;
    if (!std::isfinite(time) || time <= last_time_ || !can_be_read_back(state, force) || failed_ ||
        !buffer_.give(entry))
    {
        ++lost_;
        return false;
    }
    last_time_ = time;
    ++recorded_;
    return true;
}

void Recorder::flush()
{
    {
        const std::lock_guard<std::mutex> lock(file_mutex_);
        if (!file_.is_open())
            return;
        write_entries();
    }
    check_file();
}

void Recorder::close()
{
    {
        const std::lock_guard<std::mutex> lock(file_mutex_);
        stopping_ = true;
    }
    stop_.notify_all();
    if (thread_.joinable())
        thread_.join();
    close_file();
}

void Recorder::close_file()
{
    {
        const std::lock_guard<std::mutex> lock(file_mutex_);
        if (!file_.is_open())
            return;
        write_entries();
        append_loss(lost_);
        write_text();
        file_.close();
        failed_ = failed_ || !file_;
    }
    check_file();
}

void Recorder::write_header(const Capabilities &device, const std::string &law)
{
    std::string line = device_line_mark;
    visit_device(device, [&](auto number) { append(line, number); });
    text_ += line_of(line + ' ' + device.name);
    if (device.delay > 0)
    {
        line = delay_line_mark;
        append(line, device.delay);
        text_ += line_of(line);
    }
    if (!law.empty())
        text_ += line_of(law_line_mark + (' ' + law));
    text_ += "# t tx ty tz qx qy qz qw fx fy fz buttons vx vy vz wx wy wz\n"
             "# s, m, quaternion, N, bits, m/s, rad/s; in the device's own frame\n";
}

void Recorder::write_entries()
{
    Entry entry;
    for (const std::size_t end = recorded_; file_ && written_ != end && buffer_.receive(entry); ++written_)
    {
        append_loss(entry.lost_before);
        const std::size_t start = text_.size();
        visit_tick(entry.tick, [this](auto number) { append(text_, number); });
        text_.erase(start, 1); // the blank before the first number
        text_ += '\n';
        if (text_.size() >= most_text)
            write_text();
    }
    write_text();
}

void Recorder::append_loss(std::size_t lost)
{
    if (lost > losses_written_)
    {
        text_ += "# " + std::to_string(lost - losses_written_) +
                 " ticks are missing here: the buffer was full, or they could not have been read back\n";
        losses_written_ = lost;
    }
}

void Recorder::write_text()
{
    file_.write(text_.data(), static_cast<std::streamsize>(text_.size())).flush();
    text_.clear();
    if (file_)
        on_disk_ = written_;
    else
        failed_ = true;
}

void Recorder::check_file() const
{
    if (failed_)
        throw DeviceError(DeviceFault::failed, "recording " + name_ + ": it could not be written to its end");
}

void Recorder::flush_often()
{
    std::unique_lock<std::mutex> lock(file_mutex_);
    while (!stop_.wait_for(lock, flush_period, [this] { return stopping_; }))
        write_entries();
}
} // namespace ode_predictive_space::haptics
