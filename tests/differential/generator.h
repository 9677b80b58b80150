// Random histories of everything that a program can do to a scene.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_DIFFERENTIAL_GENERATOR_H
#define ODE_PREDICTIVE_SPACE_TESTS_DIFFERENTIAL_GENERATOR_H

#include <cstdint>

#include "tests/differential/operation.h"

namespace ode_predictive_space
{
/// What a history is mostly about. Each is varied further by the seed.
enum class Flavour
{
    calm,      ///< long stretches without a surprise, so that horizons grow long
    mixed,     ///< surprises now and then
    wild,      ///< surprises at every tick
    teleport,  ///< nothing stays where it was
    pile,      ///< gravity and contacts
    extreme,   ///< coordinates and velocities that are huge, tiny, infinite or not numbers
    explosion, ///< now and then much happens at once, to many
    nests,     ///< deep nests of spaces of all classes, updated in every manner
    far,       ///< as mixed, far from the origin
    last = far
};
constexpr int flavour_count = static_cast<int>(Flavour::last) + 1;
const char *flavour_name(Flavour flavour);

struct Profile
{
    Flavour flavour = Flavour::mixed;
    int geoms = 20;
    int ticks = 1000;
    bool nested_spaces = true;
};

/// The same history for the same profile and seed, on every machine.
History make_history(const Profile &profile, std::uint64_t seed);
} // namespace ode_predictive_space

#endif
