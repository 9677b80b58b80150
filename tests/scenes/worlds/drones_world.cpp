// Free bodies that fly in a room with pillars, which is one mesh.

#include "tests/scenes/worlds/box_mesh.h"
#include "tests/scenes/worlds/makers.h"
#include "tests/scenes/worlds/world_scene.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double drones_step = 0.005;
constexpr double half_height_of_drones = 3; // metres
constexpr double half_pillar = 0.3;         // metres
constexpr int pillars = 4;                  // along each side
constexpr double fastest_in_drones = 3;     // m/s

double half_side_of_drones(int drones)
{
    return 0.5 * std::sqrt(drones) + 2;
}

struct Building
{
    BoxMesh mesh;
};

class DronesWorld : private Building, public WorldScene
{
public:
    DronesWorld(const SceneSpec &spec, dSpaceID space) : WorldScene(spec, space, drones_step)
    {
        dWorldSetGravity(objects_.world(), 0, 0, 0);
        surface_.mode = dContactApprox1 | dContactBounce;
        surface_.mu = 0;
        surface_.bounce = 1;
        const double half = half_side_of_drones(spec.objects);
        mesh.add_room({half, half, half_height_of_drones}, true);
        for (int i = 0; i < pillars * pillars; ++i)
        {
            mesh.add(place_of_pillar(i, half), {half_pillar, half_pillar, half_height_of_drones});
        }
        add_scenery(objects_, mesh.make_geom(space));
        for (int i = 0; i < spec.objects; ++i)
        {
            add_drone(i, half);
        }
    }

private:
    static Vector3 place_of_pillar(int number, double half)
    {
        const double distance = 2 * half / pillars;
        return {distance * (number % pillars + 0.5) - half, distance * (number / pillars + 0.5) - half, 0};
    }

    static bool is_free(const Vector3 &place, double half)
    {
        for (int i = 0; i < pillars * pillars; ++i)
        {
            const Vector3 way = place - place_of_pillar(i, half);
            if (std::max(std::abs(way.x()), std::abs(way.y())) < half_pillar + 0.3)
            {
                return false;
            }
        }
        return true;
    }

    void add_drone(int number, double half)
    {
        BodyState state;
        do
        {
            state.position = random_.in_box({half - 0.5, half - 0.5, half_height_of_drones - 0.5});
        } while (!is_free(state.position, half));
        state.velocity = random_.uniform(0, fastest_in_drones) * random_.direction();
        state.angular_velocity = random_.uniform(0, 2) * random_.direction();
        add_body(objects_,
                 number % 2 == 0 ? dCreateBox(objects_.space(), 0.3, 0.3, 0.1) : dCreateSphere(objects_.space(), 0.15),
                 1, state);
    }
};
} // namespace

SceneRecipe drones_world(const SceneSpec &spec)
{
    const double half = half_side_of_drones(spec.objects) + 1;
    return {[](const SceneSpec &made, dSpaceID space) { return std::make_unique<DronesWorld>(made, space); },
            {Vector3::Zero(), {half, half, half_height_of_drones + 1}},
            drones_step};
}
} // namespace ode_predictive_space::scenes
