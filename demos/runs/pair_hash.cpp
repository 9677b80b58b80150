#include "demos/runs/pair_hash.h"

#include "ode_predictive_space/haptics/device/random.h"

namespace ode_predictive_space::worlds
{
// A sum, not an exclusive or: a pair that is reported twice must not cancel itself.
std::uint64_t hash_pairs(const std::vector<IndexPair> &pairs)
{
    std::uint64_t sum = 0;
    for (const auto &[first, second] : pairs)
        sum += haptics::mix_bits((std::uint64_t{first} << 32 | second) + 0x9e3779b97f4a7c15u);
    return sum;
}

void PairHash::add_tick(std::uint64_t hash_of_pairs)
{
    value_ = haptics::mix_bits(value_ + 0x9e3779b97f4a7c15u) ^ hash_of_pairs;
}
} // namespace ode_predictive_space::worlds
