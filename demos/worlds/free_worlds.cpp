// Objects without contacts: some fall for ever and the others rest, all fly through a room in steps that vary, or everything,
// or a tenth, moves at once.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double rain_step = 0.1;   // seconds
constexpr int objects_per_drop = 5; // one in five falls
constexpr double fastest = 11;      // m/s along each axis: a tenth of the radius in a tick

class FreeWorld : public ProgramWorld
{
protected:
    using ProgramWorld::ProgramWorld;

    bool take_contacts(const IndexPair &, const dContactGeom *, int) override { return true; }
};

class RoomfulWorld : public FreeWorld
{
protected:
    RoomfulWorld(const WorldSpec &spec, dSpaceID space, double step_seconds, double volume_fraction)
        : FreeWorld(spec, space, step_seconds), half_(Vector3::Constant(half_room(spec.objects, volume_fraction)))
    {}

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

class RainWorld : public RoomfulWorld
{
public:
    RainWorld(const WorldSpec &spec, dSpaceID space) : RoomfulWorld(spec, space, rain_step, thin)
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

class FramesWorld : public RoomfulWorld
{
public:
    FramesWorld(const WorldSpec &spec, dSpaceID space, double variation) : RoomfulWorld(spec, space, usual_tick, dense)
    {
        vary_steps(variation);
        dWorldSetGravity(objects_.world(), 0, 0, 0);
        for (int i = 0; i < spec.objects; ++i)
        {
            BodyState state = random_state();
            state.velocity = random_.in_box(Vector3::Constant(fastest));
            state.angular_velocity = random_.in_box(Vector3::Constant(2));
            objects_.add_body(make_geom(i), 1, state);
        }
    }

private:
    void before_step() override
    {
        for (const dBodyID body : objects_.bodies())
            turn_back(room_of(half_), body);
    }
};

/// Geoms without bodies that are set to their places.
class SetFramesWorld : public RoomfulWorld
{
public:
    SetFramesWorld(const WorldSpec &spec, dSpaceID space, double variation)
        : RoomfulWorld(spec, space, usual_tick, dense)
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
            bounds_by(dense),
            made_of<Kind>(0.01 * percent)};
}

constexpr double events_step = 0.005;

class EventsWorld : public FreeWorld
{
protected:
    EventsWorld(const WorldSpec &spec, dSpaceID space) : FreeWorld(spec, space, events_step)
    {
        dWorldSetGravity(objects_.world(), 0, 0, 0);
    }

    void add(dGeomID geom, const Vector3 &place, double fastest)
    {
        starts_.push_back({place, random_.orientation(), random_.in_box(Vector3::Constant(fastest))});
        objects_.add_body(geom, 1, starts_.back());
    }

    void before_step() override
    {
        if (tick_++ % ticks_between_events == 0)
            move_all();
    }
    virtual void move_all() {}

    int tick_ = 0;
    std::vector<BodyState> starts_;
};

class ResetWorld : public EventsWorld
{
public:
    ResetWorld(const WorldSpec &spec, dSpaceID space) : EventsWorld(spec, space)
    {
        for (int i = 0; i < spec.objects; ++i)
        {
            const Vector3 place(2 * (i % 10), 2 * (i / 10), 0.2);
            add(dCreateBox(space, 0.4, 0.4, 0.2), place, 0.5);
            for (int k = 1; k < 7; ++k)
                add(dCreateCapsule(space, 0.06, 0.25), place + k * Vector3(0.1, 0, 0.3), 0.5);
        }
    }

private:
    void move_all() override
    {
        for (std::size_t i = 0; i < starts_.size(); ++i)
            set_state(objects_.bodies()[i], starts_[i]);
    }
};

Bounds reset_bounds(int robots)
{
    const double rows = std::ceil(0.1 * robots); // the quadtree divides between robots
    return {{9, rows - 1, 1}, {11, rows + 1, 2}};
}

double half_side_of_boxes(int boxes)
{
    return 0.8 * std::cbrt(boxes);
}

/// Boxes that fly apart and are shifted along x, there and back.
class BoxesWorld : public EventsWorld
{
public:
    BoxesWorld(const WorldSpec &spec, dSpaceID space, double shift) : EventsWorld(spec, space), shift_(shift, 0, 0)
    {
        const Vector3 half = Vector3::Constant(half_side_of_boxes(spec.objects));
        for (int i = 0; i < spec.objects; ++i)
            add(dCreateBox(space, 0.5, 0.4, 0.3), random_.in_box(half), 2);
    }

private:
    void move_all() override
    {
        for (const dBodyID body : objects_.bodies())
            set_position(body, from_ode(dBodyGetPosition(body)) + shift_);
        shift_ = -shift_;
    }

    Vector3 shift_;
};

/// @param shift by which all boxes leap at once, metres
WorldEntry boxes(const std::string &name, const std::string &text, double shift)
{
    const auto bounds = [shift](int objects) -> Bounds {
        const double half = half_side_of_boxes(objects) + 2;
        return {{shift / 2, 0, 0}, {shift / 2 + half, half, half}};
    };
    return {Group::program, name, text, 1000, events_step, bounds, made_of<BoxesWorld>(shift)};
}

constexpr double segment = 0.1;     // of the belt, with the gap to the next one, metres
constexpr double belt_height = 0.5; // metres: ODE's hash space loses pairs around 0

/// A belt whose segments move along x, under boxes that sleep. In each tick a tenth of the segments leaps by half the belt.
class ConveyorWorld : public EventsWorld
{
public:
    ConveyorWorld(const WorldSpec &spec, dSpaceID space)
        : EventsWorld(spec, space), half_(segment / 2 * spec.objects), segments_(static_cast<std::size_t>(spec.objects))
    {
        for (int i = 0; i < spec.objects; ++i)
        {
            const BodyState state = {{segment * i - half_, 0, belt_height}, Quaternion::Identity(), {1, 0, 0}};
            objects_.add_body(dCreateBox(space, 0.09, 0.5, 0.02), 1, state);
        }
        for (int i = 0; i < spec.objects / 2; ++i)
        {
            const BodyState state = {{2 * segment * i - half_, random_.uniform(-0.2, 0.2), belt_height + 0.059}};
            dBodyDisable(objects_.add_body(dCreateBox(space, 0.1, 0.1, 0.1), 1, state));
        }
    }

private:
    void before_step() override
    {
        for (auto i = static_cast<std::size_t>(tick_++ % 10); i < segments_; i += 10)
        {
            const dBodyID body = objects_.bodies()[i];
            const Vector3 place = from_ode(dBodyGetPosition(body));
            set_position(body, place + Vector3(place.x() < 0 ? half_ : -half_, 0, 0));
        }
    }

    double half_;
    std::size_t segments_;
};

Bounds conveyor_bounds(int segments)
{
    return {{0, 0, belt_height}, {segment / 2 * segments + 1, 1, 1}};
}
} // namespace

std::vector<WorldEntry> free_worlds()
{
    std::vector<WorldEntry> all = {{Group::program, "rain",
                                    "n objects of which a fifth falls for ever, in steps of 0.1 s", 1000, rain_step,
                                    bounds_by(thin), made_of<RainWorld>()}};
    for (const int percent : {0, 20, 50, 80})
    {
        all.push_back(frames<FramesWorld>("frames_", "the world", percent));
        all.push_back(frames<SetFramesWorld>("frames_set_", "setters", percent));
    }
    return all;
}

std::vector<WorldEntry> event_worlds()
{
    std::vector<WorldEntry> all;
    for (const std::string later : {"", "_1", "_2"}) // benchmarks count other ticks of them
    {
        const std::string text = later.empty() ? "" : "; ticks after that: " + later.substr(1);
        all.push_back({Group::program, "reset" + later, "n robots of 7 geoms, all set back every 200 ticks" + text, 100,
                       events_step, &reset_bounds, made_of<ResetWorld>()});
        all.push_back(boxes("recentre" + later, "n boxes, all shifted by 1 km" + text, 1000));
        all.push_back(boxes("first" + later, "the first tick of n boxes that fly" + text, 0));
    }
    all.push_back({Group::program, "conveyor", "n segments of a belt, a tenth leaps in each tick", 200, events_step,
                   &conveyor_bounds, made_of<ConveyorWorld>()});
    return all;
}
} // namespace ode_predictive_space::worlds
