#include "demos/scenes/stack_scene.h"

#include <cmath>
#include <utility>

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double gravity = 9.81; // m/s^2
constexpr int boxes_per_structure = 48;
constexpr int wall_width = 8;         // boxes; a wall is 6 boxes high
constexpr int tower_width = 2;        // boxes, in both directions; a tower is 12 boxes high
constexpr double cell = 1.8;          // metres; one structure stands in each
constexpr double corridor = 1;        // metres around the structures: the ball starts there
constexpr double half_height = 2;     // of the room, metres
constexpr double gap = 0.002;         // between neighbours in a row, metres
constexpr double jitter = 0.001;      // metres
constexpr double ball_radius = 0.25;  // metres
constexpr double ball_density = 2000; // kg/m^3: as heavy as some 80 boxes
constexpr double ball_speed = 8;      // m/s
constexpr double ball_height = 0.5;   // above the floor, metres

int structures_of(int boxes)
{
    return (boxes + boxes_per_structure - 1) / boxes_per_structure;
}

int structures_per_side(int boxes)
{
    return static_cast<int>(std::ceil(std::sqrt(structures_of(boxes))));
}

double half_side_of_floor(int boxes)
{
    return 0.5 * cell * structures_per_side(boxes) + corridor;
}

/// The middle of a structure on the floor of a room of this size.
Vector3 place_of_structure(int number, double half_side)
{
    const int side = static_cast<int>(std::lround(2 * (half_side - corridor) / cell));
    const int column = number % side;
    const int row = number / side;
    return {(column + 0.5) * cell + corridor - half_side, (row + 0.5) * cell + corridor - half_side, -half_height};
}

/// The place of the box of this number in its wall; rows are shifted by half a box, like bricks.
Vector3 place_in_wall(int number, double side)
{
    const int row = number / wall_width;
    const double column = number % wall_width - 0.5 * (wall_width - 1) + (row % 2 == 0 ? -0.25 : 0.25);
    return {column * (side + gap), 0, (row + 0.5) * side};
}

Vector3 place_in_tower(int number, double side)
{
    const int floor = number / (tower_width * tower_width);
    const double column = number % tower_width - 0.5 * (tower_width - 1);
    const double row = number / tower_width % tower_width - 0.5 * (tower_width - 1);
    return {column * (side + gap), row * (side + gap), (floor + 0.5) * side};
}
} // namespace

StackScene::StackScene(const SceneSpec &spec, dSpaceID space)
    : ContactScene(space, step_seconds, spec.seed), half_side_(half_side_of_floor(spec.objects)),
      structures_(structures_of(spec.objects)), random_(spec.seed)
{
    dWorldSetGravity(objects_.world(), 0, 0, -gravity);
    dWorldSetContactSurfaceLayer(objects_.world(), 0.001);
    dWorldSetContactMaxCorrectingVel(objects_.world(), 1);
    dWorldSetAutoDisableFlag(objects_.world(), 1);
    dWorldSetAutoDisableLinearThreshold(objects_.world(), 0.05);
    dWorldSetAutoDisableAngularThreshold(objects_.world(), 0.3);
    dWorldSetLinearDamping(objects_.world(), 0.002);
    dWorldSetAngularDamping(objects_.world(), 0.02);
    surface_.mode = dContactApprox1;
    surface_.mu = 0.7;
    add_walls({half_side_, half_side_, half_height}, wall_thickness, true);
    ball_.geom = objects_.add_geom(dCreateSphere(space, ball_radius));
    ball_.body = dBodyCreate(objects_.world());
    dMass mass;
    dMassSetSphere(&mass, ball_density, ball_radius);
    dBodySetMass(ball_.body, &mass);
    dGeomSetBody(ball_.geom, ball_.body);
    dBodySetLinearDamping(ball_.body, 0);
    set_position(ball_.body, {ball_radius - half_side_, ball_radius - half_side_, ball_radius - half_height});
    build(spec.objects);
}

void StackScene::build(int boxes)
{
    const double side = 2 * half_side_of_box(object_radius);
    for (int i = 0; i < boxes; ++i)
    {
        const int structure = i / boxes_per_structure;
        const int number = i % boxes_per_structure;
        BodyState state;
        state.position = place_of_structure(structure, half_side_) + random_.in_box({jitter, jitter, 0}) +
                         (structure % 2 == 0 ? place_in_wall(number, side) : place_in_tower(number, side));
        objects_.add_moving(Shape::box, state, 1000);
    }
}

void StackScene::before_step()
{
    if (tick_ % ticks_between_throws == first_throw)
        throw_ball();
    ++tick_;
}

void StackScene::throw_ball()
{
    const int target = static_cast<int>(random_.index(static_cast<std::size_t>(structures_)));
    const Vector3 aim = place_of_structure(target, half_side_);
    const double start = half_side_ - ball_radius - gap;
    BodyState state;
    // From a place along one of the four walls, so that a wall of boxes is hit from all sides.
    state.position = {random_.uniform(-start, start), random_.unit() < 0.5 ? -start : start, ball_height - half_height};
    if (random_.unit() < 0.5)
        std::swap(state.position.x(), state.position.y());
    const Vector3 way(aim.x() - state.position.x(), aim.y() - state.position.y(), 0);
    // It falls on its way as far as it rises.
    state.velocity = ball_speed * way.normalized() + 0.5 * gravity * way.norm() / ball_speed * Vector3::UnitZ();
    set_state(ball_.body, state);
    dBodyEnable(ball_.body);
}

SceneBounds stack_bounds(int objects)
{
    const double half_side = half_side_of_floor(objects) + wall_thickness;
    return {Vector3::Zero(), {half_side, half_side, half_height + wall_thickness}};
}
} // namespace ode_predictive_space::scenes
