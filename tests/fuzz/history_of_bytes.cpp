#include "tests/fuzz/history_of_bytes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/contract/support/geom_zoo.h"

namespace ode_predictive_space
{
namespace
{
constexpr std::size_t bytes_per_operation = 8, most_operations = 200;
constexpr int geoms = 256, bodies = 8, spaces = 4;

// First bytes from these on stand for many operations: trees and sweeps need more objects than there are bytes for.
constexpr std::uint8_t first_jumping = 240, first_crowd = 248;
constexpr int most_crowds = 3;

// Bits of the first byte, beside the measure.
constexpr int with_contacts = 4, with_gravity = 8, with_sleep = 16, with_extremes = 32;

double coordinate(std::uint8_t byte)
{
    return (byte - 123) / 16.0; // up to 8, exact
}

// The last bytes stand for numbers that break careless programs.
double extreme_coordinate(std::uint8_t byte)
{
    constexpr double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    static const double extremes[] = {nan, inf, -inf, 1e12, -1e12, 1e39, -1e300, 5e-324, -0.0};
    constexpr int first = 256 - static_cast<int>(std::size(extremes));
    return byte < first ? coordinate(byte) : extremes[byte - first];
}

int reference(std::uint8_t byte)
{
    return byte < 240 ? byte : space_reference(byte % spaces);
}

class Decoder
{
public:
    explicit Decoder(std::uint8_t settings)
        : measure_(static_cast<Measure>(settings % 4 % 3)),
          extremes_(measure_ == Measure::boxes && (settings & with_extremes) != 0)
    {}

    Measure measure() const { return measure_; }

    void append(const std::uint8_t *bytes, std::vector<Operation> &operations)
    {
        if (bytes[0] < first_jumping)
            operations.push_back(operation(bytes));
        else if (bytes[0] < first_crowd)
            append_jumps(bytes, operations);
        else if (crowds_++ < most_crowds)
            append_crowd(bytes, operations);
    }

private:
    void append_crowd(const std::uint8_t *bytes, std::vector<Operation> &operations) const
    {
        const int count = bytes[3] % 200, every = 1 + bytes[2] % 16;
        const double distance = (bytes[4] + 16) / 64.0;
        for (int i = 0; i < count; ++i)
        {
            const int slot = (bytes[1] + i) % geoms;
            Operation made;
            made.action = Action::make_geom;
            made.subject = slot;
            made.object = 0;
            made.number = i % 2;
            made.value = {0.5 + (i % 3) / 8.0, distance * (i % 8), distance * (i / 8 % 8), distance * (i / 64)};
            operations.push_back(made);
            made.action = Action::drive;
            made.number = i % every == 0 ? 1 + i / every % 3 : 0;
            made.value = {coordinate(bytes[5]) / 16, coordinate(bytes[6]) / 16, coordinate(bytes[7]) / 16, 0};
            operations.push_back(made);
        }
    }

    void append_jumps(const std::uint8_t *bytes, std::vector<Operation> &operations) const
    {
        const int count = bytes[3] % 200;
        for (int i = 0; i < count; ++i)
        {
            Operation made;
            made.action = Action::move_geom;
            made.subject = (bytes[1] + i) % geoms;
            for (std::size_t axis = 0; axis < 3; ++axis)
                made.value[axis] = coordinate(static_cast<std::uint8_t>(bytes[4 + axis] + 37 * i * (bytes[7] | 1)));
            operations.push_back(made);
            made.action = Action::drive;
            made.number = bytes[2] % 4;
            for (double &value : made.value)
                value /= 32;
            operations.push_back(made);
        }
    }

    Operation operation(const std::uint8_t *bytes) const
    {
        Operation made;
        made.action = action(bytes[0]);
        made.subject = bytes[1] % geoms;
        made.object = bytes[2] % geoms;
        made.number = bytes[3];
        for (std::size_t i = 0; i < made.value.size(); ++i)
            made.value[i] = coordinate(bytes[4 + i]);
        fit(made, bytes);
        return made;
    }

    // Newer actions have the last bytes, so that older inputs keep their meaning.
    static Action action(std::uint8_t byte)
    {
        constexpr int first_ones = static_cast<int>(Action::distort_geom), repeated = 252 / first_ones * first_ones;
        if (byte < repeated)
            return static_cast<Action>(byte % first_ones);
        return static_cast<Action>(first_ones + byte % (static_cast<int>(Action::last) + 1 - first_ones));
    }

    void fit(Operation &made, const std::uint8_t *bytes) const
    {
        switch (made.action)
        {
        case Action::make_geom:
            made.object = bytes[2] % 16 == 15 ? -1 : measure_ == Measure::boxes ? bytes[2] % spaces : 0;
            made.number %= geom_kind_count;
            made.value[0] = (bytes[4] + 1) / 64.0;
            break;
        case Action::make_body:
            made.subject %= bodies;
            made.number %= 3;
            break;
        case Action::destroy_body:
        case Action::turn_body:
        case Action::distort_body:
        case Action::force:
            made.subject %= bodies;
            break;
        case Action::enable_body:
        case Action::kinematic:
            made.subject %= bodies;
            made.number %= 2;
            break;
        case Action::attach:
            made.object = bytes[2] % 8 == 7 ? -1 : bytes[2] % bodies;
            break;
        case Action::move_geom:
            take_extremes(made, bytes);
            break;
        case Action::move_body:
        case Action::velocity:
            made.subject %= bodies;
            take_extremes(made, bytes);
            break;
        case Action::resize:
        case Action::change_in_place:
            made.value[0] = bytes[4] / 64.0;
            break;
        case Action::enable_geom:
        case Action::role:
            made.number %= 2;
            break;
        case Action::bits:
            made.subject = reference(bytes[1]);
            made.number = bytes[3] + 256 * bytes[4];
            break;
        case Action::drive:
            made.number %= 4;
            for (double &value : made.value)
                value /= 16;
            break;
        default:
            fit_to_spaces(made, bytes);
        }
    }

    void fit_to_spaces(Operation &made, const std::uint8_t *bytes) const
    {
        switch (made.action)
        {
        case Action::take_out:
        case Action::put_in:
        case Action::ask_bounds:
            made.subject = reference(bytes[1]);
            made.object %= spaces;
            break;
        case Action::make_space:
            // The other tests of proximity would leave out pairs of spaces.
            made.subject = measure_ == Measure::boxes ? made.subject % spaces : 0;
            made.object = bytes[2] % 8 == 7 ? -1 : bytes[2] % spaces;
            made.number = bytes[3] % 3 + 16 * (bytes[3] / 128);
            break;
        case Action::destroy_space:
        case Action::clean:
            made.subject %= spaces;
            break;
        case Action::deviation:
            made.subject %= spaces;
            made.number %= 2;
            for (double &value : made.value)
                value = std::fabs(value) / 64;
            break;
        case Action::horizon:
            made.subject %= spaces;
            made.number = 1 + bytes[3] % 20;
            made.object = made.number + 16 * bytes[2];
            break;
        case Action::step:
            made.value[0] = (bytes[4] + 1) / 2048.0;
            break;
        case Action::calm:
            made.object %= 3;
            made.number = 1 + bytes[3] % 24;
            made.value[0] = (bytes[4] + 1) / 2048.0;
            break;
        case Action::shape_margin:
            made.subject %= spaces;
            made.value[0] = bytes[4] / 256.0;
            break;
        case Action::ask_times:
            made.number %= 16;
            break;
        case Action::tick_throwing_bounds:
            made.number %= 32;
            break;
        case Action::query:
        case Action::query_broken_off:
        case Action::query_throwing_bounds:
            made.subject = reference(bytes[1]);
            made.object = reference(bytes[2]);
            made.number %= 8;
            break;
        default:
            break;
        }
    }

    void take_extremes(Operation &made, const std::uint8_t *bytes) const
    {
        if (extremes_)
            for (std::size_t i = 0; i < 3; ++i)
                made.value[i] = extreme_coordinate(bytes[4 + i]);
    }

    Measure measure_;
    bool extremes_;
    int crowds_ = 0;
};
} // namespace

FuzzedRun run_of_bytes(const std::uint8_t *data, std::size_t size)
{
    FuzzedRun run;
    if (size == 0)
        return run;
    const int settings = data[0];
    Decoder decoder(data[0]);
    run.terms.measure = decoder.measure();
    run.history.contacts = (settings & with_contacts) != 0;
    run.history.gravity = (settings & with_gravity) != 0 ? 9.81 : 0;
    run.history.auto_disable = (settings & with_sleep) != 0;
    const std::size_t count = std::min((size - 1) / bytes_per_operation, most_operations);
    for (std::size_t i = 0; i < count; ++i)
        decoder.append(data + 1 + i * bytes_per_operation, run.history.operations);
    run.history.operations.push_back({}); // a tick
    return run;
}
} // namespace ode_predictive_space
