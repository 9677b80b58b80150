#include "tests/benchmarks/stepped/floating_scenes.h"

#include "demos/scenes/kinematic_scenes.h"

#include <cmath>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace scenes;

constexpr double step_seconds = 0.001;
constexpr double density = 1000;         // kg/m^3
constexpr double fastest_spin = 5;       // rad/s
constexpr double pose_setting_speed = 1; // m/s
constexpr int objects_per_moving_pose = 20;

Shape shape_of(int number, int shapes)
{
    return static_cast<Shape>(number % shapes);
}

BodyState random_state(double half, double max_speed, haptics::Random &random)
{
    BodyState state;
    state.position = random.in_box(Vector3::Constant(half));
    state.orientation = random.orientation();
    state.velocity = random.uniform(0, max_speed) * random.direction();
    state.angular_velocity = random.uniform(0, fastest_spin) * random.direction();
    return state;
}

/// Let a body that has left the room come back.
void turn_back(dBodyID body, double half)
{
    const Vector3 position = from_ode(dBodyGetPosition(body));
    Vector3 velocity = from_ode(dBodyGetLinearVel(body));
    bool left = false;
    for (int axis = 0; axis < 3; ++axis)
    {
        if (std::abs(position[axis]) > half && position[axis] * velocity[axis] > 0)
        {
            velocity[axis] = -velocity[axis];
            left = true;
        }
    }
    if (left)
    {
        dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
    }
}
} // namespace

FloatingScene::FloatingScene(const SceneSpec &spec, dSpaceID space, const FloatingSettings &settings)
    : ContactScene(space, step_seconds, spec.seed), half_(kinematic_half_room(spec.name, spec.objects) - object_radius),
      random_(spec.seed)
{
    dWorldSetContactMaxCorrectingVel(objects_.world(), 1); // what overlaps at the start is not blasted apart
    surface_.mode = dContactApprox1 | dContactBounce;
    surface_.mu = 0;
    surface_.bounce = 1;
    surface_.bounce_vel = 0.01;
    for (int i = 0; i < spec.objects; ++i)
    {
        const BodyState state = random_state(half_, settings.max_speed, random_);
        const Shape shape = shape_of(i, settings.shapes);
        // Every k-th object moves, where k = 1 / share.
        if (std::floor((i + 1) * settings.moving) > std::floor(i * settings.moving))
        {
            floaters_.push_back(objects_.add_moving(shape, state, density));
        }
        else
        {
            objects_.add_still(shape, state.position, state.orientation);
        }
    }
}

void FloatingScene::before_step()
{
    for (const Object &floater : floaters_)
    {
        turn_back(floater.body, half_);
    }
}

JumpingScene::JumpingScene(const SceneSpec &spec, dSpaceID space) : FloatingScene(spec, space, {1, 0}) {}

void JumpingScene::advance()
{
    ContactScene::advance();
    for (const Object &floater : floaters_)
    {
        BodyState state = state_of(floater.body);
        state.position = random_.in_box(Vector3::Constant(half_));
        state.velocity = Vector3::Zero();
        state.angular_velocity = Vector3::Zero();
        set_state(floater.body, state);
    }
}

PoseSettingScene::PoseSettingScene(const SceneSpec &spec, dSpaceID space)
    : ContactScene(space, step_seconds, spec.seed), half_(kinematic_half_room(spec.name, spec.objects) - object_radius)
{
    haptics::Random random(spec.seed);
    for (int i = 0; i < spec.objects; ++i)
    {
        Posed posed{};
        posed.state = random_state(half_, pose_setting_speed, random);
        posed.geom =
            objects_.add_still(shape_of(i, FloatingSettings().shapes), posed.state.position, posed.state.orientation)
                .geom;
        if (i % objects_per_moving_pose == 0)
        {
            posed.body = dBodyCreate(objects_.world());
            set_state(posed.body, posed.state);
        }
        posed_.push_back(posed);
    }
}

void PoseSettingScene::before_step()
{
    for (const Posed &posed : posed_)
    {
        if (posed.body != nullptr)
        {
            turn_back(posed.body, half_);
        }
    }
}

void PoseSettingScene::advance()
{
    ContactScene::advance();
    for (Posed &posed : posed_)
    {
        if (posed.body != nullptr)
        {
            posed.state = state_of(posed.body);
        }
        set_position(posed.geom, posed.state.position);
        set_orientation(posed.geom, posed.state.orientation);
    }
}
} // namespace ode_predictive_space::benchmarks
