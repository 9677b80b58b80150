// A hand that leans on a box, in two threads as in one. QuickStep lifts the box by up to 2 mm now and then: the hand must not feel it.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_LEANING_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_LEANING_H

#include "tests/haptics/coupling_run.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <string>
#include <tuple>

namespace ode_predictive_space::haptics
{
/// By ODE's stepper and the rate of the scene, Hz.
class LeaningTest : public testing::TestWithParam<std::tuple<Stepper, int>>
{
protected:
    /// Prints the energy balance.
    static void expect_steady(double seconds)
    {
        const auto [stepper, rate] = GetParam();
        const Outcome truth = lean(seconds, stepper, one_thread);
        const Outcome found = lean(seconds, stepper, rate);
        std::cout << "one thread:  " << truth << "\ntwo threads: " << found << '\n';
        EXPECT_NEAR(found.peak_force, truth.peak_force, 0.05 * truth.peak_force);
        EXPECT_NEAR(found.least_force, truth.peak_force, 0.05 * truth.peak_force);
        EXPECT_NEAR(found.impulse, truth.impulse, 0.05 * truth.impulse);
        EXPECT_LE(found.unmatched, 1e-9);
        EXPECT_LE(found.made_energy, truth.made_energy + 0.05 * std::abs(found.hand_work));
        EXPECT_LE(found.given_to_hand, truth.given_to_hand + 0.05 * std::abs(truth.hand_work));
    }

private:
    static Outcome lean(double seconds, Stepper stepper, double rate)
    {
        return CoupledRun(leaning(seconds), Vector3::Zero(), stepper, rate).outcome();
    }
};

const auto leaning_loops =
    testing::Combine(testing::Values(Stepper::exact, Stepper::quick), testing::Values(60, 100, 200, 500));

inline std::string leaning_name(const testing::TestParamInfo<std::tuple<Stepper, int>> &info)
{
    return (std::get<0>(info.param) == Stepper::quick ? "QuickStepAt" : "StepAt") +
           std::to_string(std::get<1>(info.param)) + "Hz";
}
} // namespace ode_predictive_space::haptics

#endif
