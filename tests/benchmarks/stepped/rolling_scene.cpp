#include "tests/benchmarks/stepped/rolling_scene.h"

#include <cmath>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace scenes;

constexpr double rolling_step = 0.001;
constexpr double gravity = 9.81;         // m/s^2
constexpr double rolling_density = 1000; // kg/m^3
constexpr double fastest_rolling = 5;    // m/s
constexpr double time_to_recover = 0.2;  // seconds
constexpr double lowest_flight = 1.5;    // metres
constexpr double highest_flight = 5;     // metres
} // namespace

RollingScene::RollingScene(const SceneSpec &spec, dSpaceID space)
    : GroundOfScene(spec.objects), ContactScene(space, rolling_step, spec.seed)
{
    dWorldSetGravity(objects_.world(), 0, 0, -gravity);
    dWorldSetContactMaxCorrectingVel(objects_.world(), 1);
    surface_.mode = dContactApprox1;
    surface_.mu = 0.3;
    ground.add_geoms(objects_);
    add_huge_boxes();
    haptics::Random random(spec.seed);
    for (int i = 0; i < spec.objects; ++i)
    {
        add_driven(i, random);
    }
}

void RollingScene::add_huge_boxes()
{
    for (const HugeBox &box : huge_boxes(half_side))
    {
        const dGeomID geom = make_huge_geom(box, objects_);
        if (box.moves())
        {
            const dBodyID body = dBodyCreate(objects_.world());
            dBodySetKinematic(body);
            dGeomSetBody(geom, body);
            set_state(body, {box.position, Quaternion::Identity(), box.velocity, {0, 0, box.spin}});
            huge_.push_back(body);
        }
    }
}

void RollingScene::add_driven(int number, haptics::Random &random)
{
    const auto shape = static_cast<Shape>(number / 2 % 3);
    const double angle = random.uniform(0, 2 * pi);
    Driven driven{};
    driven.flies = number % 2 != 0;
    driven.velocity = random.uniform(0, fastest_rolling) * Vector3(std::cos(angle), std::sin(angle), 0);
    BodyState state;
    state.position = random.in_box({half_side, half_side, 0});
    state.position.z() = driven.flies ? random.uniform(lowest_flight, highest_flight)
                                      : ground.height(state.position.x(), state.position.y()) + rest_height_of(shape);
    state.orientation = Quaternion::Identity();
    if (driven.flies)
    {
        state.orientation = random.orientation();
    }
    state.velocity = driven.velocity;
    driven.body = objects_.add_moving(shape, state, rolling_density).body;
    dBodySetGravityMode(driven.body, driven.flies ? 0 : 1);
    dMass mass;
    dBodyGetMass(driven.body, &mass);
    driven.mass = mass.mass;
    driven_.push_back(driven);
}

void RollingScene::before_step()
{
    for (Driven &driven : driven_)
    {
        turn_back(driven.body, driven.velocity);
        Vector3 missing = driven.velocity - from_ode(dBodyGetLinearVel(driven.body));
        missing.z() = driven.flies ? missing.z() : 0;
        const Vector3 force = driven.mass / time_to_recover * missing;
        dBodyAddForce(driven.body, force.x(), force.y(), force.z());
    }
    for (const dBodyID body : huge_)
    {
        Vector3 velocity = from_ode(dBodyGetLinearVel(body));
        turn_back(body, velocity);
        dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
    }
}

void RollingScene::turn_back(dBodyID body, Vector3 &velocity) const
{
    const Vector3 position = from_ode(dBodyGetPosition(body));
    for (int axis = 0; axis < 2; ++axis)
    {
        if (std::abs(position[axis]) > half_side && position[axis] * velocity[axis] > 0)
        {
            velocity[axis] = -velocity[axis];
        }
    }
}
} // namespace ode_predictive_space::benchmarks
