// Spheres and boxes that fall into a pit, and that have settled in it: pile, settling, heap.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double pit_step = 0.005;
constexpr double pile_spacing = 2.05 * object_radius;
constexpr int ticks_to_settle = 400;
constexpr double heap_spacing = 0.3;      // metres
constexpr double half_height_of_heap = 5; // of the pit, metres

/// Objects along one side of the pit; a pile is as high as it is wide.
int objects_per_side(int objects)
{
    return static_cast<int>(std::ceil(std::cbrt(objects)));
}

Vector3 half_pit(int objects)
{
    return Vector3::Constant(0.5 * pile_spacing * objects_per_side(objects));
}

class PileWorld : public SteppedWorld
{
public:
    /// @param start one state per object; empty: a lattice above the floor, falling.
    PileWorld(const WorldSpec &spec, dSpaceID space, const std::vector<BodyState> &start = {})
        : SteppedWorld(spec, space, pit_step)
    {
        let_fall(0.5);
        add_walls(half_pit(spec.objects), false);
        for (int i = 0; i < spec.objects; ++i)
        {
            const BodyState state =
                start.empty() ? place_in_lattice(i, spec.objects) : start[static_cast<std::size_t>(i)];
            objects_.add_moving(i % 2 == 0 ? Shape::sphere : Shape::box, state, 1000);
        }
    }

    std::vector<BodyState> states() const
    {
        std::vector<BodyState> result;
        std::transform(objects_.bodies().begin(), objects_.bodies().end(), std::back_inserter(result), &state_of);
        return result;
    }

private:
    BodyState place_in_lattice(int number, int objects)
    {
        const int side = objects_per_side(objects);
        const Vector3 cell(number % side, number / side % side, number / side / side);
        const Vector3 jitter = random_.in_box(Vector3::Constant(0.5 * (pile_spacing - 2 * object_radius)));
        BodyState state;
        state.position = pile_spacing * (cell + Vector3::Constant(0.5)) - half_pit(objects) + jitter;
        state.orientation = random_.orientation();
        return state;
    }
};

std::vector<BodyState> settle_pile(const WorldSpec &spec)
{
    const OwnedSpace space(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ));
    PileWorld pile(spec, space.get());
    PairList pairs;
    for (int tick = 0; tick < ticks_to_settle; ++tick)
    {
        pile.advance();
        pairs.clear();
        pile.collide(space.get(), &pairs, PairList::near);
        pile.respond(pairs.sorted());
    }
    return pile.states();
}

Bounds pile_bounds(int objects)
{
    return {Vector3::Zero(), half_pit(objects) + Vector3::Constant(wall_thickness)};
}

int columns_of_heap(int objects)
{
    return static_cast<int>(std::ceil(std::sqrt(objects / 10.0)));
}

double half_side_of_heap(int objects)
{
    return heap_spacing / 2 * columns_of_heap(objects) + heap_spacing;
}

class HeapWorld : public ProgramWorld
{
public:
    HeapWorld(const WorldSpec &spec, dSpaceID space, double variation) : ProgramWorld(spec, space, pit_step)
    {
        vary_steps(variation);
        let_fall(0.5);
        const double half = half_side_of_heap(spec.objects);
        add_walls({half, half, half_height_of_heap}, false);
        const int side = columns_of_heap(spec.objects);
        for (int i = 0; i < spec.objects; ++i)
        {
            const Vector3 cell(i % side - 0.5 * (side - 1), i / side % side - 0.5 * (side - 1), i / side / side);
            BodyState state;
            state.position = heap_spacing * cell + random_.in_box({0.03, 0.03, 0});
            state.position.z() += 0.15 - half_height_of_heap;
            objects_.add_body(i % 2 == 0 ? dCreateSphere(space, 0.1) : dCreateBox(space, 0.2, 0.2, 0.2), 1, state);
        }
    }
};

WorldEntry heap(const char *name, const char *text, double variation)
{
    const auto bounds = [](int objects) { return square(half_side_of_heap(objects) + 0.5, half_height_of_heap + 0.5); };
    return {Group::program, name, text, 500, pit_step, bounds, made_of<HeapWorld>(variation)};
}
} // namespace

std::vector<WorldEntry> pile_worlds()
{
    const auto prepare = [](const WorldSpec &spec) { return made_of<PileWorld>(settle_pile(spec))(spec); };
    return {
        {Group::scene, "pile", "spheres and boxes that have settled in a pit, under gravity", 500, pit_step,
         &pile_bounds, prepare},
        {Group::stepped, "settling", "a pile from its drop on", 500, pit_step, &pile_bounds, made_of<PileWorld>()},
        heap("heap", "n bodies that fall into a pit", 0),
        heap("heap_lies", "the same from 1.5 s on", 0),
        heap("heap_50", "the same from the drop on in steps that vary by 50 %", 0.5),
    };
}
} // namespace ode_predictive_space::worlds
