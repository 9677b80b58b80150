// Objects without contacts: some fall for ever and the others rest, or all fly through a room in steps that vary.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double rain_step = 0.1;      // seconds
constexpr int objects_per_drop = 5;    // one in five falls
constexpr double rain_density = 0.01;  // share of the volume
constexpr double frame_density = 0.05; // the same
constexpr double fastest = 11;         // m/s along each axis: a tenth of the radius in a tick

class FreeWorld : public ProgramWorld
{
protected:
    FreeWorld(const WorldSpec &spec, dSpaceID space, double step_seconds, double density)
        : ProgramWorld(spec, space, step_seconds), half_(Vector3::Constant(half_room(spec.objects, density)))
    {}

    bool take_contacts(const IndexPair &, const dContactGeom *, int) override { return true; }

    dGeomID make_geom(int number) const
    {
        const dSpaceID space = objects_.space();
        if (number % 3 == 0)
            return dCreateSphere(space, object_radius);
        return number % 3 == 1 ? dCreateBox(space, 0.12, 0.12, 0.12) : dCreateCapsule(space, 0.06, 0.08);
    }

    BodyState random_state()
    {
        BodyState state;
        state.position = random_.in_box(half_);
        state.orientation = random_.orientation();
        return state;
    }

    Vector3 half_; ///< half the room, metres
};

class RainWorld : public FreeWorld
{
public:
    RainWorld(const WorldSpec &spec, dSpaceID space) : FreeWorld(spec, space, rain_step, rain_density)
    {
        for (int i = 0; i < spec.objects; ++i)
        {
            const dGeomID geom = make_geom(i);
            const BodyState state = random_state();
            if (i % objects_per_drop == 0)
            {
                objects_.add_body(geom, 1, state);
                continue;
            }
            set_position(objects_.add_geom(geom), state.position);
            set_orientation(geom, state.orientation);
        }
    }
};

/// Bodies that steps move.
class FramesWorld : public FreeWorld
{
public:
    FramesWorld(const WorldSpec &spec, dSpaceID space, double variation)
        : FreeWorld(spec, space, usual_tick, frame_density)
    {
        vary_steps(variation);
        dWorldSetGravity(objects_.world(), 0, 0, 0);
        for (int i = 0; i < spec.objects; ++i)
        {
            BodyState state = random_state();
            state.velocity = random_.in_box(Vector3::Constant(fastest));
            state.angular_velocity = random_.in_box(Vector3::Constant(2));
            bodies_.push_back(objects_.add_body(make_geom(i), 1, state));
        }
    }

private:
    void before_step() override
    {
        for (const dBodyID body : bodies_)
            turn_back(room_of(half_), body);
    }

    std::vector<dBodyID> bodies_;
};

/// Geoms without bodies that are set to their places.
class SetFramesWorld : public FreeWorld
{
public:
    SetFramesWorld(const WorldSpec &spec, dSpaceID space, double variation)
        : FreeWorld(spec, space, usual_tick, frame_density)
    {
        vary_steps(variation);
        for (int i = 0; i < spec.objects; ++i)
        {
            states_.push_back(random_state());
            set_orientation(objects_.add_geom(make_geom(i)), states_.back().orientation);
            states_.back().velocity = random_.in_box(Vector3::Constant(fastest));
        }
    }

private:
    void before_step() override
    {
        for (std::size_t i = 0; i < states_.size(); ++i)
        {
            BodyState &state = states_[i];
            turn_back(room_of(half_), state.position, state.velocity);
            state.position += step() * state.velocity;
            set_position(objects_.geoms()[i], state.position);
        }
    }

    std::vector<BodyState> states_;
};

std::function<Bounds(int)> bounds_by(double density)
{
    return [density](int objects) { return cube(half_room(objects, density)); };
}

template <typename Kind> WorldEntry frames(const std::string &name, const char *moved_by, int percent)
{
    const std::string number = std::to_string(percent);
    return {Group::program,
            name + number,
            "objects that fly through a dense room in steps that vary by " + number + " %, moved by " + moved_by,
            1000,
            usual_tick,
            bounds_by(frame_density),
            made_of<Kind>(0.01 * percent)};
}
} // namespace

std::vector<WorldEntry> free_worlds()
{
    std::vector<WorldEntry> all = {{Group::program, "rain",
                                    "n objects of which a fifth falls for ever, in steps of 0.1 s", 1000, rain_step,
                                    bounds_by(rain_density), made_of<RainWorld>()}};
    for (const int percent : {0, 20, 50, 80})
    {
        all.push_back(frames<FramesWorld>("frames_", "the world", percent));
        all.push_back(frames<SetFramesWorld>("frames_set_", "setters", percent));
    }
    return all;
}
} // namespace ode_predictive_space::worlds
