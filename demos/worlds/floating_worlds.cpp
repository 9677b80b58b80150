// Objects that float through a room without gravity, moved by steps and pushed by contacts: gas, game, classes, teleport and
// query once more; and an engine that sets every pose.

#include "demos/worlds/asking.h"
#include "demos/worlds/gas_room.h"
#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double density = 1000;   // kg/m^3
constexpr double fastest_turn = 5; // rad/s
constexpr int objects_per_moving_pose = 20;

struct FloatingSettings
{
    double volume_fraction = thin;
    double moving = 0.5;  ///< share of the objects
    double max_speed = 1; ///< m/s
    int shapes = 3;       ///< the objects have the first so many shapes
};

/// They bounce off one another and turn back at the sides of a room that has no geoms. They begin in random places, with speeds up
/// to a limit. Those that do not move have no body.
class FloatingWorld : public SteppedWorld
{
public:
    FloatingWorld(const WorldSpec &spec, dSpaceID space, const FloatingSettings &settings)
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
                floaters_.push_back(objects_.add_moving(shape, state, density).body);
            else
                objects_.add_still(shape, state.position, state.orientation);
        }
    }

protected:
    /// Without objects.
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
        for (const dBodyID floater : floaters_)
            turn_back(room_of(half_), floater);
    }

    Vector3 half_; ///< half the cube in which the centres stay, metres
    std::vector<dBodyID> floaters_;
};

/// All objects jump to a random place after each step, and come to a stop there.
class JumpingWorld : public FloatingWorld
{
public:
    JumpingWorld(const WorldSpec &spec, dSpaceID space) : FloatingWorld(spec, space, {thin, 1, 0}) {}

    void advance() override
    {
        FloatingWorld::advance();
        for (const dBodyID floater : floaters_)
        {
            BodyState state = state_of(floater);
            state.position = random_.in_box(half_);
            state.velocity = Vector3::Zero();
            state.angular_velocity = Vector3::Zero();
            set_state(floater, state);
        }
    }
};

/// A physics engine that has a world of its own and uses ODE to find contacts, as DART does: its geoms have no bodies in ODE, and
/// at every tick it sets every pose, though one object in twenty moves.
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
    std::vector<BodyState> poses_; ///< of each geom
};

template <typename Kind, typename... Settings>
WorldEntry entry(const char *name, const char *text, double volume_fraction, Settings... settings)
{
    return {Group::stepped, name, text, 1000, usual_tick, gas_bounds(volume_fraction), made_of<Kind>(settings...)};
}
} // namespace

std::vector<WorldEntry> floating_worlds()
{
    const FloatingSettings gas, game = {dense, 1, 10}, classes = {dense, 1, 10, 6};
    return {
        entry<FloatingWorld>("gas_stepped", "half of the objects still, the others float at up to 1 mm per tick", thin,
                             gas),
        entry<FloatingWorld>("game_stepped", "a dense room in which everything floats, at up to 10 mm per tick", dense,
                             game),
        entry<FloatingWorld>("classes_stepped", "game with spheres, boxes, capsules, meshes, cylinders and convexes",
                             dense, classes),
        entry<JumpingWorld>("teleport_stepped", "every object jumps to a random place after each step", thin),
        entry<PoseSettingWorld>("dart", "geoms without bodies; every pose is set at every tick, 5 % are new", thin),
        entry<Asking<FloatingWorld>>(
            "ask", "gas without dSpaceCollide(): 20 spheres ask in each tick what is near them", thin, gas),
    };
}
} // namespace ode_predictive_space::worlds
