// Worlds with ticks in which everything, or a tenth, moves at once, without gravity and contacts.

#include "demos/scenes/world_scene.h"
#include "tests/scenes/worlds/makers.h"
#include "tests/scenes/worlds/worlds.h"

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double events_step = 0.005;

class EventsWorld : public WorldScene
{
protected:
    EventsWorld(const SceneSpec &spec, dSpaceID space) : WorldScene(spec, space, events_step)
    {
        dWorldSetGravity(objects_.world(), 0, 0, 0);
    }

    bool take_contacts(const IndexPair &, const dContactGeom *, int) override { return true; }

    void add(dGeomID geom, const Vector3 &place, double fastest)
    {
        starts_.push_back({place, random_.orientation(), random_.in_box(Vector3::Constant(fastest))});
        bodies_.push_back(add_body(objects_, geom, 1, starts_.back()));
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
    ResetWorld(const SceneSpec &spec, dSpaceID space) : EventsWorld(spec, space)
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

double half_side_of_boxes(int boxes)
{
    return 0.8 * std::cbrt(boxes);
}

/// Boxes that fly apart and are shifted along x, there and back.
class BoxesWorld : public EventsWorld
{
public:
    BoxesWorld(const SceneSpec &spec, dSpaceID space, double shift) : EventsWorld(spec, space), shift_(shift, 0, 0)
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

constexpr double segment = 0.1;     // of the belt, with the gap to the next one, metres
constexpr double belt_height = 0.5; // metres: ODE's hash space loses pairs around 0

/// A belt whose segments move along x, under boxes that sleep. In each tick a tenth of the segments leaps by half the belt.
class ConveyorWorld : public EventsWorld
{
public:
    ConveyorWorld(const SceneSpec &spec, dSpaceID space) : EventsWorld(spec, space), half_(segment / 2 * spec.objects)
    {
        for (int i = 0; i < spec.objects; ++i)
        {
            const BodyState state = {{segment * i - half_, 0, belt_height}, Quaternion::Identity(), {1, 0, 0}};
            bodies_.push_back(add_body(objects_, dCreateBox(space, 0.09, 0.5, 0.02), 1, state));
        }
        for (int i = 0; i < spec.objects / 2; ++i)
        {
            const BodyState state = {{2 * segment * i - half_, random_.uniform(-0.2, 0.2), belt_height + 0.059}};
            dBodyDisable(add_body(objects_, dCreateBox(space, 0.1, 0.1, 0.1), 1, state));
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

template <typename World, typename... Arguments>
SceneRecipe recipe_of(const SceneBounds &bounds, Arguments... arguments)
{
    return {[=](const SceneSpec &made, dSpaceID space) { return std::make_unique<World>(made, space, arguments...); },
            bounds, events_step};
}
} // namespace

SceneRecipe reset_world(const SceneSpec &spec)
{
    const double rows = 0.1 * spec.objects;
    return recipe_of<ResetWorld>({{9, rows, 1}, {11, rows + 2, 2}});
}

SceneRecipe boxes_world(const SceneSpec &spec, double shift)
{
    const double half = half_side_of_boxes(spec.objects) + 2;
    return recipe_of<BoxesWorld>({{shift / 2, 0, 0}, {shift / 2 + half, half, half}}, shift);
}

SceneRecipe conveyor_world(const SceneSpec &spec)
{
    return recipe_of<ConveyorWorld>({{0, 0, belt_height}, {segment / 2 * spec.objects + 1, 1, 1}});
}
} // namespace ode_predictive_space::scenes
