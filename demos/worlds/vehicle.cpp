#include "demos/worlds/vehicle.h"

#include "demos/worlds/stepped_world.h"

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double slowest = 4;      // rad/s, of a wheel
constexpr double fastest = 12;     // rad/s
constexpr double difference = 0.1; // of the speeds left and right

void add_mast(Objects &objects, dSpaceID space, const VehicleSize &size, dBodyID chassis)
{
    const double height = 4 * size.half_chassis.z();
    const double radius = 0.2 * size.half_chassis.y();
    const double foot = size.half_chassis.z();
    objects.attach(dCreateBox(space, radius, radius, height), chassis, {0, 0, foot + height / 2});
    objects.attach(dCreateSphere(space, radius), chassis, {0, 0, foot + height + radius});
}

void add_wheel(Objects &objects, dSpaceID space, const VehicleSize &size, const BodyState &state, dBodyID chassis,
               double speed)
{
    const dBodyID wheel = objects.add_body(dCreateSphere(space, size.wheel_radius), 0.05 * size.mass, state);
    const dJointID hinge = dJointCreateHinge(objects.world(), nullptr);
    const Vector3 axis = state.orientation * Vector3::UnitY();
    dJointAttach(hinge, wheel, chassis);
    dJointSetHingeAnchor(hinge, state.position.x(), state.position.y(), state.position.z());
    dJointSetHingeAxis(hinge, axis.x(), axis.y(), axis.z());
    drive(hinge, speed, size.torque);
}
} // namespace

void add_vehicle(Objects &objects, dSpaceID space, const VehicleSize &size, const Vector3 &place, double heading,
                 haptics::Random &random)
{
    const Vector3 &half = size.half_chassis;
    BodyState state;
    state.position = place + Vector3(0, 0, size.wheel_radius + half.z());
    state.orientation = Eigen::AngleAxisd(heading, Vector3::UnitZ());
    const dBodyID chassis =
        objects.add_body(dCreateBox(space, 2 * half.x(), 2 * half.y(), 2 * half.z()), size.mass, state);
    if (size.mast)
        add_mast(objects, space, size, chassis);
    const double speed = random.uniform(slowest, fastest);
    const double turn = random.uniform(-difference, difference);
    for (const double front : {-1.0, 1.0})
    {
        for (const double left : {-1.0, 1.0})
        {
            BodyState wheel = state;
            const Vector3 offset(front * 0.8 * half.x(), left * (half.y() + 1.05 * size.wheel_radius), -half.z());
            wheel.position += state.orientation * offset;
            add_wheel(objects, space, size, wheel, chassis, speed * (1 + left * turn));
        }
    }
}
} // namespace ode_predictive_space::worlds
