// A sphere is pressed deep into thin, sharp, fast and moving objects, and is held: both laws, both loops.

#include "tests/haptics/contact/contact_fixture.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
class HeldContactTest : public ContactTest
{
protected:
    /// Presses the probe 5 radii deep into a surface whose highest point is at z = 0, and draws it out again.
    void expect_spring_to_five_radii(double x, double y, double tolerance)
    {
        const Vector3 above(x, y, 0.03), below(x, y, radius - 5 * radius);
        const auto samples = run(
            [&](double t) { return t < 1 ? between(above, below, 0.1, 0.8, t) : between(below, above, 1.1, 0.8, t); },
            2);
        double deepest = 0;
        for (const Sample &sample : samples)
        {
            const double depth = std::max(0.0, radius - sample.tool.z());
            deepest = std::max(deepest, depth);
            ASSERT_LE((sample.requested - Vector3(0, 0, k * depth)).norm(), tolerance * k * depth + 1e-9)
                << sample.time << ": " << sample.requested.transpose() << " at " << sample.tool.transpose();
        }
        EXPECT_NEAR(deepest, 5 * radius, 1e-9);
    }

    /// The tool rests, then flies at 10 m/s along x through an object whose front is at x = 0.
    void expect_stopped_at_front()
    {
        const auto samples = run([](double t) { return between({-0.034, 0, 0}, {0.036, 0, 0}, 0.1, 0.007, t); }, 0.15);
        for (const Sample &sample : samples)
        {
            const double depth = std::max(0.0, sample.tool.x() + radius);
            ASSERT_LE((sample.requested - Vector3(-k * depth, 0, 0)).norm(), 1e-6 * k)
                << sample.time << ": " << sample.requested.transpose() << " at " << sample.tool.transpose();
            if (proxy_law())
            {
                ASSERT_LE(sample.proxy.x(), -radius + 1e-9) << sample.time;
            }
        }
        EXPECT_NEAR(samples.back().tool.x(), 0.036, 1e-12);
    }
};

TEST_P(HeldContactTest, ASphereMeshHoldsToFiveRadii)
{
    const OdeMesh mesh(sphere_mesh(0.3, 96));
    dGeomSetPosition(mesh.add_to(world_.space), 0, 0, -0.3);
    expect_spring_to_five_radii(0, 0, 0.01);
}

TEST_P(HeldContactTest, AThinBoxHoldsToFiveRadii)
{
    world_.add_box({0.4, 0.4, 0.001}, {0, 0, -0.0005});
    expect_spring_to_five_radii(0.013, 0.021, 1e-6);
}

TEST_P(HeldContactTest, ARoofOfThirtyDegreesIsCrossedWithoutAJump)
{
    const OdeMesh mesh(roof_mesh(30));
    mesh.add_to(world_.space);
    const double height = 0.005; // the force is 2.5 N at the ridge
    const auto samples = run(
        [&](double t) {
            return t < 0.5 ? between({-0.004, 0, 0.03}, {-0.004, 0, height}, 0.1, 0.3, t)
                           : between({-0.004, 0, height}, {0.004, 0, height}, 0.5, 0.4, t);
        },
        1);
    const Vector3 slope = Vector3(0.5, 0, std::sqrt(0.75));
    Vector3 before = Vector3::Zero();
    for (const Sample &sample : samples)
    {
        // Within 30 degrees of the vertical through the ridge, the ridge is nearest; otherwise a slope is.
        Vector3 normal(0, 0, 1);
        const Vector3 tool(sample.tool.x(), 0, sample.tool.z());
        double distance = tool.norm();
        normal = tool.normalized();
        if (std::abs(tool.x()) > tool.z() * std::tan(std::acos(-1.0) / 6))
        {
            normal = slope.cwiseProduct(Vector3(tool.x() < 0 ? -1 : 1, 1, 1));
            distance = normal.dot(tool);
        }
        const Vector3 truth = k * std::max(0.0, radius - distance) * normal;
        ASSERT_LE((sample.requested - truth).norm(), 0.01 * 2.5) << sample.time << ": " << sample.requested.transpose();
        ASSERT_LE((sample.requested - before).norm(), 0.06) << sample.time; // at most 0.1 mm of motion, 500 N/m
        before = sample.requested;
    }
    EXPECT_NEAR(before.z(), 2.5, 1);
}

TEST_P(HeldContactTest, AThinDiscStopsWhatFliesAtTenMetresPerSecond)
{
    const dGeomID disc = dCreateCylinder(world_.space, 0.2, 0.001);
    dMatrix3 standing;
    dRFromAxisAndAngle(standing, 0, 1, 0, std::acos(0.0));
    dGeomSetRotation(disc, standing);
    dGeomSetPosition(disc, 0.0005, 0, 0);
    expect_stopped_at_front();
}

TEST_P(HeldContactTest, AWireCannotBePassedAtTenMetresPerSecond)
{
    dGeomSetPosition(dCreateCapsule(world_.space, 0.0005, 0.4), 0.0005, 0, 0);
    expect_stopped_at_front();
}

TEST_P(HeldContactTest, AThinMeshStopsWhatFliesAtTenMetresPerSecond)
{
    const OdeMesh mesh(box_mesh({0, -0.2, -0.2}, {0.001, 0.2, 0.2}));
    mesh.add_to(world_.space);
    expect_stopped_at_front();
}

TEST(HeldContact, HoldsInAnySpaceAndInASpaceWithinIt)
{
    const OdeUse ode;
    for (const SpaceChoice choice : all_space_choices)
    {
        for (const bool nested : {false, true})
        {
            ProbeWorld world(choice);
            const OdeMesh mesh(sheet_mesh(0.4, 8));
            mesh.add_to(nested ? make_space(choice, world.space) : world.space);
            ScriptedDevice device([](double t) {
                return between({0.01, 0.02, 0.03}, {0.01, 0.02, -4 * radius}, 0.1, 0.5, t);
            });
            HapticProbe probe(device, world.space, radius, RenderSettings());
            world.run(probe, 700);
            EXPECT_NEAR(probe.last_tick().requested.z(), 5 * radius * 500, 1e-9)
                << static_cast<int>(choice) << ' ' << nested;
        }
    }
}

/// A sheet of 1 cm cells with triangles that are flipped, doubled or without area.
TEST_P(HeldContactTest, AnUntidySheetIsAsFlatAsATidyOne)
{
    MeshShape shape = sheet_mesh(0.2, 20);
    const std::size_t count = shape.triangles.size();
    for (std::size_t i = 0; i < count; ++i)
    {
        auto triangle = shape.triangles[i];
        if (i % 3 == 0)
            std::swap(triangle[0], triangle[1]);
        shape.triangles[i] = triangle;
        if (i % 5 == 0)
            shape.triangles.push_back(triangle);
        if (i % 7 == 0)
        {
            shape.triangles.push_back({triangle[0], triangle[0], triangle[1]});
            shape.triangles.push_back({triangle[2], triangle[2], triangle[2]});
        }
    }
    const OdeMesh mesh(shape);
    mesh.add_to(world_.space);
    const auto samples = run(
        [](double t) {
            return t < 0.5 ? between({-0.05, -0.03, 0.03}, {-0.05, -0.03, -0.02}, 0.1, 0.3, t)
                           : between({-0.05, -0.03, -0.02}, {0.05, 0.04, -0.02}, 0.5, 1, t);
        },
        1.6);
    for (const Sample &sample : samples)
    {
        const double depth = std::max(0.0, radius - sample.tool.z());
        ASSERT_LE((sample.requested - Vector3(0, 0, k * depth)).norm(), 1e-3 * k * depth + 1e-9)
            << sample.time << ": " << sample.requested.transpose() << " at " << sample.tool.transpose();
    }
}

TEST_P(HeldContactTest, AHoleThatIsTooSmallCarriesTheProbeByItsRim)
{
    MeshShape shape = sheet_mesh(0.2, 20);
    const auto first = shape.triangles.begin() + 2 * (10 * 20 + 10); // of the cell between 0 and 1 cm
    shape.triangles.erase(first, first + 2);
    const OdeMesh mesh(shape);
    mesh.add_to(world_.space);
    const Vector3 middle(0.005, 0.005, 0);
    const double resting = std::sqrt(radius * radius - 0.005 * 0.005); // the height at which it lies on the four edges
    const auto samples = run(
        [&](double t) { return between(middle + Vector3(0, 0, 0.03), middle - Vector3(0, 0, 0.02), 0.1, 0.8, t); }, 1);
    if (proxy_law())
    {
        expect_force_at_end(samples, Vector3(0, 0, k * (resting + 0.02)), 0.01 * k * (resting + 0.02));
    }
    EXPECT_GT(samples.back().requested.z(), 0.9 * k * (resting + 0.02)) << "it never falls through";
}

INSTANTIATE_TEST_SUITE_P(Laws, HeldContactTest, contact_tests, contact_test_name);

/// A sheet comes from below, accelerates, and carries the proxy off the resting tool by several radii per tick.
TEST(CarriedProxy, StaysOnAThinSheetThatMovesByMoreThanTheProbesSizeInATick)
{
    constexpr double size = 0.003; // m; radius of the probe
    const OdeUse ode;
    ProbeWorld world;
    const OdeMesh mesh(sheet_mesh(0.4, 8));
    const dBodyID body = world.add_body(Vector3(0, 0, -0.02), 1);
    dBodySetKinematic(body);
    dGeomSetBody(mesh.add_to(world.space), body);
    dWorldSetGravity(world.world, 0, 0, 0);
    ScriptedDevice device([](double) { return Vector3(0.01, 0.02, 0); });
    HapticProbe probe(device, world.space, size, with_law(std::make_shared<ProxyLaw>(Material{10})));
    probe.sensor()->prepare_all();
    int carried = 0;
    for (int tick = 0; tick < 80; ++tick)
    {
        const double speed = std::min(22.0, 0.5 * tick); // m/s
        dBodySetLinearVel(body, 0, 0, speed);
        const double height = dBodyGetPosition(body)[2]; // m; at the tick
        world.run(probe, 1);
        const double depth = std::max(0.0, height + size);
        ASSERT_NEAR(probe.last_tick().requested.z(), 10 * depth, 0.02 * 10 * depth + 1e-9)
            << tick << " at " << speed << " m/s";
        carried += depth > 0 && speed > 20 ? 1 : 0;
    }
    EXPECT_GT(carried, 10);
}
} // namespace
} // namespace ode_predictive_space::haptics
