#include "ode_predictive_space/prediction/step_estimate.h"

#include <limits>

#include <gtest/gtest.h>

using namespace ode_predictive_space;

namespace
{
const Vector3 velocity(3, -1, 2);

void add_steps(StepEstimate &estimate, double step, int count)
{
    for (int i = 1; i <= count; ++i)
        estimate.add(step * i * velocity, velocity, velocity, i);
}
} // namespace

TEST(StepEstimate, mean_velocity_counts_when_it_changes)
{
    StepEstimate estimate;
    estimate.add(Vector3(1.1, 0, 0), Vector3(100, 0, 0), Vector3(120, 0, 0), 10);
    EXPECT_DOUBLE_EQ(estimate.step(), 0.001);
}

TEST(StepEstimate, bounces_and_teleports_are_not_followed)
{
    StepEstimate estimate;
    add_steps(estimate, 0.001, 5);
    estimate.add(1e6 * velocity, velocity, velocity, 1);
    estimate.add(1e-9 * velocity, velocity, velocity, 1);
    EXPECT_NEAR(estimate.step(), 0.001, 1e-15);
}

TEST(StepEstimate, a_bad_first_sample_is_forgotten)
{
    StepEstimate estimate;
    estimate.add(1e6 * velocity, velocity, velocity, 1);
    add_steps(estimate, 0.001, 2);
    EXPECT_NEAR(estimate.step(), 0.001, 1e-15);
}

TEST(StepEstimate, follows_a_new_step_size)
{
    StepEstimate estimate;
    add_steps(estimate, 0.001, 50);
    add_steps(estimate, 0.005, 5);
    EXPECT_NEAR(estimate.step(), 0.005, 1e-15);
}

TEST(StepEstimate, what_says_nothing_is_passed_over)
{
    StepEstimate estimate;
    add_steps(estimate, 0.001, 1);
    for (int i = 0; i < 20; ++i)
    {
        estimate.add(Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), 1);
        estimate.add(velocity, velocity, -velocity, 1);
        estimate.add(velocity, velocity, 2 * velocity, 1);
        estimate.add(-velocity, velocity, velocity, 1);
        estimate.add(Vector3::Constant(std::numeric_limits<double>::quiet_NaN()), velocity, velocity, 1);
        estimate.add(Vector3::Constant(std::numeric_limits<double>::infinity()), velocity, velocity, 1);
    }
    EXPECT_DOUBLE_EQ(estimate.step(), 0.001);
}
