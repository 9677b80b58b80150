// The differential test: one history in two universes, and their first difference.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_DIFFERENTIAL_COMPARISON_H
#define ODE_PREDICTIVE_SPACE_TESTS_DIFFERENTIAL_COMPARISON_H

#include <cstddef>
#include <optional>
#include <string>

#include "tests/differential/generator.h"

namespace ode_predictive_space
{
enum class Measure
{
    boxes,   ///< the predictive space must report the same pairs
    spheres, ///< it may leave out pairs, but none with a contact
    shapes   ///< as above, by the shape test
};

enum class FailureKind
{
    none,
    pairs,             ///< other pairs than expected
    invariant,         ///< dPredictiveSpaceValidate() failed
    abort,             ///< an assertion of ODE with the predictive space
    abort_in_reference ///< an assertion of ODE with the simple space: the history is not legal
};

struct Failure
{
    FailureKind kind = FailureKind::none;
    std::size_t operation = 0; ///< index of the operation that failed
    std::string text;
};

/// Totals, to show that a history is not trivial.
struct Tally
{
    std::size_t ticks = 0;
    std::size_t pairs = 0;
    std::size_t left_out = 0; ///< by the sphere or the shape test
};

struct Terms
{
    Measure measure = Measure::boxes;
    bool with_invariant = true; ///< dPredictiveSpaceValidate() must succeed, too
};

/// Runs a history in a simple and in a predictive space. After every tick and query both must have reported the same pairs, and
/// the invariant must hold. ODE's assertions must not fail.
std::optional<Failure> compare(const History &history, const Terms &terms, Tally *tally = nullptr);

/// Drops operations and shortens calms as long as the history still fails in the same way.
///
/// @param most_runs the largest number of attempts.
History shrink(const History &history, const Terms &terms, int most_runs = 2000);

/// Runs the history of a profile and a seed.
///
/// @return after a failure the difference, how to replay it, and the shrunk history; otherwise an empty text.
std::string report_of(const Profile &profile, std::uint64_t seed, const Terms &terms, Tally *tally = nullptr);
} // namespace ode_predictive_space

#endif
