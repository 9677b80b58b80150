// Free bodies that fly in a room with pillars, which is one mesh.

#include "demos/scenes/flyer.h"
#include "demos/scenes/world_scene.h"
#include "tests/scenes/worlds/box_mesh.h"
#include "tests/scenes/worlds/makers.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double drones_step = 0.005;
constexpr double half_height_of_drones = 3; // metres
constexpr double half_pillar = 0.3;         // metres
constexpr int pillars = 4;                  // along each side

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
        let_fly(objects_.world(), surface_);
        const double half = half_side_of_drones(spec.objects);
        mesh.add_room({half, half, half_height_of_drones}, true);
        for (int i = 0; i < pillars * pillars; ++i)
            mesh.add(place_of_pillar(i, half), {half_pillar, half_pillar, half_height_of_drones});
        add_scenery(objects_, mesh.make_geom(space));
        for (int i = 0; i < spec.objects; ++i)
            add_flyer(objects_, i, {{0.3, 0.3, 0.1}, 0.15}, free_place(half), random_);
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
                return false;
        }
        return true;
    }

    Vector3 free_place(double half)
    {
        Vector3 place;
        do
        {
            place = random_.in_box({half - 0.5, half - 0.5, half_height_of_drones - 0.5});
        } while (!is_free(place, half));
        return place;
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
