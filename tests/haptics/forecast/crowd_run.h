// Hands press on many light bodies, in one thread or in two. In simulated time both run in one, so that all runs are alike.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_FORECAST_CROWD_RUN_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_FORECAST_CROWD_RUN_H

#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/virtual_device.h"
#include "tests/haptics/forecast/coupling_scene.h"
#include "tests/haptics/support/scripted_device.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <ostream>
#include <string>
#include <vector>

namespace ode_predictive_space::haptics
{
enum class Crowd
{
    pit,  ///< balls side by side on a floor, between four walls
    pile, ///< balls in two layers, dropped into a pit
    wedge ///< free boxes around the sphere, whose faces lean outwards
};

struct CrowdCase
{
    Crowd crowd = Crowd::pit;
    int bodies = 5;
    double kilograms = 0.005;
    double opening = 10;     ///< degrees; of a wedge
    bool by_proxy = true;    ///< proxy law; otherwise penalty law
    double physics_rate = 0; ///< Hz; of the scene in two threads, 0: one thread at 1 kHz
    Stepper stepper = Stepper::quick;
    bool by_collide = false; ///< the balls are in geom transforms, whose surface only dCollide() knows
};

inline std::string name_of(const CrowdCase &scenario)
{
    const char *crowds[] = {"Pit", "Pile", "Wedge"};
    std::string name = crowds[static_cast<int>(scenario.crowd)];
    if (scenario.crowd == Crowd::wedge)
        name += std::to_string(static_cast<int>(10 * scenario.opening)) + "Tenths";
    name += "Of" + std::to_string(scenario.bodies) + "Of" + std::to_string(std::lround(1000 * scenario.kilograms)) +
            "Grams";
    name += scenario.by_proxy ? "ByProxy" : "ByPenalty";
    name += scenario.physics_rate == 0 ? "InOneThread"
                                       : "At" + std::to_string(static_cast<int>(scenario.physics_rate)) + "Hz";
    return name + (scenario.stepper == Stepper::exact ? "Exact" : "") + (scenario.by_collide ? "ByCollide" : "");
}

struct CrowdOutcome
{
    double peak_force = 0;     ///< N; requested
    double largest_change = 0; ///< N; of the requested force in a tick
    double excess = 0;         ///< N; its part that the motion of hand and bodies does not explain
    double fastest = 0;        ///< m/s; of the bodies
    double made_energy = 0;    ///< J; largest sum of the energy given to hand and bodies and that of the spring
    double exchanged = 0;      ///< J; sum of the magnitudes of the hand's work
    double impulse = 0;        ///< N s; sum of the magnitudes on the hand

    /// J; the part of the energy that errors of measurement do not explain.
    double surplus() const { return std::max(0.0, made_energy - 0.05 * exchanged); }
};

inline std::ostream &operator<<(std::ostream &stream, const CrowdOutcome &outcome)
{
    return stream << "force up to " << outcome.peak_force << " N, impulse " << outcome.impulse
                  << " N s, largest change " << outcome.largest_change << " N, unexplained " << outcome.excess
                  << " N, fastest body " << outcome.fastest << " m/s, energy made " << 1000 * outcome.made_energy
                  << " mJ of " << 1000 * outcome.exchanged << " mJ";
}

/// The work of the hand's pushes on bodies in a step. With the mean velocity of a step it is exact, whatever else pushes them.
class WorkOnBodies
{
public:
    /// @param bodies with the forces of the hand, before the step.
    explicit WorkOnBodies(const std::vector<dBodyID> &bodies)
    {
        for (const dBodyID body : bodies)
            pushed_.push_back({body, vector(dBodyGetForce(body)), vector(dBodyGetTorque(body)),
                               vector(dBodyGetLinearVel(body)), vector(dBodyGetAngularVel(body))});
    }

    /// @return J. @param dt s; length of the step since the constructor.
    double of_step(double dt) const
    {
        double work = 0;
        for (const Pushed &each : pushed_)
            work += 0.5 * dt *
                    (each.force.dot(each.velocity + vector(dBodyGetLinearVel(each.body))) +
                     each.torque.dot(each.spin + vector(dBodyGetAngularVel(each.body))));
        return work;
    }

private:
    struct Pushed
    {
        dBodyID body;
        Vector3 force, torque;
        Vector3 velocity, spin;
    };

    static Vector3 vector(const dReal *v) { return {v[0], v[1], v[2]}; }

    std::vector<Pushed> pushed_;
};

class CrowdRun
{
public:
    static constexpr double stiffness = 500;     ///< N/m
    static constexpr double probe_radius = 0.03; ///< m
    static constexpr double ball = 0.01;         ///< m

    /// @param hand 0 to 7; it decides the hand's path and the places of the balls.
    CrowdRun(const CrowdCase &scenario, int hand) : scene_(scenario.stepper), scenario_(scenario), random_(hand)
    {
        dRandSetSeed(1);
        build();
        VirtualDeviceSettings settings;
        settings.capabilities.workspace = {Vector3::Constant(-0.5), Vector3::Constant(0.5)};
        VirtualDevice device(settings, [this, hand](double seconds) { return target(seconds, hand); });
        HapticProbe probe(device, scene_.space, probe_radius, with_law(law()));
        probe.set_recorder([&](const RenderedTick &tick) { note(tick, device.true_position()); });
        run(probe);
    }

    const CrowdOutcome &outcome() const { return outcome_; }

private:
    struct Change
    {
        double force; ///< N
        double tool;  ///< m
    };

    static constexpr double tick_length = 0.001; ///< s
    static constexpr double rests = 1;           ///< s; balls come to rest and forces ramp in

    std::shared_ptr<ForceLaw> law() const { return make_law(scenario_.by_proxy, Material{stiffness}); }

    /// m; down through the bodies, with some motion aside.
    Vector3 target(double seconds, int hand) const
    {
        const double down = 0.1 * std::clamp(seconds - rests - 0.02 * hand / 8, 0.0, 0.6);
        return {0.004 * std::sin(seconds * 3 + hand), 0.003 * std::cos(seconds * 2 + hand), top_ + 0.03 - down};
    }

    void build()
    {
        if (scenario_.crowd == Crowd::wedge)
            return add_wedge();
        scene_.set_gravity();
        dCreatePlane(scene_.space, 0, 0, 1, 0);
        const int layer = scenario_.crowd == Crowd::pit ? scenario_.bodies : (scenario_.bodies + 1) / 2;
        const int row = static_cast<int>(std::ceil(std::sqrt(layer)));
        const double half = 1.1 * ball * row + 0.002; // m; of the pit
        add_pit(half);
        for (int i = 0; i < scenario_.bodies; ++i)
        {
            const Vector3 cell(i % layer % row, i % layer / row, i / layer);
            const Vector3 noise = 0.001 * Vector3(number(), number(), 0.01 * number());
            const dBodyID body = scene_.add_ball(scenario_.kilograms, ball,
                                                 Vector3(1.15 * ball - half, 1.15 * ball - half, 1.01 * ball) +
                                                     2.15 * ball * cell + noise);
            if (scenario_.by_collide)
                wrap(body);
        }
        top_ = (scenario_.crowd == Crowd::pit ? 2 : 3.7) * ball + probe_radius;
    }

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations" // dGeomTransform is deprecated, but supported
    void wrap(dBodyID body) const
    {
        const dGeomID sphere = dBodyGetFirstGeom(body), transform = dCreateGeomTransform(scene_.space);
        dSpaceRemove(scene_.space, sphere);
        dGeomSetBody(sphere, nullptr);
        dGeomSetPosition(sphere, 0, 0, 0); // in the transform's frame
        dGeomTransformSetGeom(transform, sphere);
        dGeomTransformSetCleanup(transform, 1);
        dGeomSetBody(transform, body);
    }
#pragma GCC diagnostic pop

    void add_pit(double half)
    {
        for (int side = 0; side < 4; ++side)
        {
            const double angle = side * M_PI / 2;
            const dGeomID wall = dCreateBox(scene_.space, 0.02, 0.5, 0.2);
            dMatrix3 turn;
            dRFromAxisAndAngle(turn, 0, 0, 1, angle);
            dGeomSetRotation(wall, turn);
            dGeomSetPosition(wall, (half + 0.01) * std::cos(angle), (half + 0.01) * std::sin(angle), -0.09 + ball);
        }
    }

    void add_wedge()
    {
        const double lean = scenario_.opening * M_PI / 360;
        constexpr double thickness = 0.02; // m
        for (int i = 0; i < scenario_.bodies; ++i)
        {
            const double angle = 2 * M_PI * i / scenario_.bodies + 0.02 * number();
            const Vector3 outwards(std::cos(angle), std::sin(angle), 0);
            const Vector3 inwards = std::sin(lean) * Vector3::UnitZ() - std::cos(lean) * outwards;
            const Vector3 across = Vector3::UnitZ().cross(outwards), up = inwards.cross(across);
            const dBodyID body =
                scene_.add_box(scenario_.kilograms, {thickness, 0.005, 0.2}, -(probe_radius + thickness / 2) * inwards);
            const dMatrix3 turn = {inwards.x(), across.x(), up.x(),      0,          inwards.y(), across.y(),
                                   up.y(),      0,          inwards.z(), across.z(), up.z(),      0};
            dBodySetRotation(body, turn);
        }
        top_ = 0;
    }

    void run(HapticProbe &probe)
    {
        const bool decoupled = scenario_.physics_rate > 0;
        HapticLoop loop(probe, simulated(clock_, 2.5, decoupled, decoupled ? scenario_.physics_rate : 1000));
        loop.run({[&] { scene_.collide(probe); }, [&](double dt) { step(dt); }});
    }

    void step(double dt)
    {
        const WorkOnBodies work(scene_.bodies);
        scene_.step(dt);
        given_ += work.of_step(dt);
        outcome_.fastest = std::max(outcome_.fastest, pushed_ ? scene_.speed() : 0);
        if (scenario_.physics_rate > 0)
            explain_changes(std::max(speed_, scene_.speed()));
        speed_ = scene_.speed();
        const double stored = scenario_.by_proxy ? last_requested_.squaredNorm() / (2 * stiffness) : 0;
        outcome_.made_energy = std::max(outcome_.made_energy, given_ + stored);
    }

    void note(const RenderedTick &tick, const Vector3 &place)
    {
        if (has_tick_)
        {
            const double work = last_force_.dot(place - last_place_);
            given_ += work;
            outcome_.exchanged += std::abs(work);
            changes_.push_back({(tick.requested - last_requested_).norm(), (tick.tool.position - last_tool_).norm()});
            if (scenario_.physics_rate == 0)
                explain_changes(speed_);
        }
        outcome_.peak_force = std::max(outcome_.peak_force, tick.requested.norm());
        outcome_.impulse += tick.force.norm() * tick_length;
        pushed_ = pushed_ || !tick.force.isZero(0);
        has_tick_ = true;
        last_requested_ = tick.requested;
        last_force_ = tick.force;
        last_place_ = place;
        last_tool_ = tick.tool.position;
    }

    /// In two threads, the servo predicts the motion of the scene's next step. @param speed m/s; of the fastest body.
    void explain_changes(double speed)
    {
        const double of_surfaces = std::max(stiffness, std::sqrt(stiffness * scenario_.kilograms / 2) / tick_length);
        for (const Change &each : changes_)
        {
            const double explained = stiffness * each.tool + of_surfaces * speed * tick_length + 0.1;
            outcome_.largest_change = std::max(outcome_.largest_change, each.force);
            outcome_.excess = std::max(outcome_.excess, each.force - explained);
        }
        changes_.clear();
    }

    double number()
    {
        random_ = random_ * 1103515245u + 12345u;
        return static_cast<double>((random_ >> 8) & 0xffffu) / 32767.5 - 1;
    }

    const OdeUse ode_;
    SimulatedClock clock_;
    CouplingScene scene_;
    const CrowdCase scenario_;
    unsigned random_;
    double top_ = 0; ///< m; height of the probe that touches the bodies
    CrowdOutcome outcome_;
    double given_ = 0;            ///< J; to hand and bodies
    double speed_ = 0;            ///< m/s; of the fastest body
    std::vector<Change> changes_; ///< of the ticks since the last step
    bool pushed_ = false;
    bool has_tick_ = false;
    Vector3 last_requested_ = Vector3::Zero();
    Vector3 last_force_ = Vector3::Zero();
    Vector3 last_place_ = Vector3::Zero();
    Vector3 last_tool_ = Vector3::Zero();
};

constexpr int hands_of_crowd = 8; // of an ensemble

/// Expects that no hand makes energy and no force jumps. @return mean forces and impulses, and the fastest body of all.
inline CrowdOutcome expect_quiet(const CrowdCase &scenario)
{
    CrowdOutcome mean;
    for (int hand = 0; hand < hands_of_crowd; ++hand)
    {
        const CrowdOutcome outcome = CrowdRun(scenario, hand).outcome();
        EXPECT_LE(outcome.surplus(), 0.0005) << name_of(scenario) << ", hand " << hand << ": " << outcome;
        EXPECT_LE(outcome.excess, 0) << name_of(scenario) << ", hand " << hand << ": " << outcome;
        EXPECT_GT(outcome.peak_force, 0.01);
        mean.peak_force += outcome.peak_force / hands_of_crowd;
        mean.impulse += outcome.impulse / hands_of_crowd;
        mean.fastest = std::max(mean.fastest, outcome.fastest);
    }
    return mean;
}

/// Ensembles are compared, because single traces are too sensitive.
inline void expect_as_in_one_thread(const CrowdCase &scenario)
{
    CrowdCase in_one = scenario;
    in_one.physics_rate = 0;
    const CrowdOutcome truth = expect_quiet(in_one), found = expect_quiet(scenario);
    const double allowed = scenario.physics_rate < 200 ? 0.3 : 0.15;
    EXPECT_NEAR(found.peak_force, truth.peak_force, allowed * truth.peak_force);
    EXPECT_NEAR(found.impulse, truth.impulse, allowed * truth.impulse);
    EXPECT_LE(found.fastest, 2 * truth.fastest);
}

inline std::string name_of_crowd(const testing::TestParamInfo<CrowdCase> &info)
{
    return name_of(info.param);
}

} // namespace ode_predictive_space::haptics

#endif
