#ifndef ODE_PREDICTIVE_SPACE_RECORDING_CHECK_H
#define ODE_PREDICTIVE_SPACE_RECORDING_CHECK_H

#include <string>

#include "ode_predictive_space/recording/recording.h"
#include "ode_predictive_space/recording/replay.h"

namespace ode_predictive_space::recording
{
/// A sentence: the recording is whole, cut at an event, or nothing.
std::string completeness_of(const Recording &recording);

/// How the pairs of one kind of spaces agree with those of another one.
struct Verdict
{
    bool agrees;
    std::string text;
};
Verdict compare(const Recording &recording, SpaceKind kind, const Pairs &pairs, const Pairs &expected,
                SpaceKind reference = SpaceKind::simple);

/// How those of the other one agree with what the program got; empty when there is nothing to compare.
std::string compared_with_program(const Recording &recording, const Pairs &expected,
                                  SpaceKind reference = SpaceKind::simple);
} // namespace ode_predictive_space::recording

#endif
