#include "demos/worlds/ragdoll.h"

#include "demos/worlds/objects.h"

#include <algorithm>
#include <array>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double density = 1000; // kg/m^3

/// From a joint with another limb to its end, in metres.
struct Limb
{
    int parent; ///< < 0: none
    Vector3 begin;
    Vector3 end;
    double radius;
};

const std::array<Limb, 12> &limbs()
{
    static const std::array<Limb, 12> all = {{
        {-1, {-0.1, 0, 1}, {0.1, 0, 1}, 0.08},          // pelvis
        {0, {0, 0, 1.05}, {0, 0, 1.22}, 0.07},          // spine
        {1, {0, 0, 1.22}, {0, 0, 1.5}, 0.12},           // chest
        {2, {0, 0, 1.5}, {0, 0, 1.75}, 0.09},           // head
        {2, {0.2, 0, 1.45}, {0.46, 0, 1.45}, 0.05},     // upper arms
        {2, {-0.2, 0, 1.45}, {-0.46, 0, 1.45}, 0.05},   //
        {4, {0.46, 0, 1.45}, {0.74, 0, 1.45}, 0.045},   // lower arms
        {5, {-0.46, 0, 1.45}, {-0.74, 0, 1.45}, 0.045}, //
        {0, {0.1, 0, 0.95}, {0.1, 0, 0.53}, 0.07},      // upper legs
        {0, {-0.1, 0, 0.95}, {-0.1, 0, 0.53}, 0.07},    //
        {8, {0.1, 0, 0.53}, {0.1, 0, 0.08}, 0.06},      // lower legs
        {9, {-0.1, 0, 0.53}, {-0.1, 0, 0.08}, 0.06},    //
    }};
    return all;
}

dBodyID add_limb(Objects &objects, const Limb &limb, const Vector3 &place, const Quaternion &orientation)
{
    const Vector3 along = limb.end - limb.begin;
    const double length = std::max(0.02, along.norm() - 2 * limb.radius);
    const double volume = pi * limb.radius * limb.radius * (length + 4.0 / 3.0 * limb.radius);
    BodyState state;
    state.position = place + orientation * (0.5 * (limb.begin + limb.end));
    state.orientation = orientation * Quaternion::FromTwoVectors(Vector3::UnitZ(), along);
    return objects.add_body(dCreateCapsule(objects.space(), limb.radius, length), density * volume, state);
}
} // namespace

void add_ragdoll(Objects &objects, const Vector3 &place, const Quaternion &orientation)
{
    std::array<dBodyID, 12> bodies{};
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
        const Limb &limb = limbs()[i];
        bodies[i] = add_limb(objects, limb, place, orientation);
        if (limb.parent >= 0)
        {
            const Vector3 anchor = place + orientation * limb.begin;
            const dJointID joint = dJointCreateBall(objects.world(), nullptr);
            dJointAttach(joint, bodies[i], bodies[static_cast<std::size_t>(limb.parent)]);
            dJointSetBallAnchor(joint, anchor.x(), anchor.y(), anchor.z());
        }
    }
}
} // namespace ode_predictive_space::worlds
