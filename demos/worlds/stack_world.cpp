// Walls and towers of boxes that sleep until a heavy ball hits them.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

#include <cmath>
#include <utility>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double stack_step = 0.005;
constexpr int ticks_between_throws = 400;
constexpr int first_throw = 90; // the tick; until then the boxes have time to fall asleep
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

double half_side_of_floor(int boxes)
{
    const int structures_per_side = static_cast<int>(std::ceil(std::sqrt(structures_of(boxes))));
    return 0.5 * cell * structures_per_side + corridor;
}

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

/// Walls and towers alternate on the floor of a closed room. Bodies at rest are disabled. Every two seconds the ball is thrown
/// again, at a wall or tower chosen at random: some boxes fly, most of them stay asleep. The ball is the geom after the walls
/// of the room and before the boxes.
class StackWorld : public SteppedWorld
{
public:
    StackWorld(const WorldSpec &spec, dSpaceID space)
        : SteppedWorld(spec, space, stack_step), half_side_(half_side_of_floor(spec.objects)),
          structures_(structures_of(spec.objects))
    {
        let_fall(0.7);
        dWorldSetAutoDisableFlag(objects_.world(), 1);
        dWorldSetAutoDisableLinearThreshold(objects_.world(), 0.05);
        dWorldSetAutoDisableAngularThreshold(objects_.world(), 0.3);
        dWorldSetLinearDamping(objects_.world(), 0.002);
        dWorldSetAngularDamping(objects_.world(), 0.02);
        add_walls({half_side_, half_side_, half_height}, true);
        add_ball();
        build(spec.objects);
    }

private:
    void add_ball()
    {
        const double corner = ball_radius - half_side_;
        BodyState state;
        state.position = {corner, corner, ball_radius - half_height};
        ball_ = objects_.add_body(dCreateSphere(objects_.space(), ball_radius), 1, state);
        dMass mass;
        dMassSetSphere(&mass, ball_density, ball_radius);
        dBodySetMass(ball_, &mass);
        dBodySetLinearDamping(ball_, 0);
    }

    void build(int boxes)
    {
        const double side = 2 * half_side_of_box();
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

    void before_step() override
    {
        if (tick_++ % ticks_between_throws == first_throw)
            throw_ball();
    }

    void throw_ball()
    {
        const int target = static_cast<int>(random_.index(static_cast<std::size_t>(structures_)));
        const Vector3 aim = place_of_structure(target, half_side_);
        const double start = half_side_ - ball_radius - gap;
        BodyState state;
        // From a place along one of the four walls, so that a wall of boxes is hit from all sides.
        state.position = {random_.uniform(-start, start), random_.unit() < 0.5 ? -start : start,
                          ball_height - half_height};
        if (random_.unit() < 0.5)
            std::swap(state.position.x(), state.position.y());
        const Vector3 way(aim.x() - state.position.x(), aim.y() - state.position.y(), 0);
        // It falls on its way as far as it rises.
        state.velocity =
            ball_speed * way.normalized() + 0.5 * standard_gravity * way.norm() / ball_speed * Vector3::UnitZ();
        set_state(ball_, state);
        dBodyEnable(ball_);
    }

    double half_side_; ///< of the floor, metres
    int structures_;
    dBodyID ball_ = nullptr;
    int tick_ = 0;
};
} // namespace

std::vector<WorldEntry> stack_worlds()
{
    const auto bounds = [](int objects) {
        return square(half_side_of_floor(objects) + wall_thickness, half_height + wall_thickness);
    };
    return {{Group::scene, "stack", "walls and towers of boxes, asleep until a heavy ball hits them, every two seconds",
             1000, stack_step, bounds, made_of<StackWorld>()}};
}
} // namespace ode_predictive_space::worlds
