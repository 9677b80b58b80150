// Vehicles that drive over hills among trees.

#include "demos/scenes/hills.h"
#include "demos/scenes/world_scene.h"
#include "tests/scenes/worlds/makers.h"
#include "tests/scenes/worlds/vehicle.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double city_step = 0.005;
constexpr int samples = 65; // of the heightfield, along each side
constexpr int trees_per_vehicle = 5;
constexpr double tree_height = 3; // metres
constexpr double tree_radius = 0.2;

double half_side_of_city(int vehicles)
{
    return 6 * std::sqrt(vehicles) + 10;
}

double height(double x, double y)
{
    return 2 * std::sin(0.1 * x) * std::cos(0.13 * y);
}

class CityWorld : private Hills, public WorldScene
{
public:
    CityWorld(const SceneSpec &spec, dSpaceID space)
        : Hills(half_side_of_city(spec.objects), samples, &height, 2), WorldScene(spec, space, city_step)
    {
        add_to(objects_);
        const double half = half_side_of_city(spec.objects);
        for (int i = 0; i < trees_per_vehicle * spec.objects; ++i)
        {
            const Vector3 place = place_on_ground(half - 2, tree_height / 2);
            set_position(add_scenery(objects_, dCreateCapsule(space, tree_radius, tree_height)), place);
        }
        const VehicleSize size = {{1, 0.5, 0.2}, 0.35, 200, false, 200};
        for (int i = 0; i < spec.objects; ++i)
        {
            const Vector3 place = place_on_ground(half - 5, 0.5);
            add_vehicle(objects_, space, size, place, random_.uniform(-pi, pi), random_);
        }
    }

private:
    Vector3 place_on_ground(double half, double above)
    {
        Vector3 place = random_.in_box({half, half, 0});
        place.z() = height(place.x(), place.y()) + above;
        return place;
    }
};
} // namespace

SceneRecipe city_world(const SceneSpec &spec)
{
    const double half = half_side_of_city(spec.objects) + 1;
    return {[](const SceneSpec &made, dSpaceID space) { return std::make_unique<CityWorld>(made, space); },
            {Vector3::Zero(), {half, half, 10}},
            city_step};
}
} // namespace ode_predictive_space::scenes
