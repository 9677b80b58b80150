// Bodies that fly over hills, which are a heightfield, below a ceiling at which they turn back.

#include "demos/scenes/flyer.h"
#include "demos/scenes/hills.h"
#include "demos/scenes/surface_scenes.h"
#include "demos/scenes/world_scene.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double hills_step = 0.002;
constexpr int samples_along_hills = 257;
constexpr double highest_hill = 1; // metres
constexpr double ceiling = 5;      // above the middle height

double half_side_of_hills(int objects)
{
    return 0.4 * std::sqrt(objects) + 3;
}

double height_of_hill(double x, double y)
{
    return 0.7 * std::sin(x) * std::cos(1.3 * y) + 0.3 * std::sin(3.1 * x + 2 * y);
}

class HillsScene : private Hills, public WorldScene
{
public:
    HillsScene(const SceneSpec &spec, dSpaceID space)
        : Hills(half_side_of_hills(spec.objects) + 1, samples_along_hills, &height_of_hill, highest_hill),
          WorldScene(spec, space, hills_step), half_(half_side_of_hills(spec.objects))
    {
        let_fly(objects_.world(), surface_);
        add_to(objects_);
        for (int i = 0; i < spec.objects; ++i)
        {
            Vector3 place = random_.in_box({half_, half_, 0});
            place.z() = random_.uniform(highest_hill + 0.3, ceiling);
            bodies_.push_back(add_flyer(objects_, i, {{0.15, 0.15, 0.1}, 0.1}, place, random_));
        }
    }

private:
    void before_step() override
    {
        const Vector3 low(-half_, -half_, -highest_hill), high(half_, half_, ceiling);
        for (const dBodyID body : bodies_)
        {
            const Vector3 place = from_ode(dBodyGetPosition(body));
            Vector3 velocity = from_ode(dBodyGetLinearVel(body));
            const auto leaves = (place.array() > high.array() && velocity.array() > 0) ||
                                (place.array() < low.array() && velocity.array() < 0);
            if (leaves.any())
            {
                velocity = leaves.select(-velocity, velocity);
                dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
            }
        }
    }

    double half_; ///< half the side of what they fly over, metres
    std::vector<dBodyID> bodies_;
};
} // namespace

SceneRecipe hills_scene(const SceneSpec &spec)
{
    const double half = half_side_of_hills(spec.objects) + 1;
    return {[](const SceneSpec &made, dSpaceID space) { return std::make_unique<HillsScene>(made, space); },
            {Vector3::Zero(), {half, half, ceiling + 1}},
            hills_step};
}
} // namespace ode_predictive_space::scenes
