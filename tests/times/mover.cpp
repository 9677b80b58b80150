#include "tests/times/mover.h"

#include <cmath>

namespace ode_predictive_space
{
namespace
{
Eigen::Quaterniond turn_by(const Vector3 &angles)
{
    const double angle = angles.norm();
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, angle > 0 ? Vector3(angles / angle) : Vector3::UnitZ()));
}

Eigen::Quaterniond any_turn(Random &random)
{
    return random.chance(0.2) ? Eigen::Quaterniond::Identity() : turn_by(random.vector(3));
}

Vector3 to_vector(const dReal *three)
{
    return {three[0], three[1], three[2]};
}
} // namespace

Mover::Mover(Random &random, dWorldID world, dSpaceID space, double step)
    : step_(step), driver_(static_cast<Driver>(random.index(4))), size_(random.uniform(0.1, 1))
{
    create_geom(random, space);
    if (driver_ == Driver::body || driver_ == Driver::kinematic)
    {
        body_ = dBodyCreate(world);
        if (driver_ == Driver::kinematic)
            dBodySetKinematic(body_);
        dBodySetGravityMode(body_, random.chance(0.5) ? 1 : 0);
        dGeomSetBody(geom_, body_);
        if (random.chance(0.5))
        {
            const Vector3 offset = random.vector(2 * size_);
            dGeomSetOffsetPosition(geom_, offset.x(), offset.y(), offset.z());
        }
    }
    if (driver_ == Driver::body && dBodyGetGravityMode(body_))
    {
        dVector3 gravity;
        dWorldGetGravity(world, gravity);
        acceleration_ = step_ * step_ * to_vector(gravity);
    }
    turned_ = any_turn(random);
    choose_motion(random);
    begin_ =
        random.vector(size_) - (driver_ == Driver::nothing ? Vector3(Vector3::Zero()) : travel(random.uniform(5, 150)));
    set_pose();
}

void Mover::create_geom(Random &random, dSpaceID space)
{
    const auto side = [&] { return static_cast<dReal>(size_ * random.uniform(0.05, 1)); };
    switch (random.index(4))
    {
    case 0:
        geom_ = dCreateSphere(space, side());
        break;
    case 1:
        geom_ = dCreateBox(space, side(), side(), side());
        break;
    case 2:
        geom_ = dCreateCapsule(space, side(), side());
        break;
    default:
        geom_ = dCreateCylinder(space, side(), side());
    }
}

void Mover::choose_motion(Random &random)
{
    if (driver_ == Driver::nothing)
        return;
    const double speed = size_ * std::pow(10, random.uniform(-3, -0.7));
    velocity_ = random.chance(0.8) ? random.vector(speed) : Vector3(Vector3::Zero());
    if (driver_ == Driver::setters)
        acceleration_ = random.chance(0.5) ? random.vector(0.02 * speed) : Vector3(Vector3::Zero());
    spin_ = random.chance(0.7) ? random.vector(std::pow(10, random.uniform(-4, -0.7))) : Vector3(Vector3::Zero());
    age_ = 0;
}

// ODE moves a body with the velocity at the end of the step.
Vector3 Mover::travel(double ticks) const
{
    if (driver_ == Driver::body)
        return ticks * velocity_ + (0.5 * ticks * (ticks + 1)) * acceleration_;
    return ticks * velocity_ + (0.5 * ticks * ticks) * acceleration_;
}

void Mover::set_pose() const
{
    const Vector3 place = begin_ + travel(age_);
    const Eigen::Quaterniond turned = turn_by(age_ * spin_) * turned_;
    const dQuaternion q = {turned.w(), turned.x(), turned.y(), turned.z()};
    if (!body_)
    {
        dGeomSetPosition(geom_, place.x(), place.y(), place.z());
        dGeomSetQuaternion(geom_, q);
        return;
    }
    dBodySetPosition(body_, place.x(), place.y(), place.z());
    dBodySetQuaternion(body_, q);
    const Vector3 velocity = velocity_ / step_, spin = spin_ / step_;
    dBodySetLinearVel(body_, velocity.x(), velocity.y(), velocity.z());
    dBodySetAngularVel(body_, spin.x(), spin.y(), spin.z());
}

void Mover::advance()
{
    ++age_;
    if (driver_ == Driver::setters)
        set_pose();
}

void Mover::change_motion(Random &random)
{
    if (driver_ == Driver::nothing)
        return;
    const dReal *q = body_ ? dBodyGetQuaternion(body_) : nullptr;
    begin_ = body_ ? to_vector(dBodyGetPosition(body_)) : Vector3(begin_ + travel(age_));
    turned_ = body_ ? Eigen::Quaterniond(q[0], q[1], q[2], q[3]) : turn_by(age_ * spin_) * turned_;
    choose_motion(random);
    set_pose();
}
} // namespace ode_predictive_space
