// The spaces that are compared: the predictive one and ODE's own.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_RUNS_SPACES_H
#define ODE_PREDICTIVE_SPACE_DEMOS_RUNS_SPACES_H

#include "demos/runs/contender.h"
#include "demos/worlds/world.h"

#include <string>
#include <vector>

namespace ode_predictive_space::worlds
{
enum class SpaceKind
{
    predictive,
    predictive_by_spheres,
    predictive_by_shapes,
    simple,
    hash,
    quadtree,
    sweep_and_prune
};

/// The kinds that report the same pairs: all but predictive_by_spheres and predictive_by_shapes.
const std::vector<SpaceKind> &all_spaces();

bool is_predictive(SpaceKind kind);

/// Its name on command lines and in result files.
std::string space_name(SpaceKind kind);

/// The kind of this name; "predictive" is another name of "predictive-box".
///
/// @throws std::invalid_argument when no space has this name.
SpaceKind space_named(const std::string &name);

/// A new space for the scene. (The quadtree needs the bounds and the depth in advance.)
///
/// @throws std::runtime_error when ODE refuses to make it.
dSpaceID make_space(SpaceKind kind, const WorldFactory &factory);

/// Makes a contender with such a space.
std::unique_ptr<Contender> make_contender(SpaceKind kind, const WorldFactory &factory);

/// An existing space as a contender of this kind.
std::unique_ptr<Contender> make_contender(SpaceKind kind, OwnedSpace space);

/// ODE is initialised while this object lives.
class OdeSession
{
public:
    OdeSession();
    ~OdeSession();
    OdeSession(const OdeSession &) = delete;
    OdeSession &operator=(const OdeSession &) = delete;
};
} // namespace ode_predictive_space::worlds

#endif
