#include "demos/scenes/terrain_scene.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::scenes
{
namespace
{
constexpr double fastest_mover = 5;   // m/s
constexpr double fastest_turn = 5;    // rad/s
constexpr double sunk = 0.001;        // metres that a rolling object is in the ground: a contact in spite of rounding
constexpr double lowest_flight = 1.5; // metres
constexpr double highest_flight = 5;  // metres
constexpr double roof_height = 8;     // metres
constexpr double pillar_height = 200; // metres
constexpr unsigned long huge_category = 4;
constexpr unsigned long small_bits = 1; // what huge boxes collide with: not one another, nor the ground
} // namespace

double half_side_of_square(int objects)
{
    return std::max(0.75 * std::sqrt(objects), 3.0);
}

double rest_height_of(Shape shape)
{
    return (shape == Shape::box ? half_side_of_box(object_radius) : object_radius) - sunk;
}

std::vector<HugeBox> huge_boxes(double half_side)
{
    const double third = half_side / 3;
    return {
        {{terrain_length, 0.5, 3}, {0, -third, 0}},
        {{terrain_length, 0.5, 3}, {0, third, 0}},
        {{terrain_length, terrain_length, 1}, {0, 0, roof_height}},
        {{3, 3, pillar_height}, {-third, 0, 0}},
        {{3, 3, pillar_height}, {third, 0, 0}},
        {{100, 1, 1}, {third, -2 * third, 3}, Vector3::Zero(), 0.1},
        {{100, 1, 1}, {-third, 2 * third, 4}, Vector3::Zero(), -0.1},
        {{200, 10, 4}, {0, third, 6}, {0, 1, 0}, 0},
        {{20, 10, 4}, {-third, 0, 5}, {2, -1, 0}, 0},
    };
}

dGeomID make_huge_geom(const HugeBox &box, SceneObjects &objects)
{
    const dGeomID geom = objects.add_geom(dCreateBox(objects.space(), box.size.x(), box.size.y(), box.size.z()));
    set_position(geom, box.position);
    dGeomSetCategoryBits(geom, huge_category);
    dGeomSetCollideBits(geom, small_bits);
    return geom;
}

TerrainScene::TerrainScene(const SceneSpec &spec, dSpaceID space)
    : half_side_(half_side_of_square(spec.objects)), ground_(half_side_), objects_(space)
{
    ground_.add_geoms(objects_);
    add_huge_boxes();
    haptics::Random random(spec.seed);
    for (int i = 0; i < spec.objects; ++i)
        add_mover(i, random);
}

void TerrainScene::add_huge_boxes()
{
    for (const HugeBox &box : huge_boxes(half_side_))
    {
        const dGeomID geom = make_huge_geom(box, objects_);
        if (box.moves())
            add_huge_mover(box, geom);
    }
}

void TerrainScene::add_huge_mover(const HugeBox &box, dGeomID geom)
{
    Mover mover{};
    mover.body = dBodyCreate(objects_.world());
    mover.state.position = box.position;
    mover.state.velocity = box.velocity;
    mover.state.angular_velocity = {0, 0, box.spin};
    mover.turn = Quaternion(Eigen::AngleAxisd(box.spin * usual_tick, Vector3::UnitZ()));
    dGeomSetBody(geom, mover.body);
    set_state(mover.body, mover.state);
    movers_.push_back(mover);
}

void TerrainScene::add_mover(int number, haptics::Random &random)
{
    const auto shape = static_cast<Shape>(number / 2 % 3);
    Mover mover{};
    mover.rolls = number % 2 == 0;
    mover.rest_height = rest_height_of(shape);
    mover.state.position = random.in_box({half_side_, half_side_, 0});
    const double angle = random.uniform(0, 2 * pi);
    mover.state.velocity = random.uniform(0, fastest_mover) * Vector3(std::cos(angle), std::sin(angle), 0);
    const double spin = random.uniform(0, fastest_turn);
    const Vector3 axis = mover.rolls ? Vector3::UnitZ() : random.direction();
    if (mover.rolls)
    {
        mover.state.position.z() =
            ground_.height(mover.state.position.x(), mover.state.position.y()) + mover.rest_height;
    }
    else
    {
        mover.state.position.z() = random.uniform(lowest_flight, highest_flight);
        mover.state.orientation = random.orientation();
    }
    mover.state.angular_velocity = spin * axis;
    mover.turn = Quaternion(Eigen::AngleAxisd(spin * usual_tick, axis));
    mover.body = objects_.add_moving(shape, mover.state, 1000).body;
    movers_.push_back(mover);
}

void TerrainScene::advance()
{
    for (Mover &mover : movers_)
        advance_mover(mover);
}

void TerrainScene::advance_mover(Mover &mover) const
{
    BodyState &state = mover.state;
    state.position += usual_tick * state.velocity;
    state.orientation = (mover.turn * state.orientation).normalized();
    turn_back(state);
    if (mover.rolls)
        roll(mover);
    set_state(mover.body, state);
}

void TerrainScene::roll(Mover &mover) const
{
    BodyState &state = mover.state;
    const double before = state.position.z() - usual_tick * state.velocity.z();
    state.position.z() = ground_.height(state.position.x(), state.position.y()) + mover.rest_height;
    state.velocity.z() = (state.position.z() - before) / usual_tick;
}

void TerrainScene::turn_back(BodyState &state) const
{
    for (int axis = 0; axis < 2; ++axis)
    {
        if (std::abs(state.position[axis]) > half_side_ && state.position[axis] * state.velocity[axis] > 0)
            state.velocity[axis] = -state.velocity[axis];
    }
}

SceneBounds terrain_bounds(int objects)
{
    const double half_side = half_side_of_square(objects) + object_radius;
    return {{0, 0, 0.5 * roof_height}, {half_side, half_side, 0.5 * roof_height}};
}
} // namespace ode_predictive_space::scenes
