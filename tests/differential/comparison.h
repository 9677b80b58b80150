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

/// Runs a history in both spaces. After each tick and query, pairs must agree and the invariant hold; no assertion may fail.
std::optional<Failure> compare(const History &history, const Terms &terms, Tally *tally = nullptr);

/// Drops operations and shortens calms, in at most most_runs attempts, as long as the history still fails in the same way.
History shrink(const History &history, const Terms &terms, int most_runs = 2000);

/// @return after a failure of this history the difference, how to replay it, and the shrunk history; otherwise an empty text.
std::string report_of(const Profile &profile, std::uint64_t seed, const Terms &terms, Tally *tally = nullptr);
} // namespace ode_predictive_space

#endif
