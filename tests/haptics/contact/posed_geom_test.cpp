// Geoms that the program poses at each tick, with no velocity or too small a one: tracked objects, lifts, doors.

#include "tests/haptics/contact/contact_fixture.h"

namespace ode_predictive_space::haptics
{
namespace
{
enum class Posed
{
    geom,              ///< without a body
    mesh,              ///< without a body
    convex,            ///< without a body; only dCollide() knows its surface
    body,              ///< kinematic
    body_with_velocity ///< kinematic; its velocity is a fifth of that of its poses
};

constexpr Posed all_kinds[] = {Posed::geom, Posed::mesh, Posed::convex, Posed::body, Posed::body_with_velocity};

class PosedGeomTest : public ContactTest
{
protected:
    static constexpr double side = 0.2;      // m
    static constexpr double pressed = 0.009; // m; final depth in the probe, which rests at the origin
    static constexpr int phases = 5;         // number of times within a tick at which the contact begins

    dGeomID add(Posed kind)
    {
        if (kind == Posed::mesh)
            return cube_.add_to(world_.space);
        if (kind == Posed::convex)
            return convex_.add_to(world_.space);
        const dGeomID box = dCreateBox(world_.space, side, side, side);
        if (kind != Posed::geom)
        {
            const dBodyID body = dBodyCreate(world_.world);
            dBodySetKinematic(body);
            dGeomSetBody(box, body);
        }
        return box;
    }

    static void remove(dGeomID geom)
    {
        const dBodyID body = dGeomGetBody(geom);
        dGeomDestroy(geom);
        if (body != nullptr)
            dBodyDestroy(body);
    }

    /// Lifts a geom at a speed (m/s) until its top is `pressed` deep in the probe. @return N; the final force.
    Vector3 force_of_lift(Posed kind, double speed, int phase)
    {
        const dGeomID geom = add(kind);
        const double start = -radius - 0.02 - speed * 0.001 * phase / phases; // m; of its top
        const double top = pressed - radius;
        const double way = top - start;
        const double begin = clock_.now();
        const auto put = [&](double seconds) {
            const double z = start + std::min(way, speed * std::max(0.0, seconds));
            dGeomSetPosition(geom, 0.01, 0.02, z - side / 2);
            if (kind == Posed::body_with_velocity)
                dBodySetLinearVel(dGeomGetBody(geom), 0, 0, z < top ? speed / 5 : 0);
        };
        put(0);
        const double rest = 0.05;
        const auto samples = run([](double) { return Vector3(0, 0, 0); }, rest + way / speed + rest,
                                 [&](double) { put(clock_.now() - begin - rest); });
        remove(geom);
        return samples.back().requested;
    }

    void expect_full_force(Posed kind, double speed)
    {
        for (int phase = 0; phase < phases; ++phase)
        {
            const Vector3 force = force_of_lift(kind, speed, phase);
            EXPECT_LE((force - Vector3(0, 0, k * pressed)).norm(), 0.01 * k * pressed)
                << force.transpose() << " N; kind " << static_cast<int>(kind) << ", " << speed << " m/s, phase "
                << phase;
        }
    }

private:
    const OdeMesh cube_{box_mesh(Vector3::Constant(-side / 2), Vector3::Constant(side / 2))};
    const ConvexCube convex_{side / 2};
};

INSTANTIATE_TEST_SUITE_P(Laws, PosedGeomTest, contact_tests, contact_test_name);

// Once, geoms faster than 0.1 m/s counted as having appeared, depending on the first depth: 4 % of the force.
TEST_P(PosedGeomTest, WhatIsPosedWithoutAVelocityPushesInFull)
{
    for (const Posed kind : all_kinds)
        for (const double speed : {0.05, 0.2, 0.5, 1.5, 2.0})
            expect_full_force(kind, speed);
    physics_rate_ = 200; // of a loop of two threads
    for (const Posed kind : all_kinds)
        if (decoupled())
            expect_full_force(kind, 0.5);
}

TEST_P(PosedGeomTest, WhatIsTurnedWithoutAVelocityPushesInFull)
{
    const Vector3 hinge(-0.15, 0, -radius + pressed);
    for (const double spin : {1.0, 5.0}) // rad/s
    {
        for (int phase = 0; phase < phases; ++phase)
        {
            const dGeomID door = dCreateBox(world_.space, 0.4, 0.4, 0.02);
            const double start = -0.3 - 0.001 * spin * phase / phases; // rad
            const double begin = clock_.now();
            const auto put = [&](double seconds) {
                const double angle = std::min(0.0, start + spin * std::max(0.0, seconds));
                dMatrix3 turn;
                dRFromAxisAndAngle(turn, 0, -1, 0, static_cast<dReal>(angle));
                dGeomSetRotation(door, turn);
                const Vector3 centre = hinge + Eigen::AngleAxisd(angle, -Vector3::UnitY()) *
                                                   Vector3(0.2, 0, -0.01); // its top at the hinge
                dGeomSetPosition(door, static_cast<dReal>(centre.x()), static_cast<dReal>(centre.y()),
                                 static_cast<dReal>(centre.z()));
            };
            put(0);
            const auto samples = run([](double) { return Vector3(0, 0, 0); }, 0.1 - start / spin,
                                     [&](double) { put(clock_.now() - begin - 0.05); });
            SCOPED_TRACE(std::to_string(spin) + " rad/s, phase " + std::to_string(phase));
            expect_force_at_end(samples, Vector3(0, 0, k * pressed), 0.01 * k * pressed);
            dGeomDestroy(door);
        }
    }
}

/// Damping needs the velocity of the poses.
TEST_P(PosedGeomTest, TheSurfaceHasTheVelocityOfItsPoses)
{
    const dGeomID lift = add(Posed::geom);
    const double start = -radius - 0.01; // m; of its top
    const auto put = [&](double seconds) { dGeomSetPosition(lift, 0, 0, start + 0.2 * seconds - side / 2); };
    put(0);
    Vector3 velocity = Vector3::Zero();
    run([](double) { return Vector3(0, 0, 0); }, 0.08,
        [&](double) {
            if (!probe_->touches().empty())
                velocity = probe_->touches().front().surface_velocity;
            put(clock_.now());
        });
    EXPECT_LE((velocity - Vector3(0, 0, 0.2)).norm(), 0.01) << velocity.transpose();
}

/// A geom moves at most 2 mm in a tick of 1 ms; a longer displacement means that it was put there.
TEST_P(PosedGeomTest, WhatIsPutIntoTheProbeStillAppears)
{
    for (const Posed kind : {Posed::geom, Posed::mesh, Posed::body})
    {
        const dGeomID geom = add(kind);
        dGeomSetPosition(geom, 0.01, 0.02, -radius - 0.005 - side / 2);
        const auto samples = run([](double) { return Vector3(0, 0, 0); }, 0.2, Once(clock_, clock_.now() + 0.1, [&] {
                                     dGeomSetPosition(geom, 0.01, 0.02, pressed - radius - side / 2);
                                 }));
        EXPECT_GT(samples.back().requested.z(), 0.1 * k * pressed) << "kind " << static_cast<int>(kind);
        EXPECT_LT(samples.back().requested.z(), 0.4 * k * pressed) << "kind " << static_cast<int>(kind);
        remove(geom);
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
