// Scenes for a hand that pushes them, in one thread and in two.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_FORECAST_COUPLING_SCENE_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_FORECAST_COUPLING_SCENE_H

#include "tests/haptics/support/probe_world.h"

#include <cmath>
#include <functional>
#include <memory>
#include <ode/ode.h>
#include <utility>
#include <vector>

namespace ode_predictive_space::haptics
{
enum class Stepper
{
    exact, ///< dWorldStep()
    quick  ///< dWorldQuickStep()
};

/// A world whose bodies a hand pushes, with its measurements.
class CouplingScene : public ProbeWorld
{
public:
    explicit CouplingScene(Stepper stepper) : joints(dJointGroupCreate(0))
    {
        if (stepper == Stepper::quick)
            step_world = &dWorldQuickStep;
    }
    ~CouplingScene() { dJointGroupDestroy(joints); }

    void set_gravity() { dWorldSetGravity(world, 0, 0, -gravity); }

    dBodyID add_ball(double kilograms, double ball_radius, const Vector3 &at)
    {
        dMass mass;
        dMassSetSphereTotal(&mass, kilograms, ball_radius);
        return add(dCreateSphere(space, ball_radius), mass, at);
    }

    dBodyID add_box(double kilograms, const Vector3 &sides, const Vector3 &at)
    {
        dMass mass;
        dMassSetBoxTotal(&mass, kilograms, sides.x(), sides.y(), sides.z());
        return add(dCreateBox(space, sides.x(), sides.y(), sides.z()), mass, at);
    }

    void add_box_to(dBodyID body, const Vector3 &sides, const Vector3 &offset)
    {
        const dGeomID box = dCreateBox(space, sides.x(), sides.y(), sides.z());
        dGeomSetBody(box, body);
        dGeomSetOffsetPosition(box, offset.x(), offset.y(), offset.z());
    }

    void connect_by_ball(dBodyID one, dBodyID other, const Vector3 &anchor, dJointGroupID group = nullptr)
    {
        const dJointID joint = attached(dJointCreateBall(world, group), one, other);
        dJointSetBallAnchor(joint, anchor.x(), anchor.y(), anchor.z());
    }

    dJointID connect_by_hinge(dBodyID one, dBodyID other, const Vector3 &anchor, const Vector3 &axis)
    {
        const dJointID joint = attached(dJointCreateHinge(world, nullptr), one, other);
        dJointSetHingeAnchor(joint, anchor.x(), anchor.y(), anchor.z());
        dJointSetHingeAxis(joint, axis.x(), axis.y(), axis.z());
        return joint;
    }

    void connect_by_slider(dBodyID one, dBodyID other, const Vector3 &axis)
    {
        const dJointID joint = attached(dJointCreateSlider(world, nullptr), one, other);
        dJointSetSliderAxis(joint, axis.x(), axis.y(), axis.z());
    }

    void destroy(std::size_t body)
    {
        while (const dGeomID geom = dBodyGetFirstGeom(bodies[body]))
            dGeomDestroy(geom);
        dBodyDestroy(bodies[body]);
        bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(body));
    }

    /// N; the forces on the bodies before a step, all of which are the hand's.
    Vector3 force_of_hand() const
    {
        Vector3 sum = Vector3::Zero();
        for (const dBodyID body : bodies)
        {
            const dReal *force = dBodyGetForce(body);
            sum += Vector3(force[0], force[1], force[2]);
        }
        return sum;
    }

    /// m/s; of the fastest body.
    double speed() const
    {
        double fastest = 0;
        for (const dBodyID body : bodies)
        {
            const dReal *v = dBodyGetLinearVel(body);
            fastest = std::max(fastest, Vector3(v[0], v[1], v[2]).norm());
        }
        return fastest;
    }

    /// J; kinetic and potential.
    double energy() const
    {
        double sum = 0;
        dVector3 g;
        dWorldGetGravity(world, g);
        for (const dBodyID body : bodies)
        {
            dMass mass;
            dBodyGetMass(body, &mass);
            const dReal *v = dBodyGetLinearVel(body);
            const dReal *w = dBodyGetAngularVel(body);
            dVector3 spin;
            dBodyVectorFromWorld(body, w[0], w[1], w[2], spin);
            sum += 0.5 * mass.mass * Vector3(v[0], v[1], v[2]).squaredNorm() -
                   mass.mass * g[2] * dBodyGetPosition(body)[2];
            for (int axis = 0; axis < 3; ++axis)
                sum += 0.5 * mass.I[5 * axis] * spin[axis] * spin[axis];
        }
        return sum;
    }

    static constexpr double gravity = 9.81; // m/s^2
    const dJointGroupID joints;             ///< for joints that are destroyed together
    std::vector<dBodyID> bodies;

private:
    dBodyID add(dGeomID geom, const dMass &mass, const Vector3 &at)
    {
        const dBodyID body = dBodyCreate(world);
        dBodySetMass(body, &mass);
        dGeomSetBody(geom, body);
        dBodySetPosition(body, at.x(), at.y(), at.z());
        bodies.push_back(body);
        return body;
    }

    static dJointID attached(dJointID joint, dBodyID one, dBodyID other)
    {
        dJointAttach(joint, one, other);
        return joint;
    }
};

struct HandWay
{
    Vector3 from;
    Vector3 direction; ///< of length 1
    double length;     ///< m
    double speed;      ///< m/s
    double duration;   ///< s; from the start of the motion
    double sway = 0;   ///< m; amplitude of an oscillation along x at 1 Hz

    static constexpr double rests = 1; ///< s; rest before the motion, while forces ramp in

    Vector3 at(double time) const
    {
        const double out = std::max(time - rests, 0.0);
        return from + std::min(out * speed, length) * direction +
               sway * std::sin(2 * EIGEN_PI * out) * Vector3::UnitX();
    }
};

struct CouplingCase
{
    static constexpr double stiffness = 500; ///< N/m

    std::function<void(CouplingScene &)> build;
    HandWay hand;
    double spread_along = 0.003;  ///< m; spread of an ensemble's hands in y
    double spread_across = 0.004; ///< m; spread in z
    double friction = 0;          ///< coefficient; of the probe
    double most_unmatched = 1e-9; ///< see Outcome
    bool by_proxy = false;        ///< proxy law; otherwise penalty law

    std::function<void(CouplingScene &)> change; ///< the program's change of the scene; may be empty
    double change_time = 0.7;                    ///< s; from the start of the motion

    std::shared_ptr<ForceLaw> law() const
    {
        Material material;
        material.stiffness = stiffness;
        material.friction = friction;
        return make_law(by_proxy, material);
    }
};

/// Balls with a gap of 2 mm, the uppermost held by a joint. The hand pushes in the middle, then rests.
/// @param grouped whether the joints are in the scene's group.
inline CouplingCase rope(int count, double kilograms, bool grouped = false)
{
    CouplingCase rope;
    rope.build = [=](CouplingScene &scene) {
        scene.set_gravity();
        dBodyID above = nullptr;
        for (int i = 0; i < count; ++i)
        {
            const dBodyID ball = scene.add_ball(kilograms, 0.009, {0, 0, -0.02 * i});
            scene.connect_by_ball(ball, above, {0, 0, -0.02 * i + 0.01}, grouped ? scene.joints : nullptr);
            above = ball;
        }
    };
    rope.hand = {{-0.06, 0, -0.01 * count}, Vector3::UnitX(), 0.1, 0.1, 3.8};
    return rope;
}

/// The hand is near from the beginning, because ODE alone does not hold this rope at 60 and 100 Hz.
inline CouplingCase rope_of_twenty()
{
    CouplingCase twenty = rope(20, 0.002);
    twenty.hand.from.x() = -0.028;
    twenty.hand.length = 0.068;
    return twenty;
}

inline CouplingCase door()
{
    CouplingCase door;
    door.build = [](CouplingScene &scene) {
        const dBodyID leaf = scene.add_box(0.5, {0.4, 0.02, 0.5}, {0.2, 0, 0});
        scene.connect_by_hinge(leaf, nullptr, Vector3::Zero(), Vector3::UnitZ());
    };
    door.hand = {{0.35, -0.04, 0}, Vector3::UnitY(), 0.12, 0.1, 2.8};
    return door;
}

inline CouplingCase slider()
{
    CouplingCase slider;
    slider.build = [](CouplingScene &scene) {
        scene.set_gravity();
        const dBodyID cart = scene.add_box(0.05, {0.04, 0.04, 0.04}, Vector3::Zero());
        scene.connect_by_slider(cart, nullptr, Vector3::UnitX());
        const dBodyID bob = scene.add_ball(0.01, 0.009, {0, 0, -0.04});
        scene.connect_by_ball(bob, cart, {0, 0, -0.03});
    };
    slider.hand = {{-0.06, 0, 0}, Vector3::UnitX(), 0.1, 0.1, 2};
    return slider;
}

/// Boxes of 50 g. The hand, which is near from the beginning, pushes the one in the middle.
inline CouplingCase stack(int count)
{
    constexpr double pressed = 1e-5; // m; so that they are in contact from the beginning
    CouplingCase stack;
    stack.build = [=](CouplingScene &scene) {
        scene.set_gravity();
        dCreatePlane(scene.space, 0, 0, 1, 0);
        for (int i = 0; i < count; ++i)
            scene.add_box(0.05, {0.04, 0.04, 0.04}, {0, 0, 0.02 - pressed + (0.04 - pressed) * i});
    };
    stack.hand = {{-0.039, 0, 0.02 * count}, Vector3::UnitX(), 0.024, 0.05, 2.1};
    stack.spread_across = 0.002;
    return stack;
}

inline CouplingCase ragdoll()
{
    CouplingCase ragdoll;
    ragdoll.build = [](CouplingScene &scene) {
        scene.set_gravity();
        const dBodyID trunk = scene.add_box(0.2, {0.03, 0.06, 0.1}, Vector3::Zero());
        scene.connect_by_ball(trunk, nullptr, {0, 0, 0.06});
        for (const double side : {-1.0, 1.0})
        {
            for (const bool leg : {false, true})
            {
                const double y = side * (leg ? 0.02 : 0.045);
                const double top = leg ? -0.055 : 0.045;
                const dBodyID upper = scene.add_box(0.02, {0.016, 0.016, 0.05}, {0, y, top - 0.03});
                const dBodyID lower = scene.add_box(0.01, {0.014, 0.014, 0.05}, {0, y, top - 0.09});
                scene.connect_by_ball(upper, trunk, {0, y, top});
                const dJointID knee = scene.connect_by_hinge(lower, upper, {0, y, top - 0.06}, Vector3::UnitY());
                dJointSetHingeParam(knee, dParamLoStop, -1.5);
                dJointSetHingeParam(knee, dParamHiStop, 0.1);
            }
        }
    };
    ragdoll.hand = {{-0.05, 0.01, 0}, Vector3::UnitX(), 0.07, 0.1, 2};
    ragdoll.spread_across = 0.002;
    return ragdoll;
}

inline CouplingCase held_ball()
{
    CouplingCase ball;
    ball.build = [](CouplingScene &scene) {
        dCreatePlane(scene.space, -1, 0, 0, -0.01);
        scene.add_ball(0.01, 0.01, Vector3::Zero());
    };
    ball.hand = {{-0.03, 0, 0}, Vector3::UnitX(), 0.012, 0.02, 3.8};
    return ball;
}

/// A box of 1 kg, pressed on the floor with 2.81 N.
inline CouplingCase leaning(double duration)
{
    CouplingCase box;
    box.build = [](CouplingScene &scene) {
        scene.set_gravity();
        dCreatePlane(scene.space, 0, 0, 1, 0);
        scene.add_box(1, {0.2, 0.2, 0.1}, {0, 0, 0.05});
    };
    box.hand = {{0, 0, 0.12}, -Vector3::UnitZ(), 0.01562, 0.02, duration};
    box.spread_across = 0;
    return box;
}

/// As leaning(), but with friction: the hand rubs back and forth over the box, which is too heavy to be dragged along.
inline CouplingCase scrubbing(double duration)
{
    CouplingCase box = leaning(duration);
    box.hand.sway = 0.02;
    box.friction = 0.4;
    return box;
}

inline CouplingCase free_balls(const std::vector<double> &kilograms)
{
    CouplingCase balls;
    balls.build = [=](CouplingScene &scene) {
        const double middle = 0.5 * static_cast<double>(kilograms.size() - 1);
        for (std::size_t i = 0; i < kilograms.size(); ++i)
            scene.add_ball(kilograms[i], 0.01, {0, 0.021 * (middle - static_cast<double>(i)), 0});
    };
    balls.hand = {{-0.03, 0, 0}, Vector3::UnitX(), 1, 0.1, 1.8};
    balls.spread_along = 0.001;
    balls.spread_across = 0.001;
    return balls;
}

/// A free body with an inner corner. The hand pushes there and touches it twice.
inline CouplingCase corner()
{
    CouplingCase corner;
    corner.build = [](CouplingScene &scene) {
        const dBodyID body = scene.add_box(0.03, {0.01, 0.06, 0.06}, {0.025, 0.025, 0});
        dGeomSetOffsetPosition(dBodyGetFirstGeom(body), 0, -0.025, 0);
        scene.add_box_to(body, {0.05, 0.01, 0.06}, {-0.03, 0, 0});
        dMass mass;
        dMassSetBoxTotal(&mass, 0.03, 0.06, 0.06, 0.06);
        dBodySetMass(body, &mass);
    };
    corner.hand = {{-0.04, -0.04, 0}, Vector3(1, 1, 0).normalized(), 0.2, 0.1, 1.5};
    return corner;
}

inline CouplingCase dragged_cart()
{
    CouplingCase cart;
    cart.build = [](CouplingScene &scene) {
        const dBodyID body = scene.add_box(0.1, {0.2, 0.06, 0.04}, Vector3::Zero());
        scene.connect_by_slider(body, nullptr, Vector3::UnitX());
    };
    cart.hand = {{-0.05, 0, 0.036}, Vector3(1, 0, -0.2).normalized(), 0.06, 0.1, 1.5};
    cart.spread_across = 0;
    cart.friction = 0.5;
    return cart;
}

inline CouplingCase with_friction(CouplingCase scenario, double friction)
{
    scenario.friction = friction;
    return scenario;
}

inline CouplingCase by_proxy_law(CouplingCase scenario)
{
    scenario.by_proxy = true;
    return scenario;
}

inline CouplingCase with_change(CouplingCase scenario, std::function<void(CouplingScene &)> change)
{
    scenario.change = std::move(change);
    return scenario;
}
} // namespace ode_predictive_space::haptics

#endif
