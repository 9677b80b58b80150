#include "demos/scenes/flyer.h"

#include "demos/scenes/world_scene.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double fastest_flyer = 3; // m/s
} // namespace

void let_fly(dWorldID world, dSurfaceParameters &surface)
{
    dWorldSetGravity(world, 0, 0, 0);
    surface.mode = dContactApprox1 | dContactBounce;
    surface.mu = 0;
    surface.bounce = 1;
}

dBodyID add_flyer(SceneObjects &objects, int number, const FlyerSize &size, const Vector3 &place,
                  haptics::Random &random)
{
    BodyState state;
    state.position = place;
    state.velocity = random.uniform(0, fastest_flyer) * random.direction();
    state.angular_velocity = random.uniform(0, 2) * random.direction();
    const dGeomID geom = number % 2 == 0 ? dCreateBox(objects.space(), size.box.x(), size.box.y(), size.box.z())
                                         : dCreateSphere(objects.space(), size.radius);
    return add_body(objects, geom, 1, state);
}
} // namespace ode_predictive_space::scenes
