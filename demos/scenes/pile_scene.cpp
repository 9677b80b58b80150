#include "demos/scenes/pile_scene.h"

#include <cmath>

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double spacing = 2.05 * object_radius;
constexpr int ticks_to_settle = 400;

/// Objects along one side of the pit; a pile is as high as it is wide.
int objects_per_side(int objects)
{
    return static_cast<int>(std::ceil(std::cbrt(objects)));
}

Vector3 half_pit(int objects)
{
    return Vector3::Constant(0.5 * spacing * objects_per_side(objects));
}

BodyState place_in_lattice(int number, int objects, haptics::Random &random)
{
    const int side = objects_per_side(objects);
    const int row = number / side % side;
    const int layer = number / side / side;
    const Vector3 cell(number % side, row, layer);
    const Vector3 jitter = random.in_box(Vector3::Constant(0.5 * (spacing - 2 * object_radius)));
    BodyState state;
    state.position = spacing * (cell + Vector3::Constant(0.5)) - half_pit(objects) + jitter;
    state.orientation = random.orientation();
    return state;
}
} // namespace

PileScene::PileScene(const SceneSpec &spec, dSpaceID space, const std::vector<BodyState> &start)
    : ContactScene(space, step_seconds, spec.seed)
{
    dWorldSetGravity(objects_.world(), 0, 0, -9.81);
    dWorldSetContactSurfaceLayer(objects_.world(), 0.001);
    dWorldSetContactMaxCorrectingVel(objects_.world(), 1);
    surface_.mode = dContactApprox1;
    surface_.mu = 0.5;
    add_walls(half_pit(spec.objects), wall_thickness, false);
    haptics::Random random(spec.seed);
    for (int i = 0; i < spec.objects; ++i)
    {
        const BodyState state =
            start.empty() ? place_in_lattice(i, spec.objects, random) : start[static_cast<std::size_t>(i)];
        pile_.push_back(objects_.add_moving(i % 2 == 0 ? Shape::sphere : Shape::box, state, 1000));
    }
}

std::vector<BodyState> PileScene::states() const
{
    std::vector<BodyState> result;
    for (const Object &object : pile_)
        result.push_back(state_of(object.body));
    return result;
}

SceneBounds pile_bounds(int objects)
{
    return {Vector3::Zero(), half_pit(objects) + Vector3::Constant(wall_thickness)};
}

std::vector<BodyState> settle_pile(const SceneSpec &spec)
{
    const dSpaceID space = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
    std::vector<BodyState> settled;
    {
        PileScene pile(spec, space, {});
        PairList pairs;
        for (int tick = 0; tick < ticks_to_settle; ++tick)
        {
            pile.advance();
            pairs.clear();
            dSpaceCollide(space, &pairs, &PairList::collect);
            pile.respond(pairs.sorted());
        }
        settled = pile.states();
    }
    dSpaceDestroy(space);
    return settled;
}
} // namespace ode_predictive_space::scenes
