// Ten robots that look around with rays among still boxes. Each ray asks by itself, or the rays of a robot have a space of their
// own in the space of the boxes.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double lidar_step = 0.05;
constexpr int robots = 10;
constexpr int rays_per_robot = 360;
constexpr double range = 10; // metres
constexpr double speed = 1;  // m/s

Bounds lidar_bounds(int boxes)
{
    return square(std::sqrt(boxes) + 1, 2);
}

class LidarWorld : public ProgramWorld
{
public:
    LidarWorld(const WorldSpec &spec, dSpaceID space, bool nested)
        : ProgramWorld(spec, space, lidar_step), nested_(nested)
    {
        const double half = std::sqrt(spec.objects);
        for (int i = 0; i < spec.objects; ++i)
        {
            const Vector3 size = Vector3::Constant(0.7) + random_.in_box(Vector3::Constant(0.4));
            set_position(objects_.add_scenery(dCreateBox(space, size.x(), size.y(), size.z())),
                         random_.in_box({half, half, 0.5}));
        }
        for (int i = 0; i < robots; ++i)
        {
            const double heading = random_.uniform(-pi, pi);
            robots_.push_back(
                {random_.in_box({half, half, 0.2}), speed * Vector3(std::cos(heading), std::sin(heading), 0)});
            add_rays(nested ? add_space(lidar_bounds(spec.objects)) : nullptr);
        }
        place_rays();
    }

    void collide(dSpaceID space, void *data, const NearCallbacks &near) override
    {
        if (nested_)
        {
            dSpaceCollide(space, data, near.nested);
            return;
        }
        for (const dGeomID ray : rays_)
            dSpaceCollide2(ray, reinterpret_cast<dGeomID>(space), data, near.geoms);
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
            const Vector3 &place = robots_[i / rays_per_robot].place;
            const double angle = 2 * pi * static_cast<double>(i % rays_per_robot) / rays_per_robot;
            dGeomRaySet(rays_[i], place.x(), place.y(), place.z(), std::cos(angle), std::sin(angle), 0);
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

WorldEntry lidar(const char *name, const char *text, bool nested)
{
    return {Group::program, name, text, 1000, lidar_step, &lidar_bounds, made_of<LidarWorld>(nested)};
}
} // namespace

std::vector<WorldEntry> lidar_worlds()
{
    return {lidar("lidar", "10 robots with 360 rays that ask one by one among n boxes", false),
            lidar("lidar_nested", "the same rays in a space for each robot", true)};
}
} // namespace ode_predictive_space::worlds
