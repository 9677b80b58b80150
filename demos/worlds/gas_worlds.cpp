// Objects that follow a motion which nothing disturbs: gas, game, classes, still, probe, churn, explosion, teleport, query.
//
// Their bodies are moved by dBodySetPosition() and dBodySetQuaternion() and have the velocities of that motion; ODE's world is
// never stepped, and objects fly through one another.

#include "demos/worlds/asking.h"
#include "demos/worlds/gas_room.h"
#include "demos/worlds/lists.h"

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double calm_speed = 0.01 * object_radius; // metres per tick
constexpr double game_speed = 0.1 * object_radius;  // metres per tick
constexpr double fastest_spin = 0.005;              // radians per tick
constexpr double churned_per_tick = 0.01;           // share of the objects

struct GasSettings
{
    double volume_fraction = thin;
    double moving = 0.5;           ///< share of the objects
    double max_speed = calm_speed; ///< metres per tick
    int shapes = 3;                ///< the objects have the first so many shapes
};

/// Objects that fly and bounce off the walls of a room that has no geoms.
class GasWorld : public World
{
public:
    GasWorld(const WorldSpec &spec, dSpaceID space, const GasSettings &settings = {}, bool with_probe = false)
        : World(spec, space), settings_(settings),
          half_(half_gas_room(spec.objects, settings.volume_fraction) - object_radius),
          room_(room_of(Vector3::Constant(half_)))
    {
        if (with_probe)
            objects_.add_geom(dCreateSphere(space, object_radius));
        for (int i = 0; i < spec.objects; ++i)
            add_object(static_cast<Shape>(i % settings.shapes), is_of_share(i, settings.moving));
    }

    void advance() override
    {
        for (Mover &mover : movers_)
        {
            BodyState &state = mover.state;
            state.position += usual_tick * state.velocity;
            state.orientation = (mover.turn * state.orientation).normalized();
            set_position(mover.object.body, state.position);
            set_orientation(mover.object.body, state.orientation);
            if (turn_back(room_, state.position, state.velocity))
                set_velocity(mover.object.body, state.velocity);
        }
    }

protected:
    struct Mover
    {
        Object object;
        BodyState state; ///< kept here too, so that the motion does not depend on how ODE rounds
        Quaternion turn; ///< per tick
    };

    void add_object(Shape shape, bool moves)
    {
        const Vector3 position = random_place();
        const Quaternion orientation = random_.orientation();
        if (!moves)
        {
            still_.push_back(objects_.add_still(shape, position, orientation));
            return;
        }
        Mover mover;
        mover.state.position = position;
        mover.state.orientation = orientation;
        mover.state.velocity = random_.uniform(0, settings_.max_speed) / usual_tick * random_.direction();
        const Vector3 axis = random_.direction();
        const double spin = random_.uniform(0, fastest_spin);
        mover.state.angular_velocity = spin / usual_tick * axis;
        mover.turn = Quaternion(Eigen::AngleAxisd(spin, axis));
        mover.object = objects_.add_moving(shape, mover.state, 1000);
        movers_.push_back(mover);
    }

    Vector3 random_place() { return random_.in_box(Vector3::Constant(half_)); }

    GasSettings settings_;
    double half_; ///< half the side of the cube that the objects' centres stay in, metres
    Eigen::AlignedBox3d room_;
    std::vector<Mover> movers_;
    std::vector<Object> still_;
};

/// A probe on a hand's path among still objects.
class ProbeWorld : public GasWorld
{
public:
    ProbeWorld(const WorldSpec &spec, dSpaceID space)
        : GasWorld(spec, space, {thin, 0}, true), hand_(hand_in(half_), spec.seed)
    {}

    void advance() override
    {
        report_.position = hand_.position(++tick_ * usual_tick);
        set_position(objects_.geom(0), report_.position);
    }

    const ProbeReport *probe() const override { return &report_; }

private:
    haptics::HandPath hand_;
    ProbeReport report_;
    int tick_ = 0;
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
        const Object old = moves ? movers_[number].object : still_[static_cast<std::size_t>(place)];
        if (moves)
            movers_.erase(movers_.begin() + place);
        else
            still_.erase(still_.begin() + place);
        objects_.destroy(old);
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
            set_state(mover.object.body, mover.state);
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
        for (const Object &object : still_)
            set_position(object.geom, random_place());
    }
};

template <typename Kind>
WorldEntry entry(const char *name, const char *text, const GasSettings &settings, bool share_can_be_chosen = false)
{
    const auto prepare = [=](const WorldSpec &spec) {
        GasSettings chosen = settings;
        if (share_can_be_chosen && spec.moving >= 0)
            chosen.moving = spec.moving;
        return made_of<Kind>(chosen)(spec);
    };
    return {Group::scene, name, text, 1000, usual_tick, gas_bounds(settings.volume_fraction), prepare};
}
} // namespace

std::vector<WorldEntry> gas_worlds()
{
    constexpr GasSettings still = {thin, 0};
    return {
        entry<GasWorld>("gas",
                        "half of the objects still, the others fly at up to 1 mm per tick and bounce off the walls", {},
                        true),
        entry<GasWorld>("game", "a dense room in which everything flies, at up to 10 mm per tick",
                        {dense, 1, game_speed}),
        entry<GasWorld>("classes", "game with spheres, boxes, capsules, meshes, cylinders and convexes",
                        {dense, 1, game_speed, 6}),
        entry<GasWorld>("still", "nothing moves", still),
        {Group::scene, "probe", "one hand-driven probe among still objects", 1000, usual_tick, gas_bounds(thin),
         made_of<ProbeWorld>()},
        entry<ChurnWorld>("churn", "gas in which 1 % of the objects are destroyed and made anew in each tick", {},
                          true),
        entry<ExplosionWorld>("explosion", "a calm scene in which all velocities change in one tick, every 200 ticks",
                              {thin, 1}),
        entry<TeleportWorld>("teleport", "every object jumps to a random place in each tick", still),
        entry<Asking<GasWorld>>("query", "gas, with 20 spheres and 20 rays that ask in each tick what is near them", {},
                                true),
    };
}
} // namespace ode_predictive_space::worlds
