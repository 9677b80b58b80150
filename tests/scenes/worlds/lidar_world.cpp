// Ten robots that look around with rays among still boxes. Each ray asks by itself, or the rays of a robot have a space of their
// own in the space of the boxes.

#include "demos/scenes/world_scene.h"
#include "tests/scenes/worlds/makers.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double lidar_step = 0.05;
constexpr int robots = 10;
constexpr int rays_per_robot = 360;
constexpr double range = 10; // metres
constexpr double speed = 1;  // m/s

double half_side_of_lidar(int boxes)
{
    return std::sqrt(boxes);
}

SceneBounds bounds_of_lidar(int boxes)
{
    return {Vector3::Zero(), {half_side_of_lidar(boxes) + 1, half_side_of_lidar(boxes) + 1, 2}};
}

class LidarWorld : public WorldScene
{
public:
    LidarWorld(const SceneSpec &spec, dSpaceID space, bool nested)
        : WorldScene(spec, space, lidar_step), nested_(nested)
    {
        const double half = half_side_of_lidar(spec.objects);
        for (int i = 0; i < spec.objects; ++i)
        {
            const Vector3 size = Vector3::Constant(0.7) + random_.in_box(Vector3::Constant(0.4));
            set_position(add_scenery(objects_, dCreateBox(space, size.x(), size.y(), size.z())),
                         random_.in_box({half, half, 0.5}));
        }
        for (int i = 0; i < robots; ++i)
        {
            const double heading = random_.uniform(-pi, pi);
            robots_.push_back(
                {random_.in_box({half, half, 0.2}), speed * Vector3(std::cos(heading), std::sin(heading), 0)});
            add_rays(nested ? add_space(bounds_of_lidar(spec.objects)) : nullptr);
        }
        place_rays();
    }

    void collide(dSpaceID space, PairList &list) override
    {
        if (nested_)
        {
            dSpaceCollide(space, &list, &PairList::collect_in_spaces);
            return;
        }
        for (const dGeomID ray : rays_)
            dSpaceCollide2(ray, reinterpret_cast<dGeomID>(space), &list, &PairList::collect);
    }

private:
    struct Robot
    {
        Vector3 place;
        Vector3 velocity;
    };

    void add_rays(dSpaceID space)
    {
        for (int i = 0; i < rays_per_robot; ++i)
        {
            const dGeomID ray = dCreateRay(space, range);
            dGeomSetCategoryBits(ray, 1);
            dGeomSetCollideBits(ray, ~1ul);
            rays_.push_back(objects_.add_geom(ray));
        }
    }

    void place_rays()
    {
        for (std::size_t i = 0; i < rays_.size(); ++i)
        {
            const Robot &robot = robots_[i / rays_per_robot];
            const double angle = 2 * pi * static_cast<double>(i % rays_per_robot) / rays_per_robot;
            dGeomRaySet(rays_[i], robot.place.x(), robot.place.y(), robot.place.z(), std::cos(angle), std::sin(angle),
                        0);
        }
    }

    void before_step() override
    {
        for (Robot &robot : robots_)
            robot.place += step() * robot.velocity;
        place_rays();
    }

    bool nested_;
    std::vector<Robot> robots_;
    std::vector<dGeomID> rays_;
};
} // namespace

SceneRecipe lidar_world(const SceneSpec &spec, bool nested)
{
    return {
        [nested](const SceneSpec &made, dSpaceID space) { return std::make_unique<LidarWorld>(made, space, nested); },
        bounds_of_lidar(spec.objects), lidar_step};
}
} // namespace ode_predictive_space::scenes
