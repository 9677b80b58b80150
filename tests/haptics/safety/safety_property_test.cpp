#include "ode_predictive_space/haptics/safety.h"
#include "ode_predictive_space/haptics/safety/safety_stage.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/random_numbers.h"

namespace ode_predictive_space::haptics
{
namespace
{
double any_number(RandomNumbers &random)
{
    switch (random.below(12))
    {
    case 0:
        return nan;
    case 1:
        return random.one_in(2) ? infinity : -infinity;
    case 2:
        return random.between(-1, 1) * std::numeric_limits<double>::max();
    case 3:
        return random.between(-1, 1) * std::numeric_limits<double>::denorm_min();
    case 4:
        return std::ldexp(random.between(-1, 1), random.below(600) - 300);
    case 5:
        return 0;
    default:
        return random.between(-10, 10);
    }
}

Vector3 any_vector(RandomNumbers &random, bool wild)
{
    return wild ? Vector3(any_number(random), any_number(random), any_number(random)) : random.in_cube(10);
}

struct Expectation
{
    SafetyLimits limits;
    double allowance;
    double elapsed;

    void check(const Vector3 &last, const Vector3 &now, double most, double rate) const
    {
        ASSERT_TRUE(now.allFinite());
        ASSERT_LE(now.norm(), most * allowance);
        const double change = (now - last).norm();
        const bool slow = change <= rate * elapsed + 1e-12;
        // A faster change only shortens the wrench.
        const bool shorter = now.norm() <= last.norm() + 1e-12 && now.norm() <= most * allowance;
        ASSERT_TRUE(slow || shorter);
        ASSERT_LE(now.norm(), last.norm() + rate * elapsed + 1e-12);
    }
};

TEST(SafetyStage, WhateverComesInWhatGoesOutIsSafe)
{
    RandomNumbers random(1);
    int runs_with_force = 0;
    for (int run = 0; run < 300; ++run)
    {
        SafetyLimits limits;
        limits.max_force = random.one_in(10) ? 0 : random.between(0, 12);
        limits.max_torque = random.one_in(3) ? 0 : random.between(0, 1);
        limits.max_force_rate = random.between(0, 4000);
        limits.max_torque_rate = 100;
        limits.max_speed = 1.5;
        limits.ramp_time = random.one_in(4) ? 0 : random.between(0, 0.1);
        limits.engage_force = random.between(0, 20);
        limits.engage_torque = 100;
        SafetyStage stage(limits);
        Wrench last, requested;
        double time = 0, known_time = 0;
        bool first = true;
        int pushed = 0;
        const int wildness = 2 + random.below(200);
        for (int tick = 0; tick < 300; ++tick)
        {
            time = random.one_in(wildness) ? any_number(random)
                   : std::isfinite(time)   ? time + random.between(0, 0.004)
                                           : 0;
            if (random.one_in(4))
                requested.force = any_vector(random, random.one_in(wildness));
            if (random.one_in(4))
                requested.torque = any_vector(random, random.one_in(wildness));
            const Vector3 velocity = random.one_in(wildness) ? any_vector(random, true) : random.in_cube(0.5);
            const double allowance = random.one_in(wildness) ? any_number(random)
                                     : random.one_in(5)      ? random.between(0, 1)
                                                             : 1;

            const Wrench now = stage.limit(requested, velocity, time, allowance);

            Expectation expectation{limits, 0, 0};
            expectation.allowance = std::isfinite(allowance) ? std::clamp(allowance, 0.0, 1.0) : 0;
            if (std::isfinite(time))
            {
                expectation.elapsed = first ? 0 : std::clamp(time - known_time, 0.0, 0.01);
                known_time = time;
                first = false;
            }
            expectation.check(last.force, now.force, limits.max_force, limits.max_force_rate);
            expectation.check(last.torque, now.torque, limits.max_torque, limits.max_torque_rate);
            if (HasFatalFailure())
                return;
            // A fast change has a fault or a falling allowance as its reason.
            const bool jumped = (now.force - last.force).norm() > limits.max_force_rate * expectation.elapsed + 1e-12;
            const SafetyReport &report = stage.report();
            EXPECT_TRUE(!jumped || report.did(SafetyAction::not_finite) || report.did(SafetyAction::too_fast) ||
                        report.did(SafetyAction::held_back) || report.did(SafetyAction::no_axes));
            pushed += now.force.norm() > 0;
            last = now;
        }
        runs_with_force += pushed > 0;
    }
    EXPECT_GT(runs_with_force, 150);
}
} // namespace
} // namespace ode_predictive_space::haptics
