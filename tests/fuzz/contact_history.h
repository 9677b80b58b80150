#ifndef ODE_PREDICTIVE_SPACE_TESTS_FUZZ_CONTACT_HISTORY_H
#define ODE_PREDICTIVE_SPACE_TESTS_FUZZ_CONTACT_HISTORY_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/fuzz/contact_world.h"

namespace ode_predictive_space
{
/// The first byte of an operation, modulo their number.
enum class ContactAction : std::uint8_t
{
    make,
    destroy,
    place,
    place_beside,
    creep,   ///< small moves, a tick each
    spin,    ///< small turns, a tick each
    breathe, ///< a sphere shrinks, and then grows at each tick until it has its old size
    wobble,  ///< moves of both geoms about their places, with a forecast before each tick
    turn,    ///< to any rotation
    skew,    ///< to a quaternion of any length
    offset,  ///< an offset from its body
    drive,   ///< velocities for its body
    steps,   ///< steps of the world, each with a tick
    release, ///< loss of its body
    resize,
    change_in_place,
    rebuild_in_place,
    last = rebuild_in_place
};

constexpr std::size_t bytes_per_contact_operation = 8;

/// One byte of settings, then eight bytes for each operation: action, subject, object, number and four values. Operations after
/// the 200th are ignored. All bytes are valid. @return what is wrong, and where, or an empty text.
std::string run_contact_history(const std::uint8_t *data, std::size_t size, ContactTally &tally);

/// Drops operations as long as something is wrong. @return the remaining operations, with what is wrong, or an empty text.
std::string report_of_contact_history(const std::uint8_t *data, std::size_t size);
} // namespace ode_predictive_space

#endif
