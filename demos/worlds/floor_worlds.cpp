// Bodies that roll and lie on a plane, or on a sphere as large as the moon; and one small world of them after the other.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double floor_step = 0.004;
constexpr double half_height = 0.15; // of a body on the floor, metres
constexpr double fastest = 0.5;      // m/s
constexpr double moon_step = 0.005;
constexpr double moon_radius = 1.7e6; // metres
constexpr double moon_gravity = 1.62; // m/s^2

double half_side_of_floor(int objects)
{
    return 0.6 * std::sqrt(objects) + 2;
}

double half_side_of_moon(int objects)
{
    return 0.5 * std::sqrt(objects) + 1;
}

/// Spheres and boxes, alternately.
class RollingWorld : public ProgramWorld
{
protected:
    using ProgramWorld::ProgramWorld;

    /// @param half of the box in which they begin, metres. @param middle its height, metres.
    void add_bodies(int count, const Vector3 &half, double middle, double radius, const Vector3 &box)
    {
        const dSpaceID space = objects_.space();
        for (int i = 0; i < count; ++i)
        {
            BodyState state;
            state.position = random_.in_box(half) + Vector3(0, 0, middle);
            state.velocity = random_.in_box({fastest, fastest, 0});
            objects_.add_body(i % 2 == 0 ? dCreateSphere(space, radius) : dCreateBox(space, box.x(), box.y(), box.z()),
                              1, state);
        }
    }
};

class FloorWorld : public RollingWorld
{
public:
    FloorWorld(const WorldSpec &spec, dSpaceID space, double variation) : RollingWorld(spec, space, floor_step)
    {
        vary_steps(variation);
        objects_.add_geom(dCreatePlane(space, 0, 0, 1, 0));
        const double half = half_side_of_floor(spec.objects);
        add_bodies(spec.objects, {half, half, 0}, half_height + 0.01, half_height, {0.25, 0.25, 0.3});
    }
};

class MoonWorld : public RollingWorld
{
public:
    MoonWorld(const WorldSpec &spec, dSpaceID space) : RollingWorld(spec, space, moon_step)
    {
        dWorldSetGravity(objects_.world(), 0, 0, -moon_gravity);
        set_position(objects_.add_geom(dCreateSphere(space, moon_radius)), {0, 0, -moon_radius});
        const double half = half_side_of_moon(spec.objects);
        add_bodies(spec.objects, {half, half, 0.2}, 0.4, 0.1, {0.2, 0.2, 0.2});
    }
};

/// A sequence of small worlds. Each has its own space and is destroyed after a few ticks.
class ManyWorlds : public World
{
public:
    ManyWorlds(const WorldSpec &spec, dSpaceID model)
        : World(spec, nullptr), factory_(life_of_many(spec)), model_(model)
    {
        begin_life();
    }
    ~ManyWorlds() override { end_life(); }

    void advance() override
    {
        if (age_ == ticks_of_life)
        {
            end_life();
            begin_life();
        }
        ++age_;
        world_->advance();
    }
    void collide(dSpaceID, void *data, const NearCallbacks &near) override { world_->collide(space_, data, near); }
    void respond(const std::vector<IndexPair> &pairs) override
    {
        world_->respond(pairs);
        contacts_ = world_->contacts();
    }
    bool moves_by_itself() const override { return false; }
    const std::vector<dGeomID> &geoms() const override { return world_->geoms(); }

private:
    void begin_life()
    {
        age_ = 0;
        space_ = make_space_like(model_, nullptr, factory_.bounds());
        world_ = factory_.make(space_);
    }

    void end_life()
    {
        dSpaceSetCleanup(space_, 0);
        dSpaceDestroy(space_);
        world_.reset();
    }

    WorldFactory factory_;
    dSpaceID model_;
    dSpaceID space_ = nullptr;
    std::unique_ptr<World> world_;
    int age_ = 0;
};

Bounds floor_bounds(int objects)
{
    return square(half_side_of_floor(objects), 1);
}

WorldEntry floor(const char *name, const char *text, double variation)
{
    return {Group::program, name, text, 500, floor_step, &floor_bounds, made_of<FloorWorld>(variation)};
}

} // namespace

WorldSpec life_of_many(const WorldSpec &spec)
{
    WorldSpec life = spec;
    life.name = "floor";
    life.objects = std::max(1, spec.objects - 1); // the plane is one of its geoms
    return life;
}

std::vector<WorldEntry> floor_worlds()
{
    return {
        floor("floor", "n bodies that roll and lie on a plane", 0),
        floor("floor_50", "the same in steps that vary by 50 %", 0.5),
        {Group::program, "many", "worlds of n geoms that live for 60 ticks, one after the other", 17, floor_step,
         [](int geoms) {
             return floor_bounds(life_of_many({"many", geoms}).objects);
         },
         made_of<ManyWorlds>()},
        {Group::program, "moon", "n bodies on a sphere of 1,700 km", 200, moon_step,
         [](int objects) { return square(half_side_of_moon(objects), 2); }, made_of<MoonWorld>()},
    };
}
} // namespace ode_predictive_space::worlds
