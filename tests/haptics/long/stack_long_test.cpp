#include "tests/haptics/coupling_run.h"

#include <string>

namespace ode_predictive_space::haptics
{
namespace
{
// dWorldStep() takes milliseconds for the contacts of five boxes.
TEST(CouplingLong, AStackIsFeltAsInOneThread)
{
    const CouplingCase scenario = stack(5);
    const Outcome truth = ensemble(scenario, Stepper::exact, one_thread);
    for (const double rate : {60.0, 100.0, 200.0, 500.0})
    {
        SCOPED_TRACE(std::to_string(rate) + " Hz");
        expect_as_one(ensemble(scenario, Stepper::exact, rate), truth, scenario, rate);
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
