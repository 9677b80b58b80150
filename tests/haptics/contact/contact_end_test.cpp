// The end of a contact, contacts with several planes of one object, and with several objects in one plane.

#include "tests/haptics/contact/contact_fixture.h"

namespace ode_predictive_space::haptics
{
namespace
{
class ContactEndTest : public ContactTest
{
protected:
    static constexpr double middle = 1; // s

    /// The hand presses 4 radii deep into a sheet at z = 0. After `event`, in the middle of the run, the force is zero.
    void expect_end_by(const std::function<void()> &event)
    {
        const auto samples = run(
            [](double t) {
                return between({0.01, 0.02, 0.03}, {0.01, 0.02, -3 * radius}, 0.1, 0.5, t);
            },
            2, Once(clock_, middle, event));
        expect_no_force(samples, middle + 0.0036, infinity);
        for (const Sample &sample : samples)
        {
            if (sample.time > 0.7 && sample.time < middle - 0.001)
            {
                ASSERT_NEAR(sample.requested.z(), 4 * radius * k, 1e-9) << sample.time;
            }
        }
    }

    OdeMesh mesh_{sheet_mesh(0.4, 8)};
    dGeomID geom_ = mesh_.add_to(world_.space);
};

TEST_P(ContactEndTest, DestroyedGeomsAreLetGo)
{
    expect_end_by([&] { dGeomDestroy(geom_); });
}

TEST_P(ContactEndTest, GeomsThatAreFilteredOutAreLetGo)
{
    expect_end_by([&] {
        dGeomSetCategoryBits(geom_, 0);
        dGeomSetCollideBits(geom_, 0);
    });
}

TEST_P(ContactEndTest, GeomsThatArePutFarAwayAreLetGo)
{
    expect_end_by([&] { dGeomSetPosition(geom_, 0, 0, 5); });
}

TEST_P(ContactEndTest, AMeshWhoseDataIsBuiltAnewIsLetGo)
{
    MeshShape shape = sheet_mesh(0.4, 8);
    for (Vector3 &vertex : shape.vertices)
        vertex.z() -= 0.08;
    expect_end_by([&] {
        mesh_.set(shape);
        dGeomTriMeshSetData(geom_, mesh_.data());
    });
}

INSTANTIATE_TEST_SUITE_P(Laws, ContactEndTest, contact_tests, contact_test_name);

class SeveralPlanesTest : public ContactTest
{};

Vector3 into_the_corner(double t)
{
    const Vector3 above(0.03, 0, 0.03), floor(0.03, 0, radius - 0.004), corner(radius - 0.0041, 0, radius - 0.004);
    const Vector3 along = corner + Vector3(0, 0.05, 0);
    return t < 0.4 ? between(above, floor, 0.1, 0.2, t)
                   : (t < 0.8 ? between(floor, corner, 0.4, 0.3, t) : between(corner, along, 0.8, 0.3, t));
}

TEST_P(SeveralPlanesTest, ACornerOfAMeshIsFeltAsItsTwoPlanes)
{
    MeshShape shape;
    shape.add_quad({0, -0.2, 0}, {0.4, -0.2, 0}, {0.4, 0.2, 0}, {0, 0.2, 0});
    shape.add_quad({0, -0.2, 0}, {0, 0.2, 0}, {0, 0.2, 0.4}, {0, -0.2, 0.4});
    const OdeMesh mesh(shape);
    mesh.add_to(world_.space);
    const auto samples = run(&into_the_corner, 1.2);
    for (const Sample &sample : samples)
    {
        const Vector3 depths = (Vector3::Constant(radius) - sample.tool).cwiseMax(0.0);
        ASSERT_LE((sample.requested - k * Vector3(depths.x(), 0, depths.z())).norm(), 1e-6)
            << sample.time << ": " << sample.requested.transpose() << " at " << sample.tool.transpose();
    }
    expect_force_at_end(samples, Vector3(2.05, 0, 2), 1e-6);
}

TEST_P(SeveralPlanesTest, AWallOfOneBodyDoesNotTakeTheFloorAway)
{
    const dBodyID body = world_.add_body({0, 0, 0}, 1e9);
    dBodySetKinematic(body);
    const dGeomID floor = world_.add_box({0.4, 0.4, 0.2}, {0, 0, 0});
    const dGeomID wall = world_.add_box({0.2, 0.4, 0.4}, {0, 0, 0});
    dGeomSetBody(floor, body);
    dGeomSetOffsetPosition(floor, 0.2, 0, -0.1);
    dGeomSetBody(wall, body);
    dGeomSetOffsetPosition(wall, -0.1, 0, 0.2);
    const auto samples = run(&into_the_corner, 1.2);
    expect_force_at_end(samples, Vector3(2.05, 0, 2), 1e-6);
    Vector3 before = Vector3::Zero();
    for (const Sample &sample : samples)
    {
        ASSERT_LE((sample.requested - before).norm(), 0.2) << sample.time;
        before = sample.requested;
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, SeveralPlanesTest, contact_tests, contact_test_name);

/// Objects that lie in one plane are one floor to the proxy law.
class FlushTest : public ContactTest
{};

INSTANTIATE_TEST_SUITE_P(Laws, FlushTest, testing::Combine(testing::Values(true), testing::Bool()), contact_test_name);

TEST_P(FlushTest, OverTheSeamFrictionGoesOn)
{
    constexpr double depth = 0.005; // m
    friction_ = 0.4;
    world_.add_box({0.1, 0.2, 0.1}, {-0.05, 0, -0.05});
    world_.add_box({0.1, 0.2, 0.1}, {0.05, 0, -0.05});
    const double height = radius - depth;
    const Vector3 above(-0.03, 0, 0.03), in(-0.03, 0, height), beyond(0.03, 0, height);
    const auto samples = run(
        [=](double t) { return t < 0.5 ? between(above, in, 0.1, 0.3, t) : between(in, beyond, 0.5, 0.6, t); }, 1.2);
    for (const Sample &sample : samples)
    {
        if (sample.time > 0.6 && sample.time < 1.1)
        {
            ASSERT_NEAR(sample.requested.z(), k * depth, 0.01) << sample.time;
            ASSERT_NEAR(sample.requested.x(), -0.4 * k * depth, 0.01) << sample.time;
        }
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
