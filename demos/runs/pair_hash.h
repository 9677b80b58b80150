#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_PAIR_HASH_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_PAIR_HASH_H

#include "demos/worlds/pair_list.h"

namespace ode_predictive_space::worlds
{
/// A hash of a set of pairs. It does not depend on their order, but on the number of times that each is in it.
std::uint64_t hash_pairs(const std::vector<IndexPair> &pairs);

class PairHash
{
public:
    void add_tick(std::uint64_t hash_of_pairs);
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0;
};
} // namespace ode_predictive_space::worlds

#endif
