// The probe is inside an object whose surface it never crossed: at the start, after a jump, or because the object appeared.

#include "tests/haptics/contact/contact_fixture.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
const Vector3 far_away(0.02, 0.01, 1);

/// A closed mesh with dents, about the origin, radius 0.1 m. Its highest place is flat enough to press on.
MeshShape dented_mesh()
{
    MeshShape shape = sphere_mesh(0.1, 48);
    for (Vector3 &vertex : shape.vertices)
        vertex *= 1 - 0.15 * std::pow(std::sin(40 * vertex.x()) * std::sin(30 * vertex.y()), 2);
    return shape;
}

class StartInsideTest : public ContactTest
{
protected:
    using Samples = std::vector<Sample>;

    /// Rests at `start`, moves 1 m away until 1 s, comes back from above, and at 2 s presses 2 mm into the object below z = 0.
    static ScriptedDevice::Path out_and_back(const Vector3 &start)
    {
        const Vector3 above(0, 0, 0.05);
        return [=](double t) {
            return t < 1     ? between(start, far_away, 0.3, 0.5, t)
                   : t < 1.5 ? between(far_away, above, 1, 0.4, t)
                             : between(above, {0, 0, radius - 0.002}, 1.5, 0.5, t);
        };
    }

    static void expect_force_at_end_only(const Samples &samples, double from = 0, double to = 1.5)
    {
        expect_no_force(samples, from, to);
        expect_force_at_end(samples, Vector3(0, 0, k * 0.002), 0.02 * k * 0.002);
    }

    void expect_felt_only_after_it_was_left(const Vector3 &start)
    {
        expect_force_at_end_only(run(out_and_back(start), 2.2));
    }

    dBodyID add_kinematic_box(const Vector3 &sides, const Vector3 &position, const Vector3 &velocity)
    {
        const dBodyID body = world_.add_moving_box(sides, position, 1);
        dBodySetKinematic(body);
        dBodySetLinearVel(body, velocity.x(), velocity.y(), velocity.z());
        return body;
    }
};

INSTANTIATE_TEST_SUITE_P(Laws, StartInsideTest, contact_tests, contact_test_name);

// Once, the mesh held the probe from within, wherever the tool was: 450 N at 1 m.
TEST_P(StartInsideTest, InAMeshNothingOfItIsFeltUntilItWasLeft)
{
    const MeshShape closed = dented_mesh();
    MeshShape open = closed; // with a hole at the bottom
    const auto is_low = [&](const std::array<int, 3> &triangle) { return open.vertices[triangle[0]].z() < -0.09; };
    open.triangles.erase(std::remove_if(open.triangles.begin(), open.triangles.end(), is_low), open.triangles.end());
    const Vector3 deep(0.01, 0.005, -0.1);
    const Vector3 at_surface(0, 0, 0.7 * radius); // the centre of the sphere is outside
    const Vector3 in_surface(0, 0, -0.5 * radius);
    const std::pair<MeshShape, Vector3> starts[] = {
        {closed, deep}, {open, deep}, {closed, at_surface}, {closed, in_surface}};
    for (const auto &[shape, start] : starts)
    {
        const OdeMesh mesh(shape);
        const dGeomID geom = mesh.add_to(world_.space);
        dGeomSetPosition(geom, 0, 0, -0.1);
        expect_felt_only_after_it_was_left(start);
        dGeomDestroy(geom);
    }
}

TEST_P(StartInsideTest, InASolidNothingOfItIsFeltUntilItWasLeft)
{
    for (const double z : {-0.05, -0.5 * radius, 0.5 * radius})
    {
        for (const bool is_box : {true, false})
        {
            const dGeomID solid =
                is_box ? world_.add_box({0.2, 0.2, 0.1}, {0, 0, -0.05}) : dCreateSphere(world_.space, 0.1);
            if (!is_box)
                dGeomSetPosition(solid, 0, 0, -0.1);
            expect_felt_only_after_it_was_left({0.01, 0.01, z});
            dGeomDestroy(solid);
        }
    }
}

TEST_P(StartInsideTest, BelowAPlaneNothingOfItIsFeltUntilItWasLeft)
{
    dCreatePlane(world_.space, 0, 0, 1, 0);
    expect_felt_only_after_it_was_left({0.01, 0.005, -0.3});
}

TEST_P(StartInsideTest, InWhatOnlyOdeKnowsNothingOfItIsFeltUntilItWasLeft)
{
    const ConvexCube cube(0.1);
    dGeomSetPosition(cube.add_to(world_.space), 0, 0, -0.1);
    expect_felt_only_after_it_was_left({0.01, 0.005, -0.02});
}

TEST_P(StartInsideTest, BelowAHeightfieldNothingOfItIsFeltUntilItWasLeft)
{
    HeightfieldSamples samples;
    samples.width = samples.depth = 1;
    samples.width_samples = samples.depth_samples = 11;
    samples.heights.assign(121, 0);
    const OdeField field(samples, 0.5);
    field.add_upright(world_.space);
    prepare_ = [&](HapticProbe &probe) { probe.sensor()->set_samples(field.data(), samples); };
    expect_felt_only_after_it_was_left({0.01, 0.005, -0.1});
}

TEST_P(StartInsideTest, AllElseIsFelt)
{
    const OdeMesh mesh(dented_mesh());
    mesh.add_to(world_.space);
    world_.add_box({1, 1, 0.1}, {0, 0, -0.05}); // half of the mesh is in it
    const Vector3 start(0, 0, 0.03), end(0, 0, radius - 0.002);
    const Samples samples = run([&](double t) { return between(start, end, 0.2, 0.3, t); }, 0.7);
    expect_force_at_end(samples, Vector3(0, 0, k * 0.002), 1e-6);
}

TEST_P(StartInsideTest, WhatMovesOntoTheProbeLaterPushes)
{
    const OdeMesh mesh(dented_mesh());
    mesh.add_to(world_.space);
    // At 0.6 s the box is 2 mm deep in the probe, which is inside the mesh.
    add_kinematic_box({0.1, 0.1, 0.1}, {0.05 + radius - 0.002 + 0.12, 0, 0}, {-0.2, 0, 0});
    const Samples samples = run([](double) { return Vector3(0, 0, 0); }, 0.601);
    expect_force_at_end(samples, Vector3(-k * 0.002, 0, 0), 0.1 * k * 0.002);
}

TEST_P(StartInsideTest, WhatMovesAwayAndBackPushes)
{
    const dBodyID box = add_kinematic_box({0.1, 0.1, 0.1}, {0, 0, 0}, {0, 0, -0.37});
    const Samples samples = run([](double) { return Vector3(0, 0, 0); }, 0.8,
                                Once(clock_, 0.4, [&] { dBodySetLinearVel(box, 0, 0, 0.3); }));
    expect_no_force(samples, 0, 0.6);
    const double depth = radius + 0.05 + dBodyGetPosition(box)[2];
    expect_force_at_end(samples, Vector3(0, 0, k * depth), 0.1 * k * depth);
}

// At 50 m/s and 1 kHz the front moves from 20 mm before the probe to 30 mm behind it.
TEST_P(StartInsideTest, WhatIsFasterThanTheProbeIsWidePushes)
{
    add_kinematic_box({0.4, 0.4, 0.4}, {0.2 + 0.03 + 0.5, 0, 0}, {-50, 0, 0});
    const Samples samples = run([](double) { return Vector3(0, 0, 0); }, 0.0125);
    EXPECT_LT(samples.back().requested.x(), -1);
}

TEST_P(StartInsideTest, AJumpIntoSomethingIsAStart)
{
    const OdeMesh mesh(dented_mesh());
    dGeomSetPosition(mesh.add_to(world_.space), 0, 0, -0.1);
    world_.add_box({0.2, 0.2, 0.1}, {0.2, 0, -0.05}); // below the place from which the tool jumps
    silent_from_ = 0.15;
    silent_until_ = 0.8;
    const auto path = out_and_back({0.01, 0.005, -0.1});
    const Samples samples =
        run([&](double t) { return t < 0.3 ? Vector3(0.2, 0, 0.05) : path(std::max(0.3, t - 0.6)); }, 2.8);
    expect_force_at_end_only(samples, 0, 2.1);
}

TEST_P(StartInsideTest, AMeshOrASolidThatIsMadeAroundTheProbeIsAStart)
{
    const OdeMesh mesh(dented_mesh());
    for (const bool is_mesh : {true, false})
    {
        dGeomID geom = nullptr;
        const Samples samples = run(out_and_back({0.01, 0.005, -0.1}), 2.2, Once(clock_, 0.2, [&] {
                                        geom = is_mesh ? mesh.add_to(world_.space) : dCreateSphere(world_.space, 0.1);
                                        dGeomSetPosition(geom, 0, 0, -0.1);
                                    }));
        expect_force_at_end_only(samples);
        dGeomDestroy(geom);
    }
}

TEST_P(StartInsideTest, AMeshOrASolidThatIsPutOntoTheProbeIsAStart)
{
    const OdeMesh mesh(dented_mesh());
    for (const bool is_mesh : {true, false})
    {
        const dGeomID geom = is_mesh ? mesh.add_to(world_.space) : dCreateSphere(world_.space, 0.1);
        dGeomSetPosition(geom, 0, 0, -0.22); // at first, the probe touches it from above
        const auto path = out_and_back({0.01, 0.005, -0.1 - radius - 0.002});
        const Samples samples = run(
            [&](double t) {
                return t < 0.3 ? between({0.01, 0.005, -0.06}, path(0), 0.05, 0.1, t) : path(t);
            },
            2.2, Once(clock_, 0.2, [&] { dGeomSetPosition(geom, 0, 0, -0.1); }));
        expect_force_at_end_only(samples, 0.25, 1.5);
        dGeomDestroy(geom);
    }
}

TEST_P(StartInsideTest, AProbeThatIsEnabledInsideIsAStart)
{
    const OdeMesh mesh(dented_mesh());
    dGeomSetPosition(mesh.add_to(world_.space), 0, 0, -0.1);
    const auto path = out_and_back({0.01, 0.005, -0.1});
    prepare_ = [](HapticProbe &probe) { dGeomDisable(probe.geom()); };
    const Samples samples = run([&](double t) { return t < 0.3 ? between(far_away, path(0), 0, 0.15, t) : path(t); },
                                2.2, Once(clock_, 0.2, [&] { dGeomEnable(probe_->geom()); }));
    expect_force_at_end_only(samples);
}

TEST_P(StartInsideTest, ARoomHoldsFromWithin)
{
    const OdeMesh room(box_mesh(Vector3::Constant(0.1), Vector3::Constant(-0.1))); // its triangles face inwards
    room.add_to(world_.space);
    const Samples samples = run([](double t) { return between({0, 0, 0}, {0, 0, -0.092}, 0.1, 0.3, t); }, 0.6);
    expect_force_at_end(samples, Vector3(0, 0, k * 0.002), 1e-6);
}

/// The vessel is one layer of triangles that face outwards. In its middle none is near the probe, so a space that tests shapes
/// would report it no longer, and the probe would forget from which side it came.
TEST_P(StartInsideTest, AVesselThatIsEnteredThroughItsMouthHoldsFromWithin)
{
    dPredictiveSpaceSetProximity(world_.space, dPredictiveProximityBox);
    MeshShape shape = box_mesh({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
    shape.triangles.erase(shape.triangles.begin(), shape.triangles.begin() + 2); // its top
    const OdeMesh vessel(shape);
    vessel.add_to(world_.space);
    const Samples samples = run([](double t) { return between({0, 0, 0.2}, {0, 0, -0.092}, 0.1, 0.3, t); }, 0.6);
    expect_force_at_end(samples, Vector3(0, 0, k * 0.002), 1e-6);
}
} // namespace
} // namespace ode_predictive_space::haptics
