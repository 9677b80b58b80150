// Objects that lie in one plane are one floor to the proxy law.

#include "tests/haptics/contact/contact_fixture.h"

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double depth_on_tiles = 0.005; // m

class FlushTest : public ContactTest
{};

INSTANTIATE_TEST_SUITE_P(Laws, FlushTest, testing::Combine(testing::Values(true), testing::Bool()), contact_test_name);

TEST_P(FlushTest, OverTheSeamFrictionGoesOn)
{
    friction_ = 0.4;
    world_.add_box({0.1, 0.2, 0.1}, {-0.05, 0, -0.05});
    world_.add_box({0.1, 0.2, 0.1}, {0.05, 0, -0.05});
    const double height = radius - depth_on_tiles;
    const Vector3 above(-0.03, 0, 0.03), in(-0.03, 0, height), beyond(0.03, 0, height);
    const auto samples = run(
        [=](double t) { return t < 0.5 ? between(above, in, 0.1, 0.3, t) : between(in, beyond, 0.5, 0.6, t); }, 1.2);
    for (const Sample &sample : samples)
    {
        if (sample.time > 0.6 && sample.time < 1.1)
        {
            ASSERT_NEAR(sample.requested.z(), k * depth_on_tiles, 0.01) << sample.time;
            ASSERT_NEAR(sample.requested.x(), -0.4 * k * depth_on_tiles, 0.01) << sample.time;
        }
    }
}

TEST_P(FlushTest, ATableOfSixteenTilesIsOne)
{
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 4; ++y)
            world_.add_box({0.02, 0.02, 0.05}, {0.02 * x - 0.03, 0.02 * y - 0.03, -0.025});
    const double height = radius - depth_on_tiles;
    const auto samples = run(
        [=](double t) {
            const double turn = 8 * (t - 0.5);
            const Vector3 in(0.015, 0, height);
            return t < 0.5 ? between(in + Vector3(0, 0, 0.02), in, 0.1, 0.3, t)
                           : Vector3(0.015 * std::cos(turn), 0.015 * std::sin(turn), height);
        },
        1.3);
    for (const Sample &sample : samples)
    {
        if (sample.time > 0.45)
        {
            ASSERT_LE((sample.requested - Vector3(0, 0, k * depth_on_tiles)).norm(), 0.01)
                << sample.time << ": " << sample.requested.transpose() << " at " << sample.tool.transpose();
        }
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
