// Spheres and boxes that have settled in a pit.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_PILE_SCENE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_PILE_SCENE_H

#include "demos/scenes/contact_scene.h"

namespace ode_predictive_space::scenes
{
class PileScene : public ContactScene
{
public:
    static constexpr double step_seconds = 0.005;

    /// @param start one state per object; empty: a lattice above the floor, falling.
    PileScene(const SceneSpec &spec, dSpaceID space, const std::vector<BodyState> &start);

    std::vector<BodyState> states() const;

private:
    std::vector<Object> pile_;
};

SceneBounds pile_bounds(int objects);

/// Let the pile fall and come to rest.
///
/// @return the states of its bodies then.
std::vector<BodyState> settle_pile(const SceneSpec &spec);
} // namespace ode_predictive_space::scenes

#endif
