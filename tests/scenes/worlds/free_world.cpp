// Objects without contacts: some fall for ever and the others rest, or all fly through a room in steps that vary.

#include "demos/scenes/world_scene.h"
#include "tests/scenes/worlds/makers.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double rain_step = 0.1;      // seconds
constexpr int objects_per_drop = 5;    // one in five falls
constexpr double rain_density = 0.01;  // share of the volume
constexpr double frame_density = 0.05; // the same
constexpr double fastest_in_free = 11; // m/s along each axis: a tenth of the radius in a tick

dGeomID make_geom(dSpaceID space, int number)
{
    switch (number % 3)
    {
    case 0:
        return dCreateSphere(space, object_radius);
    case 1:
        return dCreateBox(space, 0.12, 0.12, 0.12);
    default:
        return dCreateCapsule(space, 0.06, 0.08);
    }
}

class FreeWorld : public WorldScene
{
protected:
    FreeWorld(const SceneSpec &spec, dSpaceID space, double step_seconds, double density)
        : WorldScene(spec, space, step_seconds), half_(half_room(spec.objects, density))
    {}

    bool take_contacts(const IndexPair &, const dContactGeom *, int) override { return true; }

    BodyState random_state()
    {
        BodyState state;
        state.position = random_.in_box(Vector3::Constant(half_));
        state.orientation = random_.orientation();
        return state;
    }

    /// Let what has left the room come back.
    bool turn_back(const Vector3 &position, Vector3 &velocity) const
    {
        const auto leaves = position.array().abs() > half_ && position.array() * velocity.array() > 0;
        const bool turns = leaves.any();
        velocity = leaves.select(-velocity, velocity);
        return turns;
    }

    double half_; ///< half the side of the room, metres
};

class RainWorld : public FreeWorld
{
public:
    RainWorld(const SceneSpec &spec, dSpaceID space) : FreeWorld(spec, space, rain_step, rain_density)
    {
        for (int i = 0; i < spec.objects; ++i)
        {
            const dGeomID geom = make_geom(space, i);
            const BodyState state = random_state();
            if (i % objects_per_drop == 0)
            {
                add_body(objects_, geom, 1, state);
                continue;
            }
            set_position(objects_.add_geom(geom), state.position);
            set_orientation(geom, state.orientation);
        }
    }
};

/// Bodies that the world moves.
class FramesWorld : public FreeWorld
{
public:
    FramesWorld(const SceneSpec &spec, dSpaceID space, double variation)
        : FreeWorld(spec, space, usual_tick, frame_density)
    {
        vary_steps(variation);
        dWorldSetGravity(objects_.world(), 0, 0, 0);
        for (int i = 0; i < spec.objects; ++i)
        {
            BodyState state = random_state();
            state.velocity = random_.in_box(Vector3::Constant(fastest_in_free));
            state.angular_velocity = random_.in_box(Vector3::Constant(2));
            bodies_.push_back(add_body(objects_, make_geom(space, i), 1, state));
        }
    }

private:
    void before_step() override
    {
        for (const dBodyID body : bodies_)
        {
            Vector3 velocity = from_ode(dBodyGetLinearVel(body));
            if (turn_back(from_ode(dBodyGetPosition(body)), velocity))
                dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
        }
    }

    std::vector<dBodyID> bodies_;
};

/// Geoms without bodies that are set to their places.
class SetFramesWorld : public FreeWorld
{
public:
    SetFramesWorld(const SceneSpec &spec, dSpaceID space, double variation)
        : FreeWorld(spec, space, usual_tick, frame_density)
    {
        vary_steps(variation);
        for (int i = 0; i < spec.objects; ++i)
        {
            const BodyState state = random_state();
            set_orientation(objects_.add_geom(make_geom(space, i)), state.orientation);
            places_.push_back(state.position);
            velocities_.push_back(random_.in_box(Vector3::Constant(fastest_in_free)));
        }
    }

private:
    void before_step() override
    {
        for (std::size_t i = 0; i < places_.size(); ++i)
        {
            turn_back(places_[i], velocities_[i]);
            places_[i] += step() * velocities_[i];
            set_position(objects_.geom(static_cast<std::uint32_t>(i)), places_[i]);
        }
    }

    std::vector<Vector3> places_;
    std::vector<Vector3> velocities_;
};

SceneBounds bounds_of(const SceneSpec &spec, double density)
{
    return {Vector3::Zero(), Vector3::Constant(half_room(spec.objects, density))};
}
} // namespace

SceneRecipe rain_world(const SceneSpec &spec)
{
    return {[](const SceneSpec &made, dSpaceID space) { return std::make_unique<RainWorld>(made, space); },
            bounds_of(spec, rain_density), rain_step};
}

SceneRecipe frames_world(const SceneSpec &spec, double variation)
{
    return {[variation](const SceneSpec &made, dSpaceID space) {
                return std::make_unique<FramesWorld>(made, space, variation);
            },
            bounds_of(spec, frame_density)};
}

SceneRecipe set_frames_world(const SceneSpec &spec, double variation)
{
    return {[variation](const SceneSpec &made, dSpaceID space) {
                return std::make_unique<SetFramesWorld>(made, space, variation);
            },
            bounds_of(spec, frame_density)};
}
} // namespace ode_predictive_space::scenes
