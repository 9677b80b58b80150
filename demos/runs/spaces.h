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

std::string space_name(SpaceKind kind);

/// "predictive" is another name of "predictive-box". @throws std::invalid_argument when no space has this name.
SpaceKind space_named(const std::string &name);

/// The quadtree needs the bounds and the depth in advance. @throws std::runtime_error when the plugin refuses to make the space.
dSpaceID make_space(SpaceKind kind, const WorldFactory &factory);

std::unique_ptr<Contender> make_contender(SpaceKind kind, const WorldFactory &factory);

/// ODE is initialised while this object lives.
class OdeSession
{
public:
    OdeSession();
    ~OdeSession() { dCloseODE(); }
    OdeSession(const OdeSession &) = delete;
    OdeSession &operator=(const OdeSession &) = delete;
};
} // namespace ode_predictive_space::worlds

#endif
