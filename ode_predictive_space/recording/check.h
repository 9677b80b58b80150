#ifndef ODE_PREDICTIVE_SPACE_RECORDING_CHECK_H
#define ODE_PREDICTIVE_SPACE_RECORDING_CHECK_H

#include <string>

#include "ode_predictive_space/recording/recording.h"
#include "ode_predictive_space/recording/replay.h"

namespace ode_predictive_space::recording
{
std::string completeness_of(const Recording &recording);

/// A sentence for a recording without the notices of its first space; empty when it has them.
std::string unknown_notices(const Recording &recording);

struct Verdict
{
    bool agrees;
    std::string text;
};
Verdict compare(const Recording &recording, SpaceKind kind, const Pairs &pairs, const Pairs &expected,
                SpaceKind reference = SpaceKind::simple);

/// A sentence that compares the pairs of the reference with the recorded pairs of the program; empty without any.
std::string compared_with_program(const Recording &recording, const Pairs &expected,
                                  SpaceKind reference = SpaceKind::simple);
} // namespace ode_predictive_space::recording

#endif
