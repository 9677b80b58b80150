// The spaces that the recorded program had.

#ifndef ODE_PREDICTIVE_SPACE_RECORDING_OWN_SPACE_H
#define ODE_PREDICTIVE_SPACE_RECORDING_OWN_SPACE_H

#include <string>

#include "ode_predictive_space/recording/recording.h"
#include "ode_predictive_space/recording/space_kind.h"

namespace ode_predictive_space::recording
{
/// The kind of the space that is collided first, as the program made it.
SpaceKind kind_of_own_space(const Recording &recording);

/// The kind that it had while it was recorded: predictive also where it stood in the place of one of ODE's.
SpaceKind kind_of_recorded_space(const Recording &recording);

/// The first of these in words: "hash", or "predictive, by box" where the program made a predictive one.
std::string name_of_own_space(const Recording &recording);

/// A sentence for a recording without the notices of that space; empty when it has them.
std::string unknown_notices(const Recording &recording);
} // namespace ode_predictive_space::recording

#endif
