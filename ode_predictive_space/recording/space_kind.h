#ifndef ODE_PREDICTIVE_SPACE_RECORDING_SPACE_KIND_H
#define ODE_PREDICTIVE_SPACE_RECORDING_SPACE_KIND_H

#include <array>
#include <optional>
#include <string>

#include "ode_predictive_space/recording/state.h"

namespace ode_predictive_space::recording
{
/// In which spaces a history is replayed. Spaces that were simple ones within others remain so, as with the launcher.
enum class SpaceKind
{
    own, ///< of the class that each had in the program
    simple,
    hash,
    quadtree,
    sap,
    box, ///< predictive, by boxes
    sphere,
    shape,
    none ///< simple ones that are never asked: what remains is what the changes cost without a space
};

constexpr std::array<SpaceKind, 8> all_kinds = {SpaceKind::own,      SpaceKind::simple, SpaceKind::hash,
                                                SpaceKind::quadtree, SpaceKind::sap,    SpaceKind::box,
                                                SpaceKind::sphere,   SpaceKind::shape};

const char *name_of(SpaceKind kind);

/// @param proximity dPredictiveProximityBox, ...
SpaceKind predictive_kind(int proximity);

/// The kind of a recorded space, as the program made it.
SpaceKind own_kind(const GeomState &space);

std::optional<SpaceKind> kind_named(const std::string &name);

/// Calls the callback for fewer pairs than the others.
bool leaves_out_pairs(SpaceKind kind);
} // namespace ode_predictive_space::recording

#endif
