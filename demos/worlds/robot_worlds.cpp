// Robots, vehicles and ragdolls: bodies joined by hinges with motors or by balls.

#include "demos/worlds/heightfield.h"
#include "demos/worlds/lists.h"
#include "demos/worlds/ragdoll.h"
#include "demos/worlds/stepped_world.h"
#include "demos/worlds/vehicle.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double robots_step = 0.005;

constexpr double chain_step = 0.004;
constexpr int links = 17;
constexpr double link_length = 0.2;  // metres
constexpr double link_radius = 0.06; // metres
constexpr double link_torque = 8;    // N m
constexpr double fastest_link = 2;   // rad/s
constexpr double place_for_one = 2;  // metres

class ChainWorld : public ProgramWorld
{
public:
    ChainWorld(const WorldSpec &spec, dSpaceID space) : ProgramWorld(spec, space, chain_step)
    {
        objects_.add_geom(dCreatePlane(space, 0, 0, 1, 0));
        for (int i = 0; i < spec.objects; ++i)
            add_chain(place_for_one * i);
    }

private:
    void add_chain(double y)
    {
        dBodyID last = nullptr;
        for (int i = 0; i < links; ++i)
        {
            BodyState state;
            state.position = {link_length * i, y, link_radius + 0.02};
            const dGeomID geom = i % 2 == 0
                                     ? dCreateBox(objects_.space(), link_length, 2 * link_radius, 2 * link_radius)
                                     : dCreateSphere(objects_.space(), link_radius);
            const dBodyID body = objects_.add_body(geom, 0.5, state);
            if (last != nullptr)
                join(last, body, i);
            last = body;
        }
    }

    void join(dBodyID last, dBodyID body, int number)
    {
        const dReal *place = dBodyGetPosition(body);
        const dJointID hinge = dJointCreateHinge(objects_.world(), nullptr);
        dJointAttach(hinge, last, body);
        dJointSetHingeAnchor(hinge, place[0] - link_length / 2, place[1], place[2]);
        dJointSetHingeAxis(hinge, 0, number % 2, 1 - number % 2);
        hinges_.push_back(hinge);
    }

    void before_step() override
    {
        time_ += step();
        for (std::size_t i = 0; i < hinges_.size(); ++i)
            drive(hinges_[i], fastest_link * std::sin(2 * time_ + 0.8 * static_cast<double>(i)), link_torque);
    }

    std::vector<dJointID> hinges_;
    double time_ = 0;
};

Bounds chain_bounds(int chains)
{
    return {{link_length * links / 2, place_for_one * chains / 2, 0}, {5, place_for_one * chains + 2, 2}};
}

constexpr int stairs = 12;
constexpr double stair_depth = 0.6;        // metres
constexpr double stair_rise = 0.25;        // metres
constexpr double half_width_of_stairs = 5; // metres
constexpr int side_by_side = 5;            // ragdolls

class RagdollsWorld : public ProgramWorld
{
public:
    RagdollsWorld(const WorldSpec &spec, dSpaceID space) : ProgramWorld(spec, space, robots_step)
    {
        objects_.add_geom(dCreatePlane(space, 0, 0, 1, 0));
        for (int stair = 0; stair < stairs; ++stair)
        {
            const double height = stair_rise * (stair + 1);
            set_position(objects_.add_scenery(dCreateBox(space, stair_depth, 2 * half_width_of_stairs, height)),
                         {stair_depth * stair, 0, height / 2});
        }
        for (int i = 0; i < spec.objects; ++i)
        {
            const double side = place_for_one * (i % side_by_side - 0.5 * (side_by_side - 1));
            const double up = place_for_one * static_cast<double>(i / side_by_side);
            const Quaternion turn(Eigen::AngleAxisd(random_.uniform(-pi, pi), random_.direction()));
            const Vector3 place(stair_depth * stairs * random_.unit(), side, stair_rise * stairs + 1.5 + up);
            add_ragdoll(objects_, place, turn);
        }
    }
};

Bounds ragdolls_bounds(int)
{
    return {{stair_depth * stairs / 2, 0, 5}, {stair_depth * stairs, 2 * half_width_of_stairs, 10}};
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

/// Vehicles that drive over hills among trees.
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

/// Spaces in the space, above a plane.
class NestedWorld : public ProgramWorld
{
public:
    void collide(dSpaceID space, void *data, const NearCallbacks &near) override
    {
        dSpaceCollide(space, data, near.nested);
    }

protected:
    NestedWorld(const WorldSpec &spec, dSpaceID space) : ProgramWorld(spec, space, robots_step)
    {
        objects_.add_geom(dCreatePlane(space, 0, 0, 1, 0));
    }
};

/// One for each robot, whose geoms are not tested against one another.
class RobotSpacesWorld : public NestedWorld
{
public:
    RobotSpacesWorld(const WorldSpec &spec, dSpaceID space) : NestedWorld(spec, space)
    {
        const double half = half_side_of_nested(spec.objects) - 1;
        const int side = static_cast<int>(std::ceil(std::sqrt(spec.objects)));
        for (int i = 0; i < spec.objects; ++i)
        {
            const Vector3 place(2 * half * (i % side + 0.5) / side - half, 2 * half * (i / side + 0.5) / side - half,
                                0);
            add_vehicle(objects_, add_space(nested_bounds(spec.objects)), {}, place, random_.uniform(-pi, pi), random_);
        }
    }
};

class EmptySpacesWorld : public NestedWorld
{
public:
    EmptySpacesWorld(const WorldSpec &spec, dSpaceID space) : NestedWorld(spec, space)
    {
        for (int i = 0; i < spec.objects; ++i)
            add_space(nested_bounds(spec.objects));
        for (int i = 0; i < balls; ++i)
        {
            BodyState state;
            state.position = random_.in_box({2, 2, 0}) + Vector3(0, 0, 0.2);
            state.velocity = random_.in_box({1, 1, 0});
            objects_.add_body(dCreateSphere(space, 0.15), 1, state);
        }
    }
};
} // namespace

std::vector<WorldEntry> robot_worlds()
{
    return {
        {Group::program, "ragdolls", "n ragdolls of 12 capsules that fall on stairs", 20, robots_step, &ragdolls_bounds,
         made_of<RagdollsWorld>()},
        {Group::program, "chain", "n robots of 17 bodies with motors on a plane", 1, chain_step, &chain_bounds,
         made_of<ChainWorld>()},
        shelves("shelves", "n still boxes and 50 robots of 7 geoms on a plane", false),
        shelves("shelves_mesh", "the same; ground and walls are one mesh", true),
        {Group::program, "city", "n vehicles with four wheels on a heightfield, and 5 n trees", 100, robots_step,
         [](int vehicles) { return square(half_side_of_city(vehicles) + 1, 10); }, made_of<CityWorld>()},
        {Group::program, "nested", "n robots of 7 geoms, each with a space of its own", 22, robots_step, &nested_bounds,
         made_of<RobotSpacesWorld>()},
        {Group::program, "nested_empty", "n spaces without geoms and 10 balls", 100, robots_step, &nested_bounds,
         made_of<EmptySpacesWorld>()},
    };
}
} // namespace ode_predictive_space::worlds
