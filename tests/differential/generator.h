// Random histories of everything that a program can do to a scene.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_DIFFERENTIAL_GENERATOR_H
#define ODE_PREDICTIVE_SPACE_TESTS_DIFFERENTIAL_GENERATOR_H

#include <cstdint>

#include "tests/differential/operation.h"

namespace ode_predictive_space
{
/// The main content of a history. The seed varies it further.
enum class Flavour
{
    calm,      ///< long stretches without a surprise, so that horizons grow long
    mixed,     ///< occasional surprises
    wild,      ///< surprises at every tick
    teleport,  ///< leaps of all objects
    pile,      ///< gravity and contacts
    extreme,   ///< coordinates and velocities that are huge, tiny, infinite or not numbers
    explosion, ///< much happens at once, to many, now and then
    nests,     ///< deep nests of spaces of all classes, updated in all manners
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

/// The history depends on the profile and the seed only, not on the machine.
History make_history(const Profile &profile, std::uint64_t seed);
} // namespace ode_predictive_space

#endif
