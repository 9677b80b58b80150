#include "ode_predictive_space/haptics/hand_path.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
HandPathSettings steady_hand()
{
    HandPathSettings settings;
    settings.tremor = 0;
    return settings;
}

// A minimum-jerk reach peaks at 1.875 times its length over its time: 0.1 m in 0.3 s up to 0.3 m in 0.8 s.
TEST(HandPath, ReachesAsFastAsPeopleDo)
{
    HandPath hand(steady_hand(), 5);
    double fastest = 0;
    int resting = 0; // ms
    for (double time = 0; time < 60; time += 0.001)
    {
        const double speed = hand.velocity(time).norm();
        fastest = std::max(fastest, speed);
        resting += speed == 0 ? 1 : 0;
    }
    EXPECT_GT(resting, 3000) << "with pauses";
    EXPECT_GE(fastest, 1.875 * 0.1 / 0.3);
    EXPECT_LE(fastest, 1.875 * 0.3 / 0.8 + 1e-9);
}

TEST(HandPath, StaysInItsWorkspace)
{
    HandPathSettings settings;
    settings.centre = {1, 2, 3};
    settings.scale = 12;
    HandPath hand(settings, 6);
    double farthest = 0;
    for (double time = 0; time < 60; time += 0.001)
    {
        const double distance = (hand.position(time) - settings.centre).cwiseAbs().maxCoeff();
        ASSERT_LE(distance, hand.half_extent()) << "at " << time << " s";
        farthest = std::max(farthest, distance);
    }
    EXPECT_GT(farthest, 0.8 * hand.half_extent()) << "and uses it";
}

TEST(HandPath, VelocityIsTheDerivativeOfThePosition)
{
    HandPathSettings settings;
    settings.scale = 3;
    HandPath hand(settings, 11);
    const double step = 1e-5;
    for (double time = 0.1; time < 20; time += 0.0137)
    {
        const Vector3 difference = (hand.position(time + step) - hand.position(time - step)) / (2 * step);
        ASSERT_LT((hand.velocity(time) - difference).norm(), 1e-5) << "at " << time << " s";
    }
}

TEST(HandPath, TremblesWithEightToTwelveHertz)
{
    const HandPathSettings settings;
    HandPath hand(settings, 8), steady(steady_hand(), 8);
    const double duration = 60;
    int crossings = 0;
    Vector3 largest = Vector3::Zero();
    double last = 0;
    for (double time = 0; time < duration; time += 0.0005)
    {
        const Vector3 tremor = hand.position(time) - steady.position(time);
        crossings += tremor.x() * last < 0 ? 1 : 0;
        largest = largest.cwiseMax(tremor.cwiseAbs());
        last = tremor.x();
    }
    EXPECT_LE(largest.maxCoeff(), settings.tremor * (1 + 1e-9));
    EXPECT_GT(largest.minCoeff(), 0.5 * settings.tremor) << "along each axis";
    EXPECT_GE(crossings / (2 * duration), 7.9);
    EXPECT_LE(crossings / (2 * duration), 12.1);
}

TEST(HandPath, SameSeedSamePathInWhateverOrderItIsAsked)
{
    HandPath forwards({}, 9);
    HandPath backwards({}, 9);
    HandPath other({}, 10);
    std::vector<Vector3> positions;
    for (int i = 0; i <= 1000; ++i)
        positions.push_back(forwards.position(0.01 * i));
    for (int i = 1000; i >= 0; --i)
        ASSERT_EQ(backwards.position(0.01 * i), positions[static_cast<std::size_t>(i)]);
    EXPECT_NE(other.position(5), positions[500]);
}

TEST(HandPathDevice, FollowsThePath)
{
    HandPathSettings settings;
    settings.scale = 0.5;
    settings.centre = {1, 0, 0};
    HandPathDevice device(settings, 3);
    HandPath path(settings, 3);
    EXPECT_EQ(device.capabilities().force_axes, 0);
    EXPECT_EQ(device.capabilities().max_force, 0);
    device.open();
    for (int i = 0; i < 20000; ++i)
    {
        const DeviceState state = device.read(0.001 * i);
        ASSERT_TRUE(device.capabilities().workspace.contains(state.position));
        ASSERT_EQ(state.position, path.position(0.001 * i));
        ASSERT_EQ(state.linear_velocity, path.velocity(0.001 * i));
        ASSERT_EQ(state.time, 0.001 * i);
        device.write({Vector3(0, 100, 0), Vector3::Zero()});
    }
    EXPECT_EQ(device.last_wrench().force, Vector3(0, 100, 0));
}
} // namespace
} // namespace ode_predictive_space::haptics
