// Ragdolls that fall on stairs.

#include "demos/scenes/world_scene.h"
#include "tests/scenes/worlds/makers.h"
#include "tests/scenes/worlds/ragdoll.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double ragdolls_step = 0.005;
constexpr int steps = 12;
constexpr double depth = 0.6;       // of a step, metres
constexpr double rise = 0.25;       // of a step, metres
constexpr double half_width = 5;    // of the stairs, metres
constexpr int side_by_side = 5;     // ragdolls
constexpr double space_for_one = 2; // metres

class RagdollsWorld : public WorldScene
{
public:
    RagdollsWorld(const SceneSpec &spec, dSpaceID space) : WorldScene(spec, space, ragdolls_step)
    {
        objects_.add_geom(dCreatePlane(space, 0, 0, 1, 0));
        for (int step = 0; step < steps; ++step)
        {
            const double height = rise * (step + 1);
            const dGeomID geom = add_scenery(objects_, dCreateBox(space, depth, 2 * half_width, height));
            set_position(geom, {depth * step, 0, height / 2});
        }
        for (int i = 0; i < spec.objects; ++i)
        {
            const double side = space_for_one * (i % side_by_side - 0.5 * (side_by_side - 1));
            const double up = space_for_one * static_cast<double>(i / side_by_side);
            const Quaternion turn(Eigen::AngleAxisd(random_.uniform(-pi, pi), random_.direction()));
            add_ragdoll(objects_, Vector3(depth * steps * random_.unit(), side, rise * steps + 1.5 + up), turn);
        }
    }
};
} // namespace

SceneRecipe ragdolls_world(const SceneSpec &)
{
    return {[](const SceneSpec &made, dSpaceID space) { return std::make_unique<RagdollsWorld>(made, space); },
            {{depth * steps / 2, 0, 5}, {depth * steps, 2 * half_width, 10}},
            ragdolls_step};
}
} // namespace ode_predictive_space::scenes
