#include "tests/haptics/forecast/coupling_run.h"

#include <string>

namespace ode_predictive_space::haptics
{
namespace
{
void expect_as_one_at_all_rates(const CouplingCase &scenario, Stepper stepper)
{
    const Outcome truth = ensemble(scenario, stepper, one_thread);
    for (const double rate : {60.0, 100.0, 200.0, 500.0})
    {
        SCOPED_TRACE(std::to_string(rate) + " Hz");
        expect_as_one(ensemble(scenario, stepper, rate), truth, scenario, rate);
    }
}

// dWorldStep() takes milliseconds for the contacts of five boxes.
TEST(CouplingLong, AStackIsFeltAsInOneThread)
{
    expect_as_one_at_all_rates(stack(5), Stepper::exact);
}

TEST(CouplingLong, ARopeOfTwentyIsFeltAsInOneThread)
{
    expect_as_one_at_all_rates(rope_of_twenty(), Stepper::exact);
}

TEST(CouplingLong, ARopeOfTwentyIsFeltAsInOneThreadByQuickStep)
{
    expect_as_one_at_all_rates(rope_of_twenty(), Stepper::quick);
}
} // namespace
} // namespace ode_predictive_space::haptics
