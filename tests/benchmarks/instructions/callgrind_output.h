// What callgrind writes.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_CALLGRIND_OUTPUT_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_INSTRUCTIONS_CALLGRIND_OUTPUT_H

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

namespace ode_predictive_space::benchmarks
{
/// What calls have cost. Misses are 0 unless callgrind simulated caches.
struct Costs
{
    std::uint64_t instructions = 0;
    std::uint64_t first_level_misses = 0; ///< of data
    std::uint64_t last_level_misses = 0;  ///< of data
};

/// Of all calls of a function, with all that it called; none when there was no call.
///
/// @param dump written with --compress-strings=no --compress-pos=no.
/// @throws std::runtime_error when it counts anything but instructions and, with --cache-sim=yes, accesses and misses.
std::optional<Costs> costs_of_any_calls(std::istream &dump, const std::string &function);

/// The same of a function that has been called.
///
/// @throws std::runtime_error when there was no call, too.
Costs costs_of_calls(std::istream &dump, const std::string &function);
} // namespace ode_predictive_space::benchmarks

#endif
