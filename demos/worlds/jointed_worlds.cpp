// Bodies joined by hinges with motors, or by balls: chain, ragdolls.

#include "demos/worlds/lists.h"
#include "demos/worlds/stepped_world.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ode_predictive_space::worlds
{
namespace
{
constexpr double chain_step = 0.004;
constexpr int links = 17;
constexpr double link_length = 0.2;  // metres
constexpr double link_radius = 0.06; // metres
constexpr double link_torque = 8;    // N m
constexpr double fastest_link = 2;   // rad/s
constexpr double place_for_one = 2;  // metres

class ChainWorld : public ProgramWorld
{
public:
    ChainWorld(const WorldSpec &spec, dSpaceID space) : ProgramWorld(spec, space, chain_step)
    {
        objects_.add_geom(dCreatePlane(space, 0, 0, 1, 0));
        for (int i = 0; i < spec.objects; ++i)
            add_chain(place_for_one * i);
    }

private:
    void add_chain(double y)
    {
        dBodyID last = nullptr;
        for (int i = 0; i < links; ++i)
        {
            BodyState state;
            state.position = {link_length * i, y, link_radius + 0.02};
            const dGeomID geom = i % 2 == 0
                                     ? dCreateBox(objects_.space(), link_length, 2 * link_radius, 2 * link_radius)
                                     : dCreateSphere(objects_.space(), link_radius);
            const dBodyID body = objects_.add_body(geom, 0.5, state);
            if (last != nullptr)
                join(last, body, i);
            last = body;
        }
    }

    void join(dBodyID last, dBodyID body, int number)
    {
        const dReal *place = dBodyGetPosition(body);
        const dJointID hinge = dJointCreateHinge(objects_.world(), nullptr);
        dJointAttach(hinge, last, body);
        dJointSetHingeAnchor(hinge, place[0] - link_length / 2, place[1], place[2]);
        dJointSetHingeAxis(hinge, 0, number % 2, 1 - number % 2);
        hinges_.push_back(hinge);
    }

    void before_step() override
    {
        time_ += step();
        for (std::size_t i = 0; i < hinges_.size(); ++i)
            drive(hinges_[i], fastest_link * std::sin(2 * time_ + 0.8 * static_cast<double>(i)), link_torque);
    }

    std::vector<dJointID> hinges_;
    double time_ = 0;
};

Bounds chain_bounds(int chains)
{
    return {{link_length * links / 2, place_for_one * chains / 2, 0}, {5, place_for_one * chains + 2, 2}};
}

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

/// Twelve capsules. @param place of the feet; the ragdoll stands on them, turned by `orientation`.
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

constexpr double ragdolls_step = 0.005;
constexpr int stairs = 12;
constexpr double stair_depth = 0.6;        // metres
constexpr double stair_rise = 0.25;        // metres
constexpr double half_width_of_stairs = 5; // metres
constexpr int side_by_side = 5;            // ragdolls

class RagdollsWorld : public ProgramWorld
{
public:
    RagdollsWorld(const WorldSpec &spec, dSpaceID space) : ProgramWorld(spec, space, ragdolls_step)
    {
        objects_.add_geom(dCreatePlane(space, 0, 0, 1, 0));
        for (int stair = 0; stair < stairs; ++stair)
        {
            const double height = stair_rise * (stair + 1);
            set_position(objects_.add_scenery(dCreateBox(space, stair_depth, 2 * half_width_of_stairs, height)),
                         {stair_depth * stair, 0, height / 2});
        }
        for (int i = 0; i < spec.objects; ++i)
        {
            const double side = place_for_one * (i % side_by_side - 0.5 * (side_by_side - 1));
            const double up = place_for_one * static_cast<double>(i / side_by_side);
            const Quaternion turn(Eigen::AngleAxisd(random_.uniform(-pi, pi), random_.direction()));
            const Vector3 place(stair_depth * stairs * random_.unit(), side, stair_rise * stairs + 1.5 + up);
            add_ragdoll(objects_, place, turn);
        }
    }
};

Bounds ragdolls_bounds(int)
{
    return {{stair_depth * stairs / 2, 0, 5}, {stair_depth * stairs, 2 * half_width_of_stairs, 10}};
}

} // namespace

std::vector<WorldEntry> jointed_worlds()
{
    return {
        {Group::program, "ragdolls", "n ragdolls of 12 capsules that fall on stairs", 20, ragdolls_step,
         &ragdolls_bounds, made_of<RagdollsWorld>()},
        {Group::program, "chain", "n robots of 17 bodies with motors on a plane", 1, chain_step, &chain_bounds,
         made_of<ChainWorld>()},
    };
}
} // namespace ode_predictive_space::worlds
