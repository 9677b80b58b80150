// The spaces that a world can be made in, by the names of command lines and result files.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_SPACES_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WORLDS_SPACES_H

#include "demos/worlds/world.h"

namespace ode_predictive_space::worlds
{
/// The spaces that report the same pairs: "predictive-box", "simple", "hash", "quadtree", "sap".
const std::vector<std::string> &exact_spaces();

/// These and "predictive-sphere", "predictive-shape".
const std::vector<std::string> &all_spaces();

/// The quadtree needs the bounds and the depth in advance. @param name one of all_spaces().
/// @throws std::invalid_argument for another name; std::runtime_error when the plugin refuses to make the space.
dSpaceID make_space(const std::string &name, const WorldFactory &factory);

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
