#ifndef ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_PAIRS_H
#define ODE_PREDICTIVE_SPACE_TESTS_BROADPHASE_SUPPORT_PAIRS_H

#include <algorithm>
#include <utility>
#include <vector>

#include "ode_predictive_space/broadphase/base/ids.h"

namespace ode_predictive_space
{
using Pairs = std::vector<std::pair<ProxyId, ProxyId>>;

/// The pairs with their smaller number first, in ascending order. Duplicates stay.
template <typename Source> Pairs sorted_pairs(const Source &source)
{
    Pairs pairs;
    for (const auto &pair : source)
        pairs.emplace_back(std::min(pair.first, pair.second), std::max(pair.first, pair.second));
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}
} // namespace ode_predictive_space

#endif
