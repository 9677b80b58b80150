// Small movers on a large ground, among a few huge boxes: terrain, and the same moved by gravity, contacts and forces.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double terrain_length = 2000; // along x, metres: 10^4 times the size of an object
constexpr int samples_along = 201;
constexpr int samples_across = 9;
constexpr double heightfield_thickness = 0.5; // metres
constexpr double fastest_mover = 5;           // m/s
constexpr double fastest_turn = 5;            // rad/s
constexpr double sunk = 0.001;          // metres that a rolling object is in the ground: a contact in spite of rounding
constexpr double lowest_flight = 1.5;   // metres
constexpr double highest_flight = 5;    // metres
constexpr double roof_height = 8;       // metres
constexpr double pillar_height = 200;   // metres
constexpr double time_to_recover = 0.2; // seconds
constexpr unsigned long huge_category = 4;
constexpr unsigned long small_bits = 1; // what huge boxes collide with: not one another, nor the ground

/// Half the side of the square in which the objects are, metres.
double half_side_of_square(int objects)
{
    return std::max(0.75 * std::sqrt(objects), 3.0);
}

double along(int sample)
{
    return terrain_length * (static_cast<double>(sample) / (samples_along - 1) - 0.5);
}

/// Three strips along x. Seen along y: a heightfield, then a mesh, then the plane z = 0, each as wide as a third of the
/// square of the objects. The hills, of 1 m at most, end where the plane begins.
class TerrainGround
{
public:
    explicit TerrainGround(double half_side)
        : half_side_(half_side),
          hills_(
              terrain_length, 2 * half_side / 3, samples_along, samples_across,
              [this](int column, int row) {
                  return height(along(column), -half_side_ / 3 - 2 * half_side_ / 3 * row / (samples_across - 1));
              },
              heightfield_thickness)
    {
        for (int i = 0; i < samples_across * samples_along; ++i)
        {
            const double x = along(i % samples_along);
            const double y = half_side_ * (2.0 * (i / samples_along) / (samples_across - 1) - 1) / 3;
            mesh_.add_vertex({x, y, height(x, y)});
        }
        for (dTriIndex i = 0; i < (samples_across - 1) * (samples_along - 1); ++i)
        {
            const dTriIndex corner = i / (samples_along - 1) * samples_along + i % (samples_along - 1);
            mesh_.add_triangle({corner, corner + 1, corner + samples_along});
            mesh_.add_triangle({corner + 1, corner + samples_along + 1, corner + samples_along});
        }
        mesh_.build();
    }

    void add_geoms(Objects &objects) const
    {
        const dGeomID hills = objects.add_scenery(hills_.make_geom(objects.space()));
        set_position(hills, {0, -2 * half_side_ / 3, 0});
        objects.add_scenery(mesh_.make_geom(objects.space()));
        objects.add_scenery(dCreatePlane(objects.space(), 0, 0, 1, 0));
    }

    /// Height of the ground at a place, metres.
    double height(double x, double y) const
    {
        const double share = std::clamp((half_side_ / 3 - y) / half_side_, 0.0, 1.0);
        const double fade = share * share * (3 - 2 * share);
        return fade * (0.5 + 0.25 * std::sin(x / 15) + 0.25 * std::sin(x / 9 + y / 20));
    }

private:
    double half_side_;
    Heightfield hills_;
    TriangleMesh mesh_;
};

/// One of the boxes that are up to 10^4 times as long as an object.
struct HugeBox
{
    Vector3 size;                       ///< metres
    Vector3 position;                   ///< at the start, metres
    Vector3 velocity = Vector3::Zero(); ///< m/s
    double spin = 0;                    ///< about the vertical axis, rad/s
};

/// Still ones (walls, a roof, pillars), two cranes that turn and two airships that drift.
std::vector<HugeBox> huge_boxes(double half_side)
{
    const double third = half_side / 3;
    return {
        {{terrain_length, 0.5, 3}, {0, -third, 0}},
        {{terrain_length, 0.5, 3}, {0, third, 0}},
        {{terrain_length, terrain_length, 1}, {0, 0, roof_height}},
        {{3, 3, pillar_height}, {-third, 0, 0}},
        {{3, 3, pillar_height}, {third, 0, 0}},
        {{100, 1, 1}, {third, -2 * third, 3}, Vector3::Zero(), 0.1},
        {{100, 1, 1}, {-third, 2 * third, 4}, Vector3::Zero(), -0.1},
        {{200, 10, 4}, {0, third, 6}, {0, 1, 0}, 0},
        {{20, 10, 4}, {-third, 0, 5}, {2, -1, 0}, 0},
    };
}

/// The ground, the huge boxes, and objects of which half roll and the other half fly.
class OnTerrain : private TerrainGround, public SteppedWorld
{
protected:
    OnTerrain(const WorldSpec &spec, dSpaceID space)
        : TerrainGround(half_side_of_square(spec.objects)), SteppedWorld(spec, space, usual_tick),
          half_side_(half_side_of_square(spec.objects)), square_(room_of({half_side_, half_side_, dInfinity}))
    {
        add_geoms(objects_);
    }

    using TerrainGround::height;

    static bool rolls(int number) { return number % 2 == 0; }
    static Shape shape_of(int number) { return static_cast<Shape>(number / 2 % 3); }

    static double rest_height_of(Shape shape)
    {
        return (shape == Shape::box ? half_side_of_box() : object_radius) - sunk;
    }

    /// A huge box collides with objects, not with the ground or other huge boxes. @return its body; null if it does not move.
    dBodyID add_huge(const HugeBox &box)
    {
        const dGeomID geom = objects_.add_geom(dCreateBox(objects_.space(), box.size.x(), box.size.y(), box.size.z()));
        set_position(geom, box.position);
        dGeomSetCategoryBits(geom, huge_category);
        dGeomSetCollideBits(geom, small_bits);
        if (box.spin == 0 && box.velocity.isZero(0))
            return nullptr;
        const dBodyID body = dBodyCreate(objects_.world());
        dGeomSetBody(geom, body);
        set_state(body, {box.position, Quaternion::Identity(), box.velocity, {0, 0, box.spin}});
        return body;
    }

    double half_side_; ///< of the square, metres
    Eigen::AlignedBox3d square_;
};

/// All move at up to 5 mm per tick and turn back at the edge of the square. The motion does not depend on contacts, so it can
/// go on for any time.
class TerrainWorld : public OnTerrain
{
public:
    TerrainWorld(const WorldSpec &spec, dSpaceID space) : OnTerrain(spec, space)
    {
        for (const HugeBox &box : huge_boxes(half_side_))
        {
            if (const dBodyID body = add_huge(box))
            {
                const Quaternion turn(Eigen::AngleAxisd(box.spin * usual_tick, Vector3::UnitZ()));
                movers_.push_back({body, state_of(body), turn, 0, false});
            }
        }
        for (int i = 0; i < spec.objects; ++i)
            add_mover(i);
    }

    void advance() override
    {
        for (Mover &mover : movers_)
        {
            BodyState &state = mover.state;
            state.position += usual_tick * state.velocity;
            state.orientation = (mover.turn * state.orientation).normalized();
            turn_back(square_, state.position, state.velocity);
            if (mover.rolls)
            {
                const double before = state.position.z() - usual_tick * state.velocity.z();
                state.position.z() = height(state.position.x(), state.position.y()) + mover.rest_height;
                state.velocity.z() = (state.position.z() - before) / usual_tick;
            }
            set_state(mover.body, state);
        }
    }
    void respond(const std::vector<IndexPair> &) override {}
    bool moves_by_itself() const override { return true; }

private:
    struct Mover
    {
        dBodyID body;
        BodyState state;    ///< kept here too, so that the motion does not depend on how ODE rounds
        Quaternion turn;    ///< per tick
        double rest_height; ///< of the centre of a rolling object above the ground, metres
        bool rolls;
    };

    void add_mover(int number)
    {
        const Shape shape = shape_of(number);
        Mover mover{};
        mover.rolls = rolls(number);
        mover.rest_height = rest_height_of(shape);
        mover.state.position = random_.in_box({half_side_, half_side_, 0});
        const double angle = random_.uniform(0, 2 * pi);
        mover.state.velocity = random_.uniform(0, fastest_mover) * Vector3(std::cos(angle), std::sin(angle), 0);
        const double spin = random_.uniform(0, fastest_turn);
        const Vector3 axis = mover.rolls ? Vector3::UnitZ() : random_.direction();
        if (mover.rolls)
        {
            mover.state.position.z() = height(mover.state.position.x(), mover.state.position.y()) + mover.rest_height;
        }
        else
        {
            mover.state.position.z() = random_.uniform(lowest_flight, highest_flight);
            mover.state.orientation = random_.orientation();
        }
        mover.state.angular_velocity = spin * axis;
        mover.turn = Quaternion(Eigen::AngleAxisd(spin * usual_tick, axis));
        mover.body = objects_.add_moving(shape, mover.state, 1000);
        movers_.push_back(mover);
    }

    std::vector<Mover> movers_;
};

/// Half of the objects lie on the ground, the other half fly, without gravity; forces drive all of them at up to 5 m/s, each in
/// another direction, and back at the edge of the square.
class DrivenWorld : public OnTerrain
{
public:
    DrivenWorld(const WorldSpec &spec, dSpaceID space) : OnTerrain(spec, space)
    {
        let_fall(0.3);
        dWorldSetContactSurfaceLayer(objects_.world(), 0);
        for (const HugeBox &box : huge_boxes(half_side_))
        {
            if (const dBodyID body = add_huge(box))
            {
                dBodySetKinematic(body);
                huge_.push_back(body);
            }
        }
        for (int i = 0; i < spec.objects; ++i)
            add_driven(i);
    }

private:
    struct Driven
    {
        dBodyID body;
        Vector3 velocity; ///< that it is driven to, m/s
        bool flies;
    };

    void add_driven(int number)
    {
        const Shape shape = shape_of(number);
        const double angle = random_.uniform(0, 2 * pi);
        Driven driven{};
        driven.flies = !rolls(number);
        driven.velocity = random_.uniform(0, fastest_mover) * Vector3(std::cos(angle), std::sin(angle), 0);
        BodyState state;
        state.position = random_.in_box({half_side_, half_side_, 0});
        state.position.z() = driven.flies ? random_.uniform(lowest_flight, highest_flight)
                                          : height(state.position.x(), state.position.y()) + rest_height_of(shape);
        if (driven.flies)
            state.orientation = random_.orientation();
        state.velocity = driven.velocity;
        driven.body = objects_.add_moving(shape, state, 1000);
        dBodySetGravityMode(driven.body, driven.flies ? 0 : 1);
        driven_.push_back(driven);
    }

    void before_step() override
    {
        for (Driven &driven : driven_)
        {
            turn_back(square_, from_ode(dBodyGetPosition(driven.body)), driven.velocity);
            Vector3 missing = driven.velocity - from_ode(dBodyGetLinearVel(driven.body));
            missing.z() = driven.flies ? missing.z() : 0;
            add_force(driven.body, mass_of(driven.body) / time_to_recover * missing);
        }
        for (const dBodyID body : huge_)
            turn_back(square_, body);
    }

    std::vector<Driven> driven_;
    std::vector<dBodyID> huge_; ///< those that move
};

Bounds terrain_bounds(int objects)
{
    const double half_side = half_side_of_square(objects) + object_radius;
    return {{0, 0, 0.5 * roof_height}, {half_side, half_side, 0.5 * roof_height}};
}
} // namespace

std::vector<WorldEntry> terrain_worlds()
{
    return {
        {Group::scene, "terrain",
         "small movers on a heightfield, a mesh and a plane, among boxes up to 10,000 times as long", 1000, usual_tick,
         &terrain_bounds, made_of<TerrainWorld>()},
        {Group::stepped, "terrain_stepped", "objects driven over and above a ground, among huge boxes", 1000,
         usual_tick, &terrain_bounds, made_of<DrivenWorld>()},
    };
}
} // namespace ode_predictive_space::worlds
