#ifndef ODE_PREDICTIVE_SPACE_REPLAY_INSTRUCTIONS_H
#define ODE_PREDICTIVE_SPACE_REPLAY_INSTRUCTIONS_H

#include <cstdint>
#include <optional>
#include <string>

#include "ode_predictive_space/replay/space_kind.h"

namespace ode_predictive_space::replay
{
bool has_valgrind();

/// Of all collides, questions and notices of a recording, in spaces of one kind. This program is run again, under callgrind, with
/// the option --counted.
///
/// @return none when it did not get to its end.
std::optional<std::uint64_t> count_instructions(const std::string &path, SpaceKind kind);

/// The number that callgrind writes at its end; none when there is none.
std::optional<std::uint64_t> collected(const std::string &output);
} // namespace ode_predictive_space::replay

#endif
