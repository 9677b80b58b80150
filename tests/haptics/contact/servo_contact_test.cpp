// Between two steps of a slow scene the servo renders the surface itself, not a plane. Both laws are tested.

#include "tests/haptics/contact/contact_fixture.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double servo_rate = 4000; // Hz

class ServoContactTest : public ContactTest
{
protected:
    ServoContactTest() { physics_rate_ = 100; }
};

INSTANTIATE_TEST_SUITE_P(Laws, ServoContactTest, testing::Combine(testing::Bool(), testing::Values(true)),
                         contact_test_name);

TEST_P(ServoContactTest, RidgesOfAHundredThousandTrianglesAreFeltBetweenTheStepsOfTheScene)
{
    const RidgeShape ridges;
    const MeshShape shape = ridge_mesh(ridges, 250, 200);
    ASSERT_EQ(shape.triangles.size(), 100000U);
    const OdeMesh mesh(shape);
    mesh.add_to(world_.space);
    const Vector3 above(-0.2, -0.05, 0.03), in(-0.2, -0.05, radius - 0.003), end(0.2, 0.05, radius - 0.003);
    const auto samples =
        run([=](double t) { return t < 0.5 ? between(above, in, 0.1, 0.3, t) : between(in, end, 0.5, 0.8, t); }, 1.3);
    expect_forces_of_ridges(samples, ridges, 0.8 * servo_rate);
    for (const Sample &sample : samples)
        if (sample.time > 0.6) // the law has met a ridge and a valley
        {
            ASSERT_EQ(sample.allocations, 0U) << sample.time;
        }
}

TEST_P(ServoContactTest, AMeshThatGetsOtherDataIsFeltAsItIsFromTheNextStepOn)
{
    MeshShape shape = sheet_mesh(0.4, 8);
    const OdeMesh upper(shape);
    for (Vector3 &vertex : shape.vertices)
        vertex.z() -= 0.03;
    const OdeMesh lower(shape);
    const dGeomID geom = upper.add_to(world_.space);
    const double step = 1 / physics_rate_;
    int steps = 0;
    const double pressed = 5e-5; // m; so little that the contact may begin at once
    const auto samples = run([&](double) { return Vector3(0.01, 0.02, radius - pressed); }, 1,
                             [&](double) {
                                 ++steps;
                                 dGeomTriMeshSetData(geom, steps % 4 < 2 ? upper.data() : lower.data());
                             });
    int touching = 0;
    for (const Sample &sample : samples)
    {
        const double since = std::fmod(sample.time + 1e-6, step);
        if (since < 2e-6)
            continue; // the tick coincides with a step
        const bool is_upper = static_cast<int>(sample.time / step) % 4 < 2;
        ASSERT_NEAR(sample.requested.z(), is_upper ? k * pressed : 0, 1e-9) << sample.time;
        touching += is_upper ? 1 : 0;
    }
    EXPECT_GT(touching, 0.4 * servo_rate);
}

TEST_P(ServoContactTest, APlateThatTurnsIsFeltWhereItIs)
{
    const dBodyID body = world_.add_body({0, 0, 0}, 1);
    dBodySetKinematic(body);
    dGeomSetBody(world_.add_box({0.6, 0.6, 0.001}, {0, 0, 0}), body);
    dBodySetFiniteRotationMode(body, 1);
    dBodySetAngularVel(body, 0, -1, 0); // the side of positive x rises
    const Vector3 place(0.1, 0.02, 0.012);
    const auto samples = run([&](double) { return place; }, 0.4);
    int compared = 0;
    for (const Sample &sample : samples)
    {
        const double angle = sample.time;
        const Vector3 normal(-std::sin(angle), 0, std::cos(angle));
        const double depth = radius - (normal.dot(place) - 0.0005);
        const Vector3 truth = k * std::max(0.0, depth) * normal;
        ASSERT_LE((sample.requested - truth).norm(), 0.01 * truth.norm() + 1e-6)
            << sample.time << ": " << sample.requested.transpose() << " and not " << truth.transpose();
        compared += depth > radius ? 1 : 0;
    }
    EXPECT_GT(compared, 0.1 * servo_rate);
}
} // namespace
} // namespace ode_predictive_space::haptics
