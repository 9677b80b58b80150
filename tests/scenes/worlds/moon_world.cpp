// Small objects on a sphere as large as the moon.

#include "demos/scenes/world_scene.h"
#include "tests/scenes/worlds/makers.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double moon_step = 0.005;
constexpr double moon_radius = 1.7e6;   // metres
constexpr double moon_gravity = 1.62;   // m/s^2
constexpr double fastest_in_moon = 0.5; // m/s

double half_side_of_moon(int objects)
{
    return 0.5 * std::sqrt(objects) + 1;
}

class MoonWorld : public WorldScene
{
public:
    MoonWorld(const SceneSpec &spec, dSpaceID space) : WorldScene(spec, space, moon_step)
    {
        dWorldSetGravity(objects_.world(), 0, 0, -moon_gravity);
        set_position(objects_.add_geom(dCreateSphere(space, moon_radius)), {0, 0, -moon_radius});
        const double half = half_side_of_moon(spec.objects);
        for (int i = 0; i < spec.objects; ++i)
        {
            BodyState state;
            state.position = random_.in_box({half, half, 0.2}) + Vector3(0, 0, 0.4);
            state.velocity = random_.in_box({fastest_in_moon, fastest_in_moon, 0});
            add_body(objects_, i % 2 == 0 ? dCreateSphere(space, 0.1) : dCreateBox(space, 0.2, 0.2, 0.2), 1, state);
        }
    }
};
} // namespace

SceneRecipe moon_world(const SceneSpec &spec)
{
    const double half = half_side_of_moon(spec.objects);
    return {[](const SceneSpec &made, dSpaceID space) { return std::make_unique<MoonWorld>(made, space); },
            {Vector3::Zero(), {half, half, 2}},
            moon_step};
}
} // namespace ode_predictive_space::scenes
