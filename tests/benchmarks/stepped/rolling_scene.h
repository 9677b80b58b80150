// The terrain, with objects that gravity and contacts keep on the ground.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_STEPPED_ROLLING_SCENE_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_STEPPED_ROLLING_SCENE_H

#include "demos/scenes/contact_scene.h"
#include "demos/scenes/terrain_scene.h"

#include <vector>

namespace ode_predictive_space::benchmarks
{
/// What the geoms of a scene are made of must outlive them: a base class, before the one that owns them.
struct GroundOfScene
{
    explicit GroundOfScene(int objects) : half_side(scenes::half_side_of_square(objects)), ground(half_side) {}

    double half_side; ///< of the square, metres
    scenes::TerrainGround ground;
};

/// The ground and the huge boxes of TerrainScene. Half of the objects lie on the ground, the other half fly, without gravity;
/// forces drive all of them at up to 5 m/s, each in a direction of its own, and back at the edge of the square.
class RollingScene : private GroundOfScene, public scenes::ContactScene
{
public:
    RollingScene(const scenes::SceneSpec &spec, dSpaceID space);

private:
    struct Driven
    {
        dBodyID body;
        double mass;              ///< kg
        scenes::Vector3 velocity; ///< that it is driven to, m/s
        bool flies;
    };

    void before_step() override;
    void add_huge_boxes();
    void add_driven(int number, haptics::Random &random);
    void turn_back(dBodyID body, scenes::Vector3 &velocity) const;

    std::vector<Driven> driven_;
    std::vector<dBodyID> huge_; ///< those that move
};
} // namespace ode_predictive_space::benchmarks

#endif
