#ifndef ODE_PREDICTIVE_SPACE_RECORDING_INSTRUCTIONS_H
#define ODE_PREDICTIVE_SPACE_RECORDING_INSTRUCTIONS_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ode_predictive_space/recording/replay.h"

namespace ode_predictive_space::recording
{
bool has_valgrind();

/// Of the collides, questions and changes of some events of a recording, in spaces of one kind. What these take is the difference
/// to SpaceKind::none.
///
/// @param tool the program ode-predictive, which is run under callgrind.
/// @return none when it did not get to its end.
std::optional<std::uint64_t> count_instructions(const std::string &tool, const std::string &path, SpaceKind kind,
                                                const CountedEvents &events = {});

/// What callgrind counts in the functions counted_changes, counted_collide and counted_end of a program; none when it failed.
std::optional<std::uint64_t> instructions_of(const std::vector<std::string> &program);

/// The number that callgrind writes at its end; none when there is none.
std::optional<std::uint64_t> collected(const std::string &output);
} // namespace ode_predictive_space::recording

#endif
