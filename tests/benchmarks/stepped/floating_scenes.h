// Objects that float through a room without gravity, pushed by contacts.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_STEPPED_FLOATING_SCENES_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_STEPPED_FLOATING_SCENES_H

#include "demos/scenes/contact_scene.h"

#include <vector>

namespace ode_predictive_space::benchmarks
{
struct FloatingSettings
{
    double moving = 0.5;  ///< share of the objects
    double max_speed = 1; ///< m/s
    int shapes = 3;       ///< the objects have the first so many shapes
};

/// Objects that bounce off one another and turn back at the sides of a room that has no geoms. They begin in random places, with
/// speeds up to a limit. Those that do not move have no body.
class FloatingScene : public scenes::ContactScene
{
public:
    /// @param spec of gas, game, classes or teleport: the room is as large as there.
    FloatingScene(const scenes::SceneSpec &spec, dSpaceID space, const FloatingSettings &settings);

protected:
    void before_step() override;

    double half_; ///< half the side of the cube in which the centres stay, metres
    haptics::Random random_;
    std::vector<scenes::Object> floaters_;
};

/// All objects jump to a random place after each step, and come to a stop there.
class JumpingScene : public FloatingScene
{
public:
    JumpingScene(const scenes::SceneSpec &spec, dSpaceID space);
    void advance() override;
};

/// A physics engine that has a world of its own and uses ODE to find contacts, as DART does: its geoms have no bodies in ODE, and
/// at every tick it sets every pose, though one object in twenty moves.
class PoseSettingScene : public scenes::ContactScene
{
public:
    PoseSettingScene(const scenes::SceneSpec &spec, dSpaceID space);
    void advance() override;

private:
    void before_step() override;

    struct Posed
    {
        dGeomID geom;
        dBodyID body; ///< in the engine's world; null for what does not move
        scenes::BodyState state;
    };

    double half_;
    std::vector<Posed> posed_;
};
} // namespace ode_predictive_space::benchmarks

#endif
