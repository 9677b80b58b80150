#ifndef ODE_PREDICTIVE_SPACE_RECORDING_RECORD_CURSOR_H
#define ODE_PREDICTIVE_SPACE_RECORDING_RECORD_CURSOR_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "ode_predictive_space/recording/recording.h"

namespace ode_predictive_space::recording
{
/// Takes values from a record one after another; never more than it has.
class RecordCursor
{
public:
    RecordCursor(const std::vector<char> &bytes, const Record &record)
        : next_(bytes.data() + record.content), left_(record.size), begin_(record.begin())
    {}

    [[noreturn]] void refuse(const std::string &what) const { throw BadRecording(begin_, what); }

    template <typename Value> void take(Value &value)
    {
        static_assert(std::is_trivially_copyable_v<Value>);
        std::memcpy(&value, take_bytes(sizeof value), sizeof value);
    }

    template <typename Value> Value take()
    {
        Value value;
        take(value);
        return value;
    }

    void take_to(void *place, std::size_t size) { std::memcpy(place, take_bytes(size), size); }

    /// Allocates memory only when the record has as many values.
    template <typename Value> void take_all(std::vector<Value> &values, std::uint64_t count)
    {
        const char *const bytes = take_bytes(count * sizeof(Value));
        values.resize(static_cast<std::size_t>(count));
        if (count > 0)
            std::memcpy(values.data(), bytes, values.size() * sizeof(Value));
    }

    const char *take_bytes(std::uint64_t size)
    {
        if (size > left_)
            refuse("the record is too short for its content");
        left_ -= static_cast<std::size_t>(size);
        return std::exchange(next_, next_ + size);
    }

    void expect_end() const
    {
        if (left_ != 0)
            refuse("the record is too long for its content");
    }

private:
    const char *next_;
    std::size_t left_;
    std::size_t begin_;
};
} // namespace ode_predictive_space::recording

#endif
