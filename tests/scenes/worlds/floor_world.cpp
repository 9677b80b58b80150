// Bodies that roll and lie on a plane.

#include "demos/scenes/world_scene.h"
#include "tests/scenes/worlds/makers.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double floor_step = 0.004;
constexpr double half_height_of_floor = 0.15; // metres, of a body
constexpr double fastest_in_floor = 0.5;      // m/s

double half_side_of_floor(int objects)
{
    return 0.6 * std::sqrt(objects) + 2;
}

class FloorWorld : public WorldScene
{
public:
    FloorWorld(const SceneSpec &spec, dSpaceID space, double variation) : WorldScene(spec, space, floor_step)
    {
        vary_steps(variation);
        objects_.add_geom(dCreatePlane(space, 0, 0, 1, 0));
        for (int i = 0; i < spec.objects; ++i)
        {
            BodyState state;
            state.position = random_.in_box({half_side_of_floor(spec.objects), half_side_of_floor(spec.objects), 0});
            state.position.z() = half_height_of_floor + 0.01;
            state.velocity = random_.in_box({fastest_in_floor, fastest_in_floor, 0});
            add_body(objects_,
                     i % 2 == 0 ? dCreateSphere(space, half_height_of_floor) : dCreateBox(space, 0.25, 0.25, 0.3), 1,
                     state);
        }
    }
};
} // namespace

SceneRecipe floor_world(const SceneSpec &spec, double variation)
{
    const double half = half_side_of_floor(spec.objects);
    return {[variation](const SceneSpec &made, dSpaceID space) {
                return std::make_unique<FloorWorld>(made, space, variation);
            },
            {Vector3::Zero(), {half, half, 1}},
            floor_step};
}
} // namespace ode_predictive_space::scenes
