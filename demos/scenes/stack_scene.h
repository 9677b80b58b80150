// Walls and towers of boxes that sleep until a heavy ball hits them.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_SCENES_STACK_SCENE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_SCENES_STACK_SCENE_H

#include "demos/scenes/contact_scene.h"

namespace ode_predictive_space::scenes
{
/// Walls and towers alternate on the floor of a closed room. The world disables bodies at rest. Every two seconds the ball
/// is thrown again, at a wall or tower chosen at random: some boxes fly, most of them stay asleep. The ball is
/// the geom after the walls of the room and before the boxes.
class StackScene : public ContactScene
{
public:
    static constexpr double step_seconds = 0.005;
    static constexpr int ticks_between_throws = 400;
    static constexpr int first_throw = 90; ///< the tick; until then the boxes have time to fall asleep

    StackScene(const SceneSpec &spec, dSpaceID space);

private:
    void before_step() override;
    void build(int boxes);
    void throw_ball();

    double half_side_; ///< of the floor, metres
    int structures_;
    haptics::Random random_;
    Object ball_;
    int tick_ = 0;
};

SceneBounds stack_bounds(int objects);
} // namespace ode_predictive_space::scenes

#endif
