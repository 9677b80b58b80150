#include "demos/runs/pair_hash.h"

#include "ode_predictive_space/haptics/device/random.h"

namespace ode_predictive_space::worlds
{
namespace
{
constexpr std::uint64_t golden = 0x9e3779b97f4a7c15u; // 2^64 by the golden ratio
} // namespace

// A sum, not an exclusive or: a pair that is reported twice must not cancel itself.
std::uint64_t hash_pairs(const std::vector<IndexPair> &pairs)
{
    std::uint64_t sum = 0;
    for (const auto &[first, second] : pairs)
        sum += haptics::mix_bits((std::uint64_t{first} << 32 | second) + golden);
    return sum;
}

std::uint64_t hash_ticks(const std::vector<std::uint64_t> &hashes_of_pairs)
{
    std::uint64_t value = 0;
    for (const std::uint64_t hash : hashes_of_pairs)
        value = haptics::mix_bits(value + golden) ^ hash;
    return value;
}
} // namespace ode_predictive_space::worlds
