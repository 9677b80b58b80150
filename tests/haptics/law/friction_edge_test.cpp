// Friction on surfaces that bend: over the ridge of a roof and off the edge of a box. Both laws, both kinds of loops.

#include "tests/haptics/contact/contact_fixture.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double mu = 0.5;
constexpr double speed = 0.1; // m/s

class FrictionEdgeTest : public ContactTest
{
protected:
    FrictionEdgeTest()
    {
        friction_ = mu;
        physics_rate_ = 100;
    }

    std::vector<Sample> cross(double height)
    {
        constexpr double away = 0.02; // m
        const Vector3 above(-away, 0, 0.03), in(-away, 0, height), beyond(away, 0, height);
        return run(
            [=](double t) {
                return t < 0.5 ? between(above, in, 0.1, 0.3, t)
                               : (t < 1 ? between(in, beyond, 0.5, 2 * away / speed, t)
                                        : between(beyond, in, 1, 2 * away / speed, t));
            },
            1.6);
    }

    /// Expects a tangential force of at most mu times the normal one. @param normal of the surface nearest to a point.
    void expect_cone(const std::vector<Sample> &samples, const std::function<Vector3(const Vector3 &)> &normal) const
    {
        int sliding = 0;
        for (const Sample &sample : samples)
        {
            if (sample.requested.isZero(0))
                continue;
            const Vector3 n = normal(proxy_law() ? sample.proxy : sample.tool);
            const double pressing = sample.requested.dot(n);
            const double along = (sample.requested - pressing * n).norm();
            ASSERT_GT(pressing, 0) << sample.time;
            ASSERT_LE(along, 1.001 * mu * pressing + 1e-6) << sample.time << ": " << sample.requested.transpose();
            sliding += along > 0.9 * mu * pressing ? 1 : 0;
        }
        EXPECT_GT(sliding, static_cast<int>(samples.size()) / 4);
    }

    void expect_no_jump(const std::vector<Sample> &samples) const
    {
        const double spring = k * speed * (decoupled() ? 1.0 / 4000 : 1.0 / 1000); // N; for the hand's travel in a tick
        for (std::size_t i = 1; i < samples.size(); ++i)
            if (samples[i].time > 0.45)
            {
                ASSERT_LE((samples[i].requested - samples[i - 1].requested).norm(), 2 * spring) << samples[i].time;
            }
    }
};

INSTANTIATE_TEST_SUITE_P(Laws, FrictionEdgeTest, contact_tests, contact_test_name);

TEST_P(FrictionEdgeTest, OverTheRidgeOfARoofTheForceStaysInTheConeAndDoesNotJump)
{
    const double angle = 15 * std::acos(-1.0) / 180;
    const OdeMesh mesh(roof_mesh(15));
    mesh.add_to(world_.space);
    const auto samples = cross(0.004);
    expect_cone(samples, [&](const Vector3 &place) -> Vector3 {
        const double turned = std::clamp(std::atan2(place.x(), place.z()), -angle, angle);
        return {std::sin(turned), 0, std::cos(turned)};
    });
    expect_no_jump(samples);
}

TEST_P(FrictionEdgeTest, OffTheEdgeOfABoxTheForceStaysInTheConeAndDoesNotJump)
{
    world_.add_box({0.2, 0.4, 0.2}, {-0.1, 0, -0.1});
    const auto samples = cross(0.007);
    expect_cone(samples, [&](const Vector3 &place) -> Vector3 {
        return place.x() <= 0 ? Vector3(0, 0, 1) : Vector3(place.x(), 0, place.z()).normalized();
    });
    expect_no_jump(samples);
}
} // namespace
} // namespace ode_predictive_space::haptics
