#include "tests/haptics/forecast/coupling_run.h"

namespace ode_predictive_space::haptics
{
namespace
{
// dWorldStep() takes milliseconds for the contacts of five boxes.
TEST(CouplingLong, AStackIsFeltAsInOneThread)
{
    expect_as_one_at(all_rates, stack(5), Stepper::exact);
}

TEST(CouplingLong, ARopeOfTwentyIsFeltAsInOneThread)
{
    expect_as_one_at(all_rates, rope_of_twenty(), Stepper::exact);
}

TEST(CouplingLong, ARopeOfTwentyIsFeltAsInOneThreadByQuickStep)
{
    expect_as_one_at(all_rates, rope_of_twenty(), Stepper::quick);
}
} // namespace
} // namespace ode_predictive_space::haptics
