#include "ode_predictive_space/haptics/push_response.h"

#include "ode_predictive_space/haptics/ode_vector.h"
#include "ode_predictive_space/haptics/usual_touches.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double memory = 0.01; // s
constexpr double noise = 0.01;  // of the mean square: pushes that vary less tell nothing new

Vector3 gravity_on(dBodyID body)
{
    dVector3 gravity = {};
    if (dBodyGetGravityMode(body) != 0)
    {
        dWorldGetGravity(dBodyGetWorld(body), gravity);
    }
    return from_ode(gravity);
}

/// Of a body that has not been pushed: something holds back what gravity would do; it holds back a push, too, as far as it is
/// opposite.
double yield_on_support(const Vector3 &by_gravity, const Vector3 &changed, const Vector3 &direction)
{
    const Vector3 held_back = by_gravity - changed;
    const double work = by_gravity.dot(held_back);
    const double along = direction.dot(held_back);
    return work > 0 && along > 0 ? std::clamp(1 - along * along / work, 0.0, 1.0) : 1;
}
} // namespace

Mobility free_mobility_of(dBodyID body)
{
    Mobility mobility;
    mobility.centre = from_ode(dBodyGetPosition(body));
    if (dBodyIsKinematic(body) != 0)
    {
        return mobility;
    }
    dMass mass;
    dBodyGetMass(body, &mass);
    Eigen::Matrix3d inertia;
    Eigen::Matrix3d turned;
    const dReal *rotation = dBodyGetRotation(body);
    for (int row = 0; row < 3; ++row)
    {
        for (int column = 0; column < 3; ++column)
        {
            inertia(row, column) = mass.I[4 * row + column];
            turned(row, column) = rotation[4 * row + column];
        }
    }
    mobility.inverse_mass = 1 / static_cast<double>(mass.mass);
    mobility.inverse_inertia = turned * inertia.inverse() * turned.transpose();
    return mobility;
}

PushResponse::PushResponse(double dt) : dt_(dt), fading_(std::exp(-dt / memory))
{
    now_.reserve(usual_touches);
    before_.reserve(usual_touches);
}

void PushResponse::begin()
{
    now_.swap(before_);
    now_.clear();
}

const PushResponse::Record *PushResponse::before(const Touch &touch) const
{
    const auto found = std::find_if(before_.begin(), before_.end(), [&](const Record &record) {
        return record.object == touch.object && record.feature == touch.feature;
    });
    return found != before_.end() ? &*found : nullptr;
}

Mobility PushResponse::look(const Touch &touch, dBodyID body)
{
    if (body == nullptr || dBodyIsKinematic(body) != 0)
    {
        return {};
    }
    Record record;
    record.object = touch.object;
    record.feature = touch.feature;
    double yield = 1;
    if (const Record *last = before(touch))
    {
        record = *last;
        learn(record, touch);
        yield = record.mobility.yield;
    }
    record.mobility = free_mobility_of(body);
    record.mobility.yield = yield;
    record.point = touch.point;
    record.velocity = touch.surface_velocity;
    record.pushed.setZero();
    record.gravity = dt_ * gravity_on(body);
    now_.push_back(record);
    return record.mobility;
}

void PushResponse::learn(Record &record, const Touch &touch) const
{
    const Vector3 direction = -touch.normal;
    const Vector3 changed = touch.surface_velocity - record.velocity;
    const double given = direction.dot(record.pushed);
    const double got = direction.dot(changed);
    record.weight = fading_ * record.weight + 1;
    record.given = fading_ * record.given + given;
    record.got = fading_ * record.got + got;
    record.given_given = fading_ * record.given_given + given * given;
    record.given_got = fading_ * record.given_got + given * got;
    if (!record.was_pushed)
    {
        record.mobility.yield = yield_on_support(record.gravity, changed, direction);
        return;
    }
    const double variance = record.given_given - record.given * record.given / record.weight;
    const double covariance = record.given_got - record.given * record.got / record.weight;
    const double inertia = noise * record.given_given;
    if (inertia > 0)
    {
        const double slope = (covariance + inertia * record.mobility.yield) / (variance + inertia);
        record.mobility.yield = std::clamp(slope, 0.0, 1.0);
    }
}

void PushResponse::note_pushes(const std::vector<ForceShare> &shares)
{
    for (Record &record : now_)
    {
        for (const ForceShare &share : shares)
        {
            if (share.object == record.object && !share.force.isZero(0))
            {
                record.pushed += record.mobility.response(-dt_ * share.force, share.point, record.point);
                record.was_pushed = true;
            }
        }
    }
}
} // namespace ode_predictive_space::haptics
