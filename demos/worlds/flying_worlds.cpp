// Free bodies that fly and bounce, each time with one large surface around or below them: drones, room, hills.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double fastest = 3; // m/s
constexpr double drones_step = 0.005;
constexpr double half_height_of_drones = 3; // metres
constexpr double half_pillar = 0.3;         // metres
constexpr int pillars = 4;                  // along each side
constexpr double room_step = 0.001;
constexpr double hills_step = 0.002;
constexpr int samples_along_hills = 257;
constexpr double highest_hill = 1; // metres
constexpr double ceiling = 5;      // above the middle height of the hills

double half_side_of_drones(int drones)
{
    return 0.5 * std::sqrt(drones) + 2;
}

double half_side_of_room(int objects)
{
    return 0.45 * std::cbrt(objects) + 0.5;
}

double half_side_of_hills(int objects)
{
    return 0.4 * std::sqrt(objects) + 3;
}

/// Every other flyer is a box, the others are spheres.
class FlyingWorld : public ProgramWorld
{
protected:
    FlyingWorld(const WorldSpec &spec, dSpaceID space, double step_seconds) : ProgramWorld(spec, space, step_seconds)
    {
        let_bounce(0, 1, 0);
    }

    /// It turns, and flies at up to 3 m/s in any direction.
    void add_flyer(int number, const Vector3 &place, const Vector3 &box = {0.15, 0.15, 0.1}, double radius = 0.1)
    {
        BodyState state;
        state.position = place;
        state.velocity = random_.uniform(0, fastest) * random_.direction();
        state.angular_velocity = random_.uniform(0, 2) * random_.direction();
        const dSpaceID space = objects_.space();
        objects_.add_body(number % 2 == 0 ? dCreateBox(space, box.x(), box.y(), box.z()) : dCreateSphere(space, radius),
                          1, state);
    }
};

/// In a room with pillars, which is one mesh.
class DronesWorld : private TriangleMesh, public FlyingWorld
{
public:
    DronesWorld(const WorldSpec &spec, dSpaceID space)
        : FlyingWorld(spec, space, drones_step), half_(half_side_of_drones(spec.objects))
    {
        add_room({half_, half_, half_height_of_drones}, true);
        for (int i = 0; i < pillars * pillars; ++i)
            add_box(place_of_pillar(i), {half_pillar, half_pillar, half_height_of_drones});
        build();
        objects_.add_scenery(make_geom(space));
        for (int i = 0; i < spec.objects; ++i)
            add_flyer(i, free_place(), {0.3, 0.3, 0.1}, 0.15);
    }

private:
    Vector3 place_of_pillar(int number) const
    {
        const double distance = 2 * half_ / pillars;
        return {distance * (number % pillars + 0.5) - half_, distance * (number / pillars + 0.5) - half_, 0};
    }

    Vector3 free_place()
    {
        const Vector3 place = random_.in_box({half_ - 0.5, half_ - 0.5, half_height_of_drones - 0.5});
        for (int i = 0; i < pillars * pillars; ++i)
        {
            const Vector3 way = place - place_of_pillar(i);
            if (std::max(std::abs(way.x()), std::abs(way.y())) < half_pillar + 0.3)
                return free_place();
        }
        return place;
    }

    double half_;
};

/// In a room with rough walls, which is one mesh: a scan, or a level of a game.
class RoomWorld : private TriangleMesh, public FlyingWorld
{
public:
    RoomWorld(const WorldSpec &spec, dSpaceID space) : FlyingWorld(spec, space, room_step)
    {
        add_rough_room(half_side_of_room(spec.objects), spec.seed);
        build();
        objects_.add_scenery(make_geom(space));
        const Vector3 half = Vector3::Constant(half_side_of_room(spec.objects) - 0.3);
        for (int i = 0; i < spec.objects; ++i)
            add_flyer(i, random_.in_box(half));
    }
};

/// Over hills, which are a heightfield, below a ceiling at which they turn back, as at the edge of the hills.
class HillsWorld : private Heightfield, public FlyingWorld
{
public:
    HillsWorld(const WorldSpec &spec, dSpaceID space)
        : Heightfield(half_side_of_hills(spec.objects) + 1, samples_along_hills, &height_of_hill, highest_hill),
          FlyingWorld(spec, space, hills_step), half_(half_side_of_hills(spec.objects)),
          sky_(Vector3(-half_, -half_, -highest_hill), Vector3(half_, half_, ceiling))
    {
        objects_.add_scenery(make_geom(space));
        for (int i = 0; i < spec.objects; ++i)
        {
            Vector3 place = random_.in_box({half_, half_, 0});
            place.z() = random_.uniform(highest_hill + 0.3, ceiling);
            add_flyer(i, place);
        }
    }

private:
    static double height_of_hill(double x, double y)
    {
        return 0.7 * std::sin(x) * std::cos(1.3 * y) + 0.3 * std::sin(3.1 * x + 2 * y);
    }

    void before_step() override
    {
        for (const dBodyID body : objects_.bodies())
            turn_back(sky_, body);
    }

    double half_; ///< half the side of what they fly over, metres
    Eigen::AlignedBox3d sky_;
};
} // namespace

std::vector<WorldEntry> flying_worlds()
{
    return {
        {Group::program, "drones", "n bodies that fly in a room with pillars, which is one mesh", 300, drones_step,
         [](int objects) { return square(half_side_of_drones(objects) + 1, half_height_of_drones + 1); },
         made_of<DronesWorld>()},
        {Group::program, "room", "n bodies that fly in a room with rough walls, which is one mesh of 215,472 triangles",
         1000, room_step, [](int objects) { return cube(half_side_of_room(objects) + 1); }, made_of<RoomWorld>()},
        {Group::program, "hills", "n bodies that fly over hills, which are a heightfield", 1000, hills_step,
         [](int objects) { return square(half_side_of_hills(objects) + 1, ceiling + 1); }, made_of<HillsWorld>()},
    };
}
} // namespace ode_predictive_space::worlds
