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

/// Counts the instructions of some events and of the changes before them. The spaces take the difference to SpaceKind::none.
/// @param tool the program ode-predictive, which is run under callgrind. @return none when it did not get to its end.
std::optional<std::uint64_t> count_instructions(const std::string &tool, const std::string &path, SpaceKind kind,
                                                const CountedEvents &events = {});

/// Counts in the functions counted_changes, counted_collide and counted_end of a program under callgrind. None when it failed.
std::optional<std::uint64_t> instructions_of(const std::vector<std::string> &program);

/// The total in the output of callgrind; none when it has no total.
std::optional<std::uint64_t> collected(const std::string &output);
} // namespace ode_predictive_space::recording

#endif
