// Any bytes as a history of contacts.

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
    breathe, ///< a sphere: smaller, and then larger at each tick until it is as it was
    wobble,  ///< both geoms about their places, with a forecast before each tick
    turn,    ///< to any rotation
    skew,    ///< to a quaternion of any length
    offset,  ///< from its body
    drive,   ///< its body
    steps,   ///< of the world, a tick after each
    release, ///< from its body
    resize,
    change_in_place,
    rebuild_in_place,
    last = rebuild_in_place
};

constexpr std::size_t bytes_per_contact_operation = 8;

/// One byte of settings, then eight bytes for each operation: action, subject, object, number and four values. What is behind the
/// 200th is ignored. All bytes mean something.
///
/// @return what is wrong, and where; an empty text when nothing is.
std::string run_contact_history(const std::uint8_t *data, std::size_t size, ContactTally &tally);

/// Drops operations as long as something is wrong. @return the operations that are left, with what is wrong; an empty text when
/// nothing is.
std::string report_of_contact_history(const std::uint8_t *data, std::size_t size);
} // namespace ode_predictive_space

#endif
