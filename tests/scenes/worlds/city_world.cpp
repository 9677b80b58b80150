// Vehicles that drive over hills among trees.

#include "tests/scenes/worlds/makers.h"
#include "tests/scenes/worlds/vehicle.h"
#include "tests/scenes/worlds/world_scene.h"

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

/// ODE keeps pointers into the heights: before the scene.
class Hills
{
protected:
    explicit Hills(double half) : heights_(samples * samples), data_(dGeomHeightfieldDataCreate())
    {
        for (int row = 0; row < samples; ++row)
        {
            for (int column = 0; column < samples; ++column)
            {
                // The heightfield's z is our -y.
                const double x = half * (2.0 * column / (samples - 1) - 1);
                const double y = -half * (2.0 * row / (samples - 1) - 1);
                heights_[static_cast<std::size_t>(row * samples + column)] = height(x, y);
            }
        }
        dGeomHeightfieldDataBuildDouble(data_, heights_.data(), 0, 2 * half, 2 * half, samples, samples, 1, 0, 1, 0);
        dGeomHeightfieldDataSetBounds(data_, -2, 2);
    }
    ~Hills() { dGeomHeightfieldDataDestroy(data_); }
    Hills(const Hills &) = delete;
    Hills &operator=(const Hills &) = delete;

    std::vector<double> heights_;
    dHeightfieldDataID data_;
};

class CityWorld : private Hills, public WorldScene
{
public:
    CityWorld(const SceneSpec &spec, dSpaceID space)
        : Hills(half_side_of_city(spec.objects)), WorldScene(spec, space, city_step)
    {
        set_orientation(add_scenery(objects_, dCreateHeightfield(space, data_, 1)),
                        Quaternion(Eigen::AngleAxisd(pi / 2, Vector3::UnitX())));
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
