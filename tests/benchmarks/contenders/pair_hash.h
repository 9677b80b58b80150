#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_PAIR_HASH_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_PAIR_HASH_H

#include "demos/worlds/pair_list.h"
#include "ode_predictive_space/haptics/device/random.h"

namespace ode_predictive_space::benchmarks
{
constexpr std::uint64_t golden = 0x9e3779b97f4a7c15u; // 2^64 by the golden ratio

/// A hash of a set of pairs. It does not depend on their order, but on the number of times that each is in it: a sum, not an
/// exclusive or, so that a pair that is reported twice does not cancel itself.
inline std::uint64_t hash_pairs(const std::vector<worlds::IndexPair> &pairs)
{
    std::uint64_t sum = 0;
    for (const auto &[first, second] : pairs)
        sum += haptics::mix_bits((std::uint64_t{first} << 32 | second) + golden);
    return sum;
}

/// A hash of successive ticks. @param hashes_of_pairs one for each tick.
inline std::uint64_t hash_ticks(const std::vector<std::uint64_t> &hashes_of_pairs)
{
    std::uint64_t value = 0;
    for (const std::uint64_t hash : hashes_of_pairs)
        value = haptics::mix_bits(value + golden) ^ hash;
    return value;
}
} // namespace ode_predictive_space::benchmarks

#endif
