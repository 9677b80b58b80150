// The room of gas and of the worlds like it.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_GAS_ROOM_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_GAS_ROOM_H

#include "demos/worlds/world.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::worlds
{
constexpr double thin = 0.01;  ///< share of the volume that objects fill
constexpr double dense = 0.05; ///< the same

/// Half the side of a room that has no geoms, metres.
inline double half_gas_room(int objects, double volume_fraction)
{
    return std::max(half_room(objects, volume_fraction), 2 * object_radius);
}

inline std::function<Bounds(int)> gas_bounds(double volume_fraction)
{
    return [volume_fraction](int objects) { return cube(half_gas_room(objects, volume_fraction)); };
}

/// Whether an object is one of the share that moves: every k-th is, where k = 1 / share.
inline bool is_of_share(int number, double share)
{
    return std::floor((number + 1) * share) > std::floor(number * share);
}
} // namespace ode_predictive_space::worlds

#endif
