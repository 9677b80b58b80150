#include "demos/scenes/kinematic_scenes.h"

#include "demos/scenes/scene_objects.h"
#include "ode_predictive_space/haptics/device/random.h"
#include "ode_predictive_space/haptics/hand_path.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double calm_speed = 0.01 * object_radius; // metres per tick
constexpr double game_speed = 0.1 * object_radius;  // metres per tick
constexpr double fastest_spin = 0.005;              // radians per tick
constexpr double churned_per_tick = 0.01;           // share of the objects

struct Mover
{
    Object object;
    BodyState state; ///< kept here too, so that the motion does not depend on how ODE rounds
    Quaternion turn; ///< per tick
};

/// The differences between gas, game, classes and still; the other scenes build on them.
struct GasSettings
{
    double volume_fraction = 0.01;
    double moving = 0.5;           ///< share of the objects
    double max_speed = calm_speed; ///< metres per tick
    int shapes = 3;                ///< the objects have the first so many shapes
};

GasSettings gas_settings(const SceneSpec &spec)
{
    GasSettings settings;
    if (spec.name == "game")
        settings = {0.05, 1, game_speed};
    else if (spec.name == "classes")
        settings = {0.05, 1, game_speed, 6};
    else if (spec.name == "still" || spec.name == "probe" || spec.name == "teleport")
        settings.moving = 0;
    else if (spec.name == "explosion")
        settings.moving = 1;
    else if (spec.moving >= 0)
        settings.moving = spec.moving;
    return settings;
}

/// Objects that fly and bounce off the walls of a room that has no geoms.
class GasScene : public Scene
{
public:
    GasScene(const SceneSpec &spec, dSpaceID space)
        : settings_(gas_settings(spec)), half_(half_room(spec.objects, settings_.volume_fraction) - object_radius),
          random_(spec.seed), objects_(space)
    {
        half_ = std::max(half_, object_radius);
    }

    void advance() override
    {
        for (Mover &mover : movers_)
            fly(mover);
    }

    void respond(const std::vector<IndexPair> &) override {}
    std::size_t contacts() const override { return 0; }
    bool moves_by_itself() const override { return true; }
    const std::vector<dGeomID> &geoms() const override { return objects_.geoms(); }
    const ProbeReport *probe() const override { return nullptr; }

protected:
    void fill(int count)
    {
        for (int i = 0; i < count; ++i)
        {
            // Every k-th object moves, where k = 1 / share.
            const bool moves = std::floor((i + 1) * settings_.moving) > std::floor(i * settings_.moving);
            add_object(static_cast<Shape>(i % settings_.shapes), moves);
        }
    }

    void add_object(Shape shape, bool moves)
    {
        const Vector3 position = random_.in_box(Vector3::Constant(half_));
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
    haptics::Random random_;
    SceneObjects objects_;
    std::vector<Mover> movers_;
    std::vector<Object> still_;

private:
    void fly(Mover &mover)
    {
        BodyState &state = mover.state;
        state.position += usual_tick * state.velocity;
        state.orientation = (mover.turn * state.orientation).normalized();
        set_position(mover.object.body, state.position);
        set_orientation(mover.object.body, state.orientation);
        if (bounce(state))
            dBodySetLinearVel(mover.object.body, state.velocity.x(), state.velocity.y(), state.velocity.z());
    }

    bool bounce(BodyState &state) const
    {
        bool bounced = false;
        for (int axis = 0; axis < 3; ++axis)
        {
            if (std::abs(state.position[axis]) > half_ && state.position[axis] * state.velocity[axis] > 0)
            {
                state.velocity[axis] = -state.velocity[axis];
                bounced = true;
            }
        }
        return bounced;
    }
};

class PlainScene : public GasScene
{
public:
    PlainScene(const SceneSpec &spec, dSpaceID space) : GasScene(spec, space) { fill(spec.objects); }
};

class ProbeScene : public GasScene
{
public:
    ProbeScene(const SceneSpec &spec, dSpaceID space) : GasScene(spec, space), hand_(hand_settings(half_), spec.seed)
    {
        probe_ = objects_.add_geom(dCreateSphere(space, object_radius));
        fill(spec.objects);
    }

    void advance() override
    {
        ++tick_;
        report_.position = hand_.position(tick_ * usual_tick);
        set_position(probe_, report_.position);
    }

    const ProbeReport *probe() const override { return &report_; }

private:
    static haptics::HandPathSettings hand_settings(double half_room)
    {
        haptics::HandPathSettings settings;
        settings.scale = half_room / settings.half_workspace;
        return settings;
    }

    haptics::HandPath hand_;
    dGeomID probe_;
    ProbeReport report_;
    int tick_ = 0;
};

class ChurnScene : public GasScene
{
public:
    ChurnScene(const SceneSpec &spec, dSpaceID space) : GasScene(spec, space) { fill(spec.objects); }

    void advance() override
    {
        GasScene::advance();
        // Fractions of an object accumulate, so that a small scene has 1 % of churn, too.
        owed_ += churned_per_tick * static_cast<double>(movers_.size() + still_.size());
        for (; owed_ >= 1; owed_ -= 1)
            replace(random_.index(movers_.size() + still_.size()));
    }

private:
    void replace(std::size_t number)
    {
        const bool moves = number < movers_.size();
        Object old;
        if (moves)
        {
            old = movers_[number].object;
            movers_.erase(movers_.begin() + static_cast<std::ptrdiff_t>(number));
        }
        else
        {
            const std::size_t position = number - movers_.size();
            old = still_[position];
            still_.erase(still_.begin() + static_cast<std::ptrdiff_t>(position));
        }
        objects_.destroy(old);
        add_object(old.shape, moves);
    }

    double owed_ = 0;
};

class ExplosionScene : public GasScene
{
public:
    ExplosionScene(const SceneSpec &spec, dSpaceID space) : GasScene(spec, space) { fill(spec.objects); }

    void advance() override
    {
        if (++tick_ % ticks_between_explosions == 0)
            explode(random_place());
        GasScene::advance();
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

class TeleportScene : public GasScene
{
public:
    TeleportScene(const SceneSpec &spec, dSpaceID space) : GasScene(spec, space) { fill(spec.objects); }

    void advance() override
    {
        for (const Object &object : still_)
            set_position(object.geom, random_place());
    }
};
} // namespace

double kinematic_half_room(const std::string &name, int objects)
{
    SceneSpec spec;
    spec.name = name;
    return std::max(half_room(objects, gas_settings(spec).volume_fraction), 2 * object_radius);
}

std::unique_ptr<Scene> make_kinematic_scene(const SceneSpec &spec, dSpaceID space)
{
    if (spec.name == "probe")
        return std::make_unique<ProbeScene>(spec, space);
    if (spec.name == "churn")
        return std::make_unique<ChurnScene>(spec, space);
    if (spec.name == "explosion")
        return std::make_unique<ExplosionScene>(spec, space);
    if (spec.name == "teleport")
        return std::make_unique<TeleportScene>(spec, space);
    return std::make_unique<PlainScene>(spec, space);
}
} // namespace ode_predictive_space::scenes
