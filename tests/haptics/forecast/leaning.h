// A hand leans on a box, or scrubs it. QuickStep sometimes lifts the box by up to 2 mm, which must not reach the hand.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_FORECAST_LEANING_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_FORECAST_LEANING_H

#include "tests/haptics/forecast/coupling_run.h"

#include <cmath>
#include <gtest/gtest.h>
#include <iostream>
#include <string>
#include <tuple>
#include <utility>

namespace ode_predictive_space::haptics
{
class LeaningTest : public testing::TestWithParam<std::tuple<Stepper, int>>
{
protected:
    static void expect_steady(double seconds)
    {
        const auto [truth, found] = expect_balanced(leaning(seconds));
        EXPECT_NEAR(found.peak_force, truth.peak_force, 0.05 * truth.peak_force);
        EXPECT_NEAR(found.least_force, truth.peak_force, 0.05 * truth.peak_force);
    }

    static void expect_even(double seconds)
    {
        const auto [truth, found] = expect_balanced(scrubbing(seconds));
        EXPECT_NEAR(found.peak_force, truth.peak_force, 0.1 * truth.peak_force);
        EXPECT_NEAR(found.least_force, truth.least_force, 0.1 * truth.least_force);
        EXPECT_GT(truth.hand_work, 0.01 * seconds) << "nothing was scrubbed";
        EXPECT_NEAR(found.hand_work, truth.hand_work, 0.05 * truth.hand_work);
    }

private:
    /// Prints the energy balance. @return the outcomes in one thread and in two.
    static std::pair<Outcome, Outcome> expect_balanced(const CouplingCase &scenario)
    {
        const auto [stepper, rate] = GetParam();
        const Outcome truth = CoupledRun(scenario, Vector3::Zero(), stepper, one_thread).outcome();
        const Outcome found = CoupledRun(scenario, Vector3::Zero(), stepper, rate).outcome();
        std::cout << "one thread:  " << truth << "\ntwo threads: " << found << '\n';
        EXPECT_NEAR(found.impulse, truth.impulse, 0.05 * truth.impulse);
        EXPECT_LE(found.unmatched, 1e-9);
        EXPECT_LE(found.made_energy, truth.made_energy + 0.05 * std::abs(found.hand_work));
        EXPECT_LE(found.given_to_hand, truth.given_to_hand + 0.05 * std::abs(truth.hand_work));
        return {truth, found};
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
