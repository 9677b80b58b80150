// The end of a contact, and contacts with several planes of one object.

#include "tests/haptics/contact/contact_fixture.h"

#include <algorithm>

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

    const OdeMesh mesh_{sheet_mesh(0.4, 8)};
    dGeomID geom_ = mesh_.add_to(world_.space);
};

TEST_P(ContactEndTest, DestroyedGeomsAreLetGo)
{
    expect_end_by([&] { dGeomDestroy(geom_); });
}

TEST_P(ContactEndTest, DisabledGeomsAreLetGo)
{
    expect_end_by([&] { dGeomDisable(geom_); });
}

TEST_P(ContactEndTest, GeomsThatAreFilteredOutAreLetGo)
{
    expect_end_by([&] {
        dGeomSetCategoryBits(geom_, 0);
        dGeomSetCollideBits(geom_, 0);
    });
}

TEST_P(ContactEndTest, GeomsThatAreTakenOutOfTheSpaceAreLetGo)
{
    expect_end_by([&] { dSpaceRemove(world_.space, geom_); });
    dGeomDestroy(geom_);
}

TEST_P(ContactEndTest, GeomsThatArePutFarAwayAreLetGo)
{
    expect_end_by([&] { dGeomSetPosition(geom_, 0, 0, 5); });
}

TEST_P(ContactEndTest, AMeshWithOtherDataIsLetGo)
{
    MeshShape shape = sheet_mesh(0.4, 8);
    for (Vector3 &vertex : shape.vertices)
        vertex.z() -= 0.08;
    const OdeMesh other(shape);
    expect_end_by([&] { dGeomTriMeshSetData(geom_, other.data()); });
    dGeomDestroy(geom_);
}

TEST_P(ContactEndTest, AMeshWhoseDataIsBuiltAnewIsLetGo)
{
    MeshShape shape = sheet_mesh(0.4, 8);
    for (Vector3 &vertex : shape.vertices)
        vertex.z() -= 0.08;
    OdeMesh mesh(sheet_mesh(0.4, 8));
    dGeomDestroy(geom_);
    geom_ = mesh.add_to(world_.space);
    expect_end_by([&] {
        mesh.set(shape);
        dGeomTriMeshSetData(geom_, mesh.data());
    });
    dGeomDestroy(geom_);
}

INSTANTIATE_TEST_SUITE_P(Laws, ContactEndTest, contact_tests, contact_test_name);

class SeveralPlanesTest : public ContactTest
{
protected:
    using Samples = std::vector<Sample>;

    void expect_equal(const Samples &one, const Samples &other, double tolerance) const
    {
        const std::size_t count = std::min(one.size(), other.size());
        ASSERT_NEAR(static_cast<double>(one.size()), static_cast<double>(other.size()), 1) << "where they end";
        double most = 0;
        for (std::size_t i = 0; i < count; ++i)
        {
            most = std::max(most, one[i].requested.norm());
            ASSERT_LE((one[i].requested - other[i].requested).norm(), tolerance)
                << one[i].time << " at " << one[i].tool.transpose() << ": " << one[i].requested.transpose() << " and "
                << other[i].requested.transpose();
        }
        EXPECT_GT(most, 1);
    }
};

MeshShape corner_mesh()
{
    MeshShape shape;
    shape.add_quad({0, -0.2, 0}, {0.4, -0.2, 0}, {0.4, 0.2, 0}, {0, 0.2, 0});
    shape.add_quad({0, -0.2, 0}, {0, 0.2, 0}, {0, 0.2, 0.4}, {0, -0.2, 0.4});
    return shape;
}

Vector3 into_the_corner(double t)
{
    const Vector3 above(0.03, 0, 0.03), floor(0.03, 0, radius - 0.004), corner(radius - 0.0041, 0, radius - 0.004);
    const Vector3 along = corner + Vector3(0, 0.05, 0);
    return t < 0.4 ? between(above, floor, 0.1, 0.2, t)
                   : (t < 0.8 ? between(floor, corner, 0.4, 0.3, t) : between(corner, along, 0.8, 0.3, t));
}

TEST_P(SeveralPlanesTest, AMeshCornerFeelsLikeTwoBoxes)
{
    Samples of_mesh;
    {
        const OdeMesh mesh(corner_mesh());
        const dGeomID geom = mesh.add_to(world_.space);
        of_mesh = run(&into_the_corner, 1.2);
        dGeomDestroy(geom);
    }
    world_.add_box({0.4, 0.4, 0.2}, {0.2, 0, -0.1});
    world_.add_box({0.2, 0.4, 0.4}, {-0.1, 0, 0.2});
    clock_.advance(1);
    const Samples of_boxes = run(&into_the_corner, 1.2);
    expect_equal(of_mesh, of_boxes, 1e-6);
    expect_force_at_end(of_mesh, Vector3(2.05, 0, 2), 1e-6);
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
    const Samples samples = run(&into_the_corner, 1.2);
    expect_force_at_end(samples, Vector3(2.05, 0, 2), 1e-6);
    Vector3 before = Vector3::Zero();
    for (const Sample &sample : samples)
    {
        ASSERT_LE((sample.requested - before).norm(), 0.2) << sample.time;
        before = sample.requested;
    }
}

INSTANTIATE_TEST_SUITE_P(Laws, SeveralPlanesTest, contact_tests, contact_test_name);
} // namespace
} // namespace ode_predictive_space::haptics
