#ifndef ODE_PREDICTIVE_SPACE_RECORDING_SPACE_KIND_H
#define ODE_PREDICTIVE_SPACE_RECORDING_SPACE_KIND_H

#include <array>
#include <optional>
#include <string>

#include "ode_predictive_space/recording/state.h"

namespace ode_predictive_space::recording
{
/// The spaces of a replay. Simple spaces inside other spaces remain simple, as with the launcher.
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
    none ///< simple ones that are never collided: the cost of the changes alone
};

constexpr std::array<SpaceKind, 8> all_kinds = {SpaceKind::own,      SpaceKind::simple, SpaceKind::hash,
                                                SpaceKind::quadtree, SpaceKind::sap,    SpaceKind::box,
                                                SpaceKind::sphere,   SpaceKind::shape};

const char *name_of(SpaceKind kind);

SpaceKind predictive_kind(int proximity); ///< dPredictiveProximityBox, ...

SpaceKind own_kind(const GeomState &space);

/// The kind that it had while it was recorded: predictive also where it stood in the place of one of ODE's.
SpaceKind recorded_kind(const GeomState &space);

bool is_predictive(SpaceKind kind);

std::string full_name_of(SpaceKind kind); ///< "hash", or "predictive, by box"

std::optional<SpaceKind> kind_named(const std::string &name);

bool leaves_out_pairs(SpaceKind kind);
} // namespace ode_predictive_space::recording

#endif
