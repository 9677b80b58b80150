// Worlds with ticks in which everything, or a tenth, moves at once, without gravity and contacts.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double events_step = 0.005;

class EventsWorld : public ProgramWorld
{
protected:
    EventsWorld(const WorldSpec &spec, dSpaceID space) : ProgramWorld(spec, space, events_step)
    {
        dWorldSetGravity(objects_.world(), 0, 0, 0);
    }

    bool take_contacts(const IndexPair &, const dContactGeom *, int) override { return true; }

    void add(dGeomID geom, const Vector3 &place, double fastest)
    {
        starts_.push_back({place, random_.orientation(), random_.in_box(Vector3::Constant(fastest))});
        bodies_.push_back(objects_.add_body(geom, 1, starts_.back()));
    }

    void before_step() override
    {
        if (tick_++ % ticks_between_events == 0)
            move_all();
    }
    virtual void move_all() {}

    int tick_ = 0;
    std::vector<dBodyID> bodies_;
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
        for (std::size_t i = 0; i < bodies_.size(); ++i)
            set_state(bodies_[i], starts_[i]);
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
        for (const dBodyID body : bodies_)
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
    ConveyorWorld(const WorldSpec &spec, dSpaceID space) : EventsWorld(spec, space), half_(segment / 2 * spec.objects)
    {
        for (int i = 0; i < spec.objects; ++i)
        {
            const BodyState state = {{segment * i - half_, 0, belt_height}, Quaternion::Identity(), {1, 0, 0}};
            bodies_.push_back(objects_.add_body(dCreateBox(space, 0.09, 0.5, 0.02), 1, state));
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
        for (auto i = static_cast<std::size_t>(tick_++ % 10); i < bodies_.size(); i += 10)
        {
            const Vector3 place = from_ode(dBodyGetPosition(bodies_[i]));
            set_position(bodies_[i], place + Vector3(place.x() < 0 ? half_ : -half_, 0, 0));
        }
    }

    double half_;
};

Bounds conveyor_bounds(int segments)
{
    return {{0, 0, belt_height}, {segment / 2 * segments + 1, 1, 1}};
}
} // namespace

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
