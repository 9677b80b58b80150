// Gas and the worlds like it, moved in two ways: gas, game, classes, still, churn, explosion, teleport and their namesakes
// _stepped; and an engine that sets every pose. In the first ones nothing disturbs the motion: bodies are moved by
// dBodySetPosition() and dBodySetQuaternion() and have the velocities that go with it; ODE's world is never stepped, and
// objects fly through one another. The others float, are moved by steps and pushed by contacts.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double calm_speed = 0.01 * object_radius; // metres per tick
constexpr double game_speed = 0.1 * object_radius;  // metres per tick
constexpr double fastest_spin = 0.005;              // radians per tick
constexpr double churned_per_tick = 0.01;           // share of the objects
constexpr double density = 1000;                    // kg/m^3
constexpr double fastest_turn = 5;                  // rad/s
constexpr int objects_per_moving_pose = 20;
constexpr double half_move = -1; // unless the specification has another share

struct GasSettings
{
    double volume_fraction;
    double moving;    ///< share of the objects
    double max_speed; ///< metres per tick, or m/s
    int shapes = 3;   ///< the objects have the first so many shapes
};

/// Whether an object is one of the share that moves: every k-th is, where k = 1 / share.
bool is_of_share(int number, double share)
{
    return std::floor((number + 1) * share) > std::floor(number * share);
}

/// Objects that fly and bounce off the walls of a room that has no geoms.
class GasWorld : public World
{
public:
    GasWorld(const WorldSpec &spec, dSpaceID space, const GasSettings &settings)
        : World(spec, space), settings_(settings),
          half_(Vector3::Constant(half_gas_room(spec.objects, settings.volume_fraction) - object_radius))
    {
        const double share_of_spec = spec.moving < 0 ? 0.5 : spec.moving;
        const double share = settings.moving == half_move ? share_of_spec : settings.moving;
        for (int i = 0; i < spec.objects; ++i)
            add_object(static_cast<Shape>(i % settings.shapes), is_of_share(i, share));
    }

    void advance() override
    {
        for (Mover &mover : movers_)
        {
            BodyState &state = mover.state;
            state.position += usual_tick * state.velocity;
            state.orientation = (mover.turn * state.orientation).normalized();
            set_position(mover.body, state.position);
            set_orientation(mover.body, state.orientation);
            if (turn_back(room_of(half_), state.position, state.velocity))
                set_velocity(mover.body, state.velocity);
        }
    }

protected:
    struct Mover
    {
        Shape shape;
        dBodyID body;
        BodyState state; ///< kept here too, so that the motion does not depend on how ODE rounds
        Quaternion turn; ///< per tick
    };
    struct Still
    {
        Shape shape;
        dGeomID geom;
    };

    void add_object(Shape shape, bool moves)
    {
        const Vector3 position = random_place();
        const Quaternion orientation = random_.orientation();
        if (!moves)
        {
            still_.push_back({shape, objects_.add_still(shape, position, orientation)});
            return;
        }
        Mover mover{};
        mover.shape = shape;
        mover.state.position = position;
        mover.state.orientation = orientation;
        mover.state.velocity = random_.uniform(0, settings_.max_speed) / usual_tick * random_.direction();
        const Vector3 axis = random_.direction();
        const double spin = random_.uniform(0, fastest_spin);
        mover.state.angular_velocity = spin / usual_tick * axis;
        mover.turn = Quaternion(Eigen::AngleAxisd(spin, axis));
        mover.body = objects_.add_moving(shape, mover.state, 1000);
        movers_.push_back(mover);
    }

    Vector3 random_place() { return random_.in_box(half_); }

    GasSettings settings_;
    Vector3 half_; ///< half the cube that the objects' centres stay in, metres
    std::vector<Mover> movers_;
    std::vector<Still> still_;
};

class ChurnWorld : public GasWorld
{
public:
    using GasWorld::GasWorld;

    void advance() override
    {
        GasWorld::advance();
        // Fractions of an object accumulate, so that a small world has 1 % of churn, too.
        const std::size_t objects = movers_.size() + still_.size();
        owed_ += churned_per_tick * static_cast<double>(objects);
        for (; owed_ >= 1; owed_ -= 1)
            replace(random_.index(objects));
    }

private:
    void replace(std::size_t number)
    {
        const bool moves = number < movers_.size();
        const auto place = static_cast<std::ptrdiff_t>(moves ? number : number - movers_.size());
        const Still old = moves ? Still{movers_[number].shape, dBodyGetFirstGeom(movers_[number].body)}
                                : still_[static_cast<std::size_t>(place)];
        if (moves)
            movers_.erase(movers_.begin() + place);
        else
            still_.erase(still_.begin() + place);
        objects_.destroy(old.geom);
        add_object(old.shape, moves);
    }

    double owed_ = 0;
};

class ExplosionWorld : public GasWorld
{
public:
    using GasWorld::GasWorld;

    void advance() override
    {
        if (++tick_ % ticks_between_explosions == 0)
            explode(random_place());
        GasWorld::advance();
    }

private:
    void explode(const Vector3 &centre)
    {
        for (Mover &mover : movers_)
        {
            const Vector3 outwards = (mover.state.position - centre).normalized();
            mover.state.velocity = random_.uniform(0, settings_.max_speed) / usual_tick * outwards;
            set_state(mover.body, mover.state);
        }
    }

    int tick_ = 0;
};

class TeleportWorld : public GasWorld
{
public:
    using GasWorld::GasWorld;

    void advance() override
    {
        for (const Still &still : still_)
            set_position(still.geom, random_place());
    }
};

/// They bounce off one another and turn back at the sides of a room that has no geoms. They begin in random places, with speeds
/// up to a limit. Those that do not move have no body.
class FloatingWorld : public SteppedWorld
{
public:
    FloatingWorld(const WorldSpec &spec, dSpaceID space, const GasSettings &settings)
        : SteppedWorld(spec, space, usual_tick),
          half_(Vector3::Constant(half_gas_room(spec.objects, settings.volume_fraction) - object_radius))
    {
        dWorldSetContactMaxCorrectingVel(objects_.world(), 1); // what overlaps at the start is not blasted apart
        let_bounce(0, 1, 0.01);
        for (int i = 0; i < spec.objects; ++i)
        {
            const BodyState state = random_state(settings.max_speed);
            const auto shape = static_cast<Shape>(i % settings.shapes);
            if (is_of_share(i, settings.moving))
                objects_.add_moving(shape, state, density);
            else
                objects_.add_still(shape, state.position, state.orientation);
        }
    }

protected:
    FloatingWorld(const WorldSpec &spec, dSpaceID space)
        : SteppedWorld(spec, space, usual_tick),
          half_(Vector3::Constant(half_gas_room(spec.objects, thin) - object_radius))
    {}

    BodyState random_state(double max_speed)
    {
        BodyState state;
        state.position = random_.in_box(half_);
        state.orientation = random_.orientation();
        state.velocity = random_.uniform(0, max_speed) * random_.direction();
        state.angular_velocity = random_.uniform(0, fastest_turn) * random_.direction();
        return state;
    }

    void before_step() override
    {
        for (const dBodyID floater : objects_.bodies())
            turn_back(room_of(half_), floater);
    }

    Vector3 half_; ///< half the cube in which the centres stay, metres
};

/// All objects jump to a random place after each step, and come to a stop there.
class JumpingWorld : public FloatingWorld
{
public:
    JumpingWorld(const WorldSpec &spec, dSpaceID space) : FloatingWorld(spec, space, {thin, 1, 0}) {}

    void advance() override
    {
        FloatingWorld::advance();
        for (const dBodyID floater : objects_.bodies())
        {
            BodyState state;
            state.position = random_.in_box(half_);
            state.orientation = state_of(floater).orientation;
            set_state(floater, state);
        }
    }
};

/// Moves as in a physics engine that uses ODE for contacts alone, as DART does. The geoms have no bodies in ODE. The engine
/// sets every pose at every tick, but only one object in twenty moves.
class PoseSettingWorld : public FloatingWorld
{
public:
    PoseSettingWorld(const WorldSpec &spec, dSpaceID space) : FloatingWorld(spec, space)
    {
        for (int i = 0; i < spec.objects; ++i)
        {
            poses_.push_back(random_state(1));
            objects_.add_still(static_cast<Shape>(i % 3), poses_.back().position, poses_.back().orientation);
            if (i % objects_per_moving_pose == 0)
            {
                floaters_.push_back(dBodyCreate(objects_.world()));
                set_state(floaters_.back(), poses_.back());
            }
        }
    }

    void advance() override
    {
        FloatingWorld::advance();
        for (std::size_t i = 0; i < floaters_.size(); ++i)
            poses_[objects_per_moving_pose * i] = state_of(floaters_[i]);
        for (std::size_t i = 0; i < poses_.size(); ++i)
        {
            set_position(objects_.geoms()[i], poses_[i].position);
            set_orientation(objects_.geoms()[i], poses_[i].orientation);
        }
    }

private:
    void before_step() override
    {
        for (const dBodyID floater : floaters_)
            turn_back(room_of(half_), floater);
    }

    std::vector<BodyState> poses_;  ///< of each geom
    std::vector<dBodyID> floaters_; ///< of every twentieth
};

template <typename Kind, typename... Settings>
WorldEntry entry(Group group, const char *name, const char *text, double volume_fraction, Settings... settings)
{
    return {group, name, text, 1000, usual_tick, gas_bounds(volume_fraction), made_of<Kind>(settings...)};
}
} // namespace

std::vector<WorldEntry> gas_worlds()
{
    const GasSettings gas = {thin, half_move, calm_speed}, game = {dense, 1, game_speed},
                      classes = {dense, 1, game_speed, 6}, all_move = {thin, 1, calm_speed}, still = {thin, 0, 0};
    return {
        entry<GasWorld>(Group::scene, "gas",
                        "half of the objects still, the others fly at up to 1 mm per tick and bounce off the walls",
                        thin, gas),
        entry<GasWorld>(Group::scene, "game", "a dense room in which everything flies, at up to 10 mm per tick", dense,
                        game),
        entry<GasWorld>(Group::scene, "classes", "game with spheres, boxes, capsules, meshes, cylinders and convexes",
                        dense, classes),
        entry<GasWorld>(Group::scene, "still", "nothing moves", thin, still),
        entry<ChurnWorld>(Group::scene, "churn",
                          "gas in which 1 % of the objects are destroyed and made anew in each tick", thin, gas),
        entry<ExplosionWorld>(Group::scene, "explosion",
                              "a calm scene in which all velocities change in one tick, every 200 ticks", thin,
                              all_move),
        entry<TeleportWorld>(Group::scene, "teleport", "every object jumps to a random place in each tick", thin,
                             still),
        entry<FloatingWorld>(Group::stepped, "gas_stepped",
                             "half of the objects still, the others float at up to 1 mm per tick", thin,
                             GasSettings{thin, 0.5, 1}),
        entry<FloatingWorld>(Group::stepped, "game_stepped",
                             "a dense room in which everything floats, at up to 10 mm per tick", dense,
                             GasSettings{dense, 1, 10}),
        entry<FloatingWorld>(Group::stepped, "classes_stepped",
                             "game with spheres, boxes, capsules, meshes, cylinders and convexes", dense,
                             GasSettings{dense, 1, 10, 6}),
        entry<JumpingWorld>(Group::stepped, "teleport_stepped", "every object jumps to a random place after each step",
                            thin),
        entry<PoseSettingWorld>(Group::stepped, "dart",
                                "geoms without bodies; every pose is set at every tick, 5 % are new", thin),
    };
}
} // namespace ode_predictive_space::worlds
