// Up to the stated capacity no touch is lost, in one thread and in two. A notice reports any excess.

#include "tests/haptics/contact/contact_fixture.h"

#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
class ManyTouchesTest : public ContactTest
{
protected:
    static constexpr double ball = 0.0005; // m

    void add_bed(int balls)
    {
        const double turn = M_PI * (3 - std::sqrt(5.0));
        for (int i = 0; i < balls; ++i)
        {
            const double height = 1 - 0.9 * (i + 0.5) / balls;
            const double across = std::sqrt(1 - height * height);
            const Vector3 out(across * std::cos(turn * i), across * std::sin(turn * i), -height);
            const dGeomID geom = dCreateSphere(world_.space, ball);
            const Vector3 at = (radius + ball) * out;
            dGeomSetPosition(geom, at.x(), at.y(), at.z());
            balls_.push_back(at);
        }
    }

    double sum_of_springs() const
    {
        double sum = 0;
        for (const Vector3 &at : balls_)
        {
            const Vector3 out = goal - at;
            sum += k * (radius + ball - out.norm()) * out.normalized().z();
        }
        return sum;
    }

    std::vector<Sample> press()
    {
        prepare_ = [this](HapticProbe &probe) { probe.renderer().set_notice_sink(notices_.sink()); };
        return run([this](double seconds) { return between({0, 0, 0.02}, goal, 0.2, 1, seconds); }, 1.5);
    }

    const Vector3 goal = {0, 0, -0.0002}; // m
    NoticeList notices_;
    std::vector<Vector3> balls_;
};

TEST_P(ManyTouchesTest, UpToTheCapacityAllAreFelt)
{
    add_bed(static_cast<int>(touch_capacity));
    const std::vector<Sample> samples = press();
    EXPECT_EQ(notices_.count(NoticeKind::contact), 0);
    const double expected = proxy_law() ? -k * goal.z() : sum_of_springs();
    EXPECT_NEAR(samples.back().requested.z(), expected, 0.001 * expected);
}

TEST_P(ManyTouchesTest, MoreThanTheCapacityIsToldAndAllocatesNothing)
{
    add_bed(static_cast<int>(touch_capacity) + 40);
    const std::vector<Sample> samples = press();
    EXPECT_EQ(notices_.count(NoticeKind::contact), 1);
    EXPECT_NE(notices_.text(NoticeKind::contact).find("256"), std::string::npos);
    EXPECT_GT(samples.back().requested.z(), 0);
    for (const Sample &sample : samples)
        EXPECT_TRUE(!decoupled() || sample.time < 0.1 || sample.allocations == 0) << sample.time;
}

INSTANTIATE_TEST_SUITE_P(Contact, ManyTouchesTest, contact_tests, contact_test_name);
} // namespace
} // namespace ode_predictive_space::haptics
