// Vehicles and robots, a chassis and four wheels with motors each: shelves, city, nested; spaces without robots; and robots
// that look around with rays.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double robots_step = 0.005;
constexpr double slowest = 4;      // rad/s, of a wheel
constexpr double fastest = 12;     // rad/s
constexpr double difference = 0.1; // of the speeds left and right

/// Lengths in metres.
struct VehicleSize
{
    Vector3 half_chassis{0.3, 0.2, 0.06};
    double wheel_radius = 0.1;
    double mass = 20;   ///< kg, of the chassis
    bool mast = true;   ///< two further geoms of the chassis: a mast and a head on it
    double torque = 10; ///< N m, of each wheel's motor
};

void add_mast(Objects &objects, dSpaceID space, const VehicleSize &size, dBodyID chassis)
{
    const double height = 4 * size.half_chassis.z();
    const double radius = 0.2 * size.half_chassis.y();
    const double foot = size.half_chassis.z();
    objects.attach(dCreateBox(space, radius, radius, height), chassis, {0, 0, foot + height / 2});
    objects.attach(dCreateSphere(space, radius), chassis, {0, 0, foot + height + radius});
}

void add_wheel(Objects &objects, dSpaceID space, const VehicleSize &size, const BodyState &state, dBodyID chassis,
               double speed)
{
    const dBodyID wheel = objects.add_body(dCreateSphere(space, size.wheel_radius), 0.05 * size.mass, state);
    const dJointID hinge = dJointCreateHinge(objects.world(), nullptr);
    const Vector3 axis = state.orientation * Vector3::UnitY();
    dJointAttach(hinge, wheel, chassis);
    dJointSetHingeAnchor(hinge, state.position.x(), state.position.y(), state.position.z());
    dJointSetHingeAxis(hinge, axis.x(), axis.y(), axis.z());
    drive(hinge, speed, size.torque);
}

/// Makes a vehicle whose wheels stand on the height of `place`, and which drives at random speeds.
/// @param space of its geoms. @param heading radians about the vertical.
void add_vehicle(Objects &objects, dSpaceID space, const VehicleSize &size, const Vector3 &place, double heading,
                 haptics::Random &random)
{
    const Vector3 &half = size.half_chassis;
    BodyState state;
    state.position = place + Vector3(0, 0, size.wheel_radius + half.z());
    state.orientation = Eigen::AngleAxisd(heading, Vector3::UnitZ());
    const dBodyID chassis =
        objects.add_body(dCreateBox(space, 2 * half.x(), 2 * half.y(), 2 * half.z()), size.mass, state);
    if (size.mast)
        add_mast(objects, space, size, chassis);
    const double speed = random.uniform(slowest, fastest);
    const double turn = random.uniform(-difference, difference);
    for (const double front : {-1.0, 1.0})
    {
        for (const double left : {-1.0, 1.0})
        {
            BodyState wheel = state;
            const Vector3 offset(front * 0.8 * half.x(), left * (half.y() + 1.05 * size.wheel_radius), -half.z());
            wheel.position += state.orientation * offset;
            add_wheel(objects, space, size, wheel, chassis, speed * (1 + left * turn));
        }
    }
}

constexpr int robots_in_store = 50;
constexpr int robots_per_row = 10;
constexpr int levels = 5;             // of a shelf
constexpr double place_width = 0.5;   // of a box in its shelf, metres
constexpr double level_height = 0.45; // metres
constexpr double aisle = 2.5;         // from shelf to shelf, metres
constexpr double store_height = 5;    // metres

/// Places along a shelf and shelves, so that the store is about square.
int places(int boxes)
{
    return std::max(4, static_cast<int>(std::sqrt(boxes / levels * aisle / place_width)));
}

double half_side_of_shelves(int boxes)
{
    return 0.5 * place_width * places(boxes) + 2 * aisle;
}

/// A store: still boxes on shelves, and robots in the aisles. The ground is a plane, or ground and walls are one mesh.
class ShelvesWorld : private TriangleMesh, public ProgramWorld
{
public:
    ShelvesWorld(const WorldSpec &spec, dSpaceID space, bool one_mesh) : ProgramWorld(spec, space, robots_step)
    {
        const double half = half_side_of_shelves(spec.objects);
        add_room({half, half, store_height}, false);
        build();
        const dGeomID ground = objects_.add_scenery(one_mesh ? make_geom(space) : dCreatePlane(space, 0, 0, 1, 0));
        if (one_mesh)
            set_position(ground, {0, 0, store_height});
        for (int i = 0; i < spec.objects; ++i)
        {
            const int column = i / levels;
            const Vector3 place(place_width * (column % places(spec.objects) + 0.5) - half + 2 * aisle,
                                aisle * (column / places(spec.objects)) - half + 2 * aisle,
                                0.3 + level_height * (i % levels));
            set_position(objects_.add_scenery(dCreateBox(space, 0.4, 0.35, 0.3)), place);
        }
        for (int i = 0; i < robots_in_store; ++i)
        {
            const Vector3 place((i % robots_per_row + 0.5) * 2 * (half - aisle) / robots_per_row - half + aisle,
                                aisle * (i / robots_per_row + 0.5) - half + aisle, 0);
            add_vehicle(objects_, space, {}, place, i % 2 == 0 ? 0 : pi, random_);
        }
    }
};

WorldEntry shelves(const char *name, const char *text, bool one_mesh)
{
    const auto bounds = [](int boxes) -> Bounds {
        const double half = half_side_of_shelves(boxes) + 1;
        return {{0, 0, store_height / 2}, {half, half, store_height}};
    };
    return {Group::program, name, text, 1000, robots_step, bounds, made_of<ShelvesWorld>(one_mesh)};
}

constexpr int samples_of_city = 65; // of the heightfield, along each side
constexpr int trees_per_vehicle = 5;
constexpr double tree_height = 3; // metres
constexpr double tree_radius = 0.2;

double half_side_of_city(int vehicles)
{
    return 6 * std::sqrt(vehicles) + 10;
}

class CityWorld : private Heightfield, public ProgramWorld
{
public:
    CityWorld(const WorldSpec &spec, dSpaceID space)
        : Heightfield(half_side_of_city(spec.objects), samples_of_city, &height, 2),
          ProgramWorld(spec, space, robots_step)
    {
        objects_.add_scenery(make_geom(space));
        const double half = half_side_of_city(spec.objects);
        for (int i = 0; i < trees_per_vehicle * spec.objects; ++i)
        {
            const Vector3 place = place_on_ground(half - 2, tree_height / 2);
            set_position(objects_.add_scenery(dCreateCapsule(space, tree_radius, tree_height)), place);
        }
        const VehicleSize size = {{1, 0.5, 0.2}, 0.35, 200, false, 200};
        for (int i = 0; i < spec.objects; ++i)
        {
            const Vector3 place = place_on_ground(half - 5, 0.5);
            add_vehicle(objects_, space, size, place, random_.uniform(-pi, pi), random_);
        }
    }

private:
    static double height(double x, double y) { return 2 * std::sin(0.1 * x) * std::cos(0.13 * y); }

    Vector3 place_on_ground(double half, double above)
    {
        Vector3 place = random_.in_box({half, half, 0});
        place.z() = height(place.x(), place.y()) + above;
        return place;
    }
};

constexpr int balls = 10; // beside the empty spaces

double half_side_of_nested(int robots)
{
    return std::sqrt(robots) + 2;
}

Bounds nested_bounds(int robots)
{
    return square(half_side_of_nested(robots), 2);
}

/// Spaces in the space, above a plane: one for each robot, whose geoms are not tested against one another; or empty ones.
class NestedWorld : public ProgramWorld
{
public:
    NestedWorld(const WorldSpec &spec, dSpaceID space, bool empty) : ProgramWorld(spec, space, robots_step)
    {
        objects_.add_geom(dCreatePlane(space, 0, 0, 1, 0));
        const double half = half_side_of_nested(spec.objects) - 1;
        const int side = static_cast<int>(std::ceil(std::sqrt(spec.objects)));
        for (int i = 0; i < spec.objects; ++i)
        {
            const dSpaceID nested = add_space(nested_bounds(spec.objects));
            const Vector3 place(2 * half * (i % side + 0.5) / side - half, 2 * half * (i / side + 0.5) / side - half,
                                0);
            if (!empty)
                add_vehicle(objects_, nested, {}, place, random_.uniform(-pi, pi), random_);
        }
        for (int i = 0; empty && i < balls; ++i)
        {
            BodyState state;
            state.position = random_.in_box({2, 2, 0}) + Vector3(0, 0, 0.2);
            state.velocity = random_.in_box({1, 1, 0});
            objects_.add_body(dCreateSphere(space, 0.15), 1, state);
        }
    }

    void collide(dSpaceID space, void *data, const NearCallbacks &near) override
    {
        dSpaceCollide(space, data, near.nested);
    }
};

constexpr double lidar_step = 0.05;
constexpr int lidars = 10;
constexpr int rays_per_robot = 360;
constexpr double range = 10;      // metres
constexpr double lidar_speed = 1; // m/s

Bounds lidar_bounds(int boxes)
{
    return square(std::sqrt(boxes) + 1, 2);
}

/// Robots that look around with rays among still boxes. Each ray asks by itself, or the rays of a robot have a space of their
/// own in the space of the boxes.
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
        for (int i = 0; i < lidars; ++i)
        {
            const double heading = random_.uniform(-pi, pi);
            BodyState robot;
            robot.position = random_.in_box({half, half, 0.2});
            robot.velocity = lidar_speed * Vector3(std::cos(heading), std::sin(heading), 0);
            robots_.push_back(robot);
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
            const Vector3 &place = robots_[i / rays_per_robot].position;
            const double angle = 2 * pi * static_cast<double>(i % rays_per_robot) / rays_per_robot;
            dGeomRaySet(rays_[i], place.x(), place.y(), place.z(), std::cos(angle), std::sin(angle), 0);
        }
    }

    void before_step() override
    {
        for (BodyState &robot : robots_)
            robot.position += step() * robot.velocity;
        place_rays();
    }

    bool nested_;
    std::vector<BodyState> robots_;
    std::vector<dGeomID> rays_;
};

WorldEntry lidar(const char *name, const char *text, bool nested)
{
    return {Group::program, name, text, 1000, lidar_step, &lidar_bounds, made_of<LidarWorld>(nested)};
}
} // namespace

std::vector<WorldEntry> robot_worlds()
{
    return {
        shelves("shelves", "n still boxes and 50 robots of 7 geoms on a plane", false),
        shelves("shelves_mesh", "the same; ground and walls are one mesh", true),
        {Group::program, "city", "n vehicles with four wheels on a heightfield, and 5 n trees", 100, robots_step,
         [](int vehicles) { return square(half_side_of_city(vehicles) + 1, 10); }, made_of<CityWorld>()},
        {Group::program, "nested", "n robots of 7 geoms, each with a space of its own", 22, robots_step, &nested_bounds,
         made_of<NestedWorld>(false)},
        {Group::program, "nested_empty", "n spaces without geoms and 10 balls", 100, robots_step, &nested_bounds,
         made_of<NestedWorld>(true)},
        lidar("lidar", "10 robots with 360 rays that ask one by one among n boxes", false),
        lidar("lidar_nested", "the same rays in a space for each robot", true),
    };
}
} // namespace ode_predictive_space::worlds
