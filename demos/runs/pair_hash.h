#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_PAIR_HASH_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_PAIR_HASH_H

#include "demos/worlds/pair_list.h"

namespace ode_predictive_space::worlds
{
/// A hash of a set of pairs. It does not depend on their order, but on the number of times that each is in it.
std::uint64_t hash_pairs(const std::vector<IndexPair> &pairs);

/// A hash of successive ticks. @param hashes_of_pairs one for each tick.
std::uint64_t hash_ticks(const std::vector<std::uint64_t> &hashes_of_pairs);
} // namespace ode_predictive_space::worlds

#endif
