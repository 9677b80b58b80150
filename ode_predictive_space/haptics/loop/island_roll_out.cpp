#include "ode_predictive_space/haptics/loop/island_roll_out.h"

#include "ode_predictive_space/haptics/contact/ode_vector.h"
#include "ode_predictive_space/haptics/loop/scene_bodies.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace ode_predictive_space::haptics
{
namespace
{
bool is_falling_asleep(dBodyID body)
{
    const double speed = from_ode(dBodyGetLinearVel(body)).norm();
    const double spin = from_ode(dBodyGetAngularVel(body)).norm();
    return dBodyGetAutoDisableFlag(body) != 0 && speed < dBodyGetAutoDisableLinearThreshold(body) &&
           spin < dBodyGetAutoDisableAngularThreshold(body);
}

/// Enables a body that was disabled here. dBodyEnable() resets its count of idle steps. Switching automatic disabling
/// off and on keeps the count, but resets steps, time and samples to those of the world.
void enable_again(dBodyID body)
{
    if (!is_falling_asleep(body))
        return dBodyEnable(body);
    const int steps = dBodyGetAutoDisableSteps(body);
    const dReal time = dBodyGetAutoDisableTime(body);
    const int samples = dBodyGetAutoDisableAverageSamplesCount(body);
    dBodySetAutoDisableFlag(body, 0);
    dBodySetAutoDisableSteps(body, steps);
    dBodySetAutoDisableTime(body, time);
    dBodySetAutoDisableAverageSamplesCount(body, static_cast<unsigned>(samples));
    dBodySetAutoDisableFlag(body, 1);
}

dBodyID other_body(dJointID joint, dBodyID body)
{
    return dJointGetBody(joint, dJointGetBody(joint, 0) == body ? 1 : 0);
}

std::optional<Vector3> anchor_of(dJointID joint)
{
    dVector3 place = {};
    switch (dJointGetType(joint))
    {
    case dJointTypeBall:
        dJointGetBallAnchor(joint, place);
        break;
    case dJointTypeHinge:
        dJointGetHingeAnchor(joint, place);
        break;
    case dJointTypeUniversal:
        dJointGetUniversalAnchor(joint, place);
        break;
    default:
        return std::nullopt;
    }
    return from_ode(place);
}

/// 1/s^2; the squared angular frequency of the body on an angular stiffness.
double square_of_swing(dBodyID body, const Eigen::Matrix3d &stiffness)
{
    dMass mass;
    dBodyGetMass(body, &mass);
    double most = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        dVector3 direction;
        dBodyVectorToWorld(body, axis == 0, axis == 1, axis == 2, direction);
        const Vector3 world = from_ode(direction);
        most = std::max(most, world.dot(stiffness * world) / static_cast<double>(mass.I[5 * axis]));
    }
    return most;
}
} // namespace

IslandRollOut::IslandRollOut(const std::vector<dBodyID> &touched, bool quick) : quick_(quick), seed_(dRandGetSeed())
{
    for (const dBodyID body : touched)
        add(body);
    add_connected();
    hold_others();
}

void IslandRollOut::add(dBodyID body)
{
    if (!known_.insert(body).second)
        return;
    ends_ += dBodyGetNumJoints(body);
    states_.push_back({body, tool_state_of(body), from_ode(dBodyGetForce(body)), from_ode(dBodyGetTorque(body)),
                       dBodyIsEnabled(body) != 0});
}

/// Breadth first, so that the nearest bodies are included.
void IslandRollOut::add_connected()
{
    const int most = quick_ ? most_ends_by_quick_step : most_ends;
    std::vector<dBodyID> border;
    for (std::size_t i = 0; i < states_.size(); ++i)
    {
        const dBodyID body = states_[i].body;
        for (int n = 0; n < dBodyGetNumJoints(body); ++n)
        {
            const dJointID joint = dBodyGetJoint(body, n);
            note_joint(joint, body);
            const dBodyID other = other_body(joint, body);
            if (other == nullptr || known_.count(other) != 0)
                continue;
            if (ends_ < most)
                add(other);
            else
                border.push_back(other);
        }
    }
    is_whole_ = border.empty();
    hold_border(border);
}

void IslandRollOut::note_joint(dJointID joint, dBodyID body)
{
    has_joints_ = has_joints_ || dJointGetType(joint) != dJointTypeNull;
    const bool is_contact = dJointGetType(joint) == dJointTypeContact;
    has_contacts_ = has_contacts_ || is_contact;
    is_stacked_ =
        is_stacked_ || (is_contact && dJointGetBody(joint, 0) != nullptr && dJointGetBody(joint, 1) != nullptr);
    if (anchor_of(joint) && dJointGetBody(joint, 0) == body)
        joints_.push_back(joint);
    if (dJointFeedback *const feedback = dJointGetFeedback(joint))
    {
        dJointSetFeedback(joint, nullptr);
        at_end([=] { dJointSetFeedback(joint, feedback); });
    }
}

/// Bodies at the border become kinematic and keep their velocities. Joints beyond them are disabled, because ODE steps
/// all connected bodies.
void IslandRollOut::hold_border(const std::vector<dBodyID> &border)
{
    const std::unordered_set<dBodyID> within = known_;
    for (const dBodyID body : border)
    {
        if (known_.count(body) != 0)
            continue;
        add(body);
        for (int n = 0; n < dBodyGetNumJoints(body); ++n)
        {
            const dJointID joint = dBodyGetJoint(body, n);
            if (dJointIsEnabled(joint) == 0 || within.count(other_body(joint, body)) != 0)
                continue;
            dJointDisable(joint);
            at_end([=] { dJointEnable(joint); });
        }
        if (dBodyIsKinematic(body) == 0)
        {
            dBodySetKinematic(body);
            at_end([=] { dBodySetDynamic(body); });
        }
    }
}

/// Disables all other bodies, so that ODE does not step them.
void IslandRollOut::hold_others()
{
    const dWorldID world = dBodyGetWorld(states_.front().body);
    for (dBodyID body = first_body_of(world); body != nullptr; body = next_body_of_world(body))
    {
        if (dBodyIsEnabled(body) == 0 || known_.count(body) != 0)
            continue;
        dBodyDisable(body);
        at_end([=] { enable_again(body); });
    }
}

IslandRollOut::~IslandRollOut()
{
    restore();
    dRandSetSeed(seed_);
}

void IslandRollOut::run(std::size_t steps, double dt, const std::vector<BodyImpulse> &impulses,
                        const std::function<void(std::size_t)> &look)
{
    const dWorldID world = dBodyGetWorld(states_.front().body);
    const auto h = static_cast<dReal>(dt);
    dRandSetSeed(seed_);
    for (const BodyImpulse &push : impulses)
    {
        if (known_.count(push.body) == 0)
            continue;
        const Vector3 force = push.impulse / dt;
        push_body(push.body, force, push.arm.cross(force));
    }
    for (std::size_t step = 1; step <= steps; ++step)
    {
        quick_ ? dWorldQuickStep(world, h) : dWorldStep(world, h);
        look(step);
    }
    restore();
}

double IslandRollOut::fastest_swing(double dt)
{
    if (joints_.empty())
        return 0;
    std::vector<dJointFeedback> forces(joints_.size());
    for (std::size_t i = 0; i < joints_.size(); ++i)
        dJointSetFeedback(joints_[i], &forces[i]);
    run(1, dt, {}, [](std::size_t) {});
    std::unordered_map<dBodyID, Eigen::Matrix3d> stiffness;
    for (std::size_t i = 0; i < joints_.size(); ++i)
    {
        dJointSetFeedback(joints_[i], nullptr);
        const Vector3 anchor = anchor_of(joints_[i]).value();
        for (int side = 0; side < 2; ++side)
        {
            const dBodyID body = dJointGetBody(joints_[i], side);
            if (body == nullptr || dBodyIsKinematic(body) != 0)
                continue;
            const Vector3 arm = anchor - from_ode(dBodyGetPosition(body));
            const double length = arm.norm();
            if (length > 0)
            {
                const double force = from_ode(forces[i].f1).norm();
                auto &sum = stiffness.emplace(body, Eigen::Matrix3d::Zero()).first->second;
                sum += force * (length * Eigen::Matrix3d::Identity() - arm * arm.transpose() / length);
            }
        }
    }
    double square = 0;
    for (const auto &[body, matrix] : stiffness)
        square = std::max(square, square_of_swing(body, matrix));
    return std::sqrt(square);
}

void IslandRollOut::restore() const
{
    for (const State &state : states_)
    {
        call_ode(&dBodySetPosition, state.body, state.motion.position);
        call_ode(&dBodySetQuaternion, state.body, state.motion.orientation);
        call_ode(&dBodySetLinearVel, state.body, state.motion.linear_velocity);
        call_ode(&dBodySetAngularVel, state.body, state.motion.angular_velocity);
        call_ode(&dBodySetForce, state.body, state.force);
        call_ode(&dBodySetTorque, state.body, state.torque);
        if (state.awake != (dBodyIsEnabled(state.body) != 0))
            state.awake ? dBodyEnable(state.body) : dBodyDisable(state.body);
    }
}
} // namespace ode_predictive_space::haptics
