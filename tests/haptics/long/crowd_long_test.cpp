#include "tests/haptics/forecast/crowd_run.h"

namespace ode_predictive_space::haptics
{
namespace
{
TEST(CrowdLong, APitIsFeltAsInOneThread)
{
    expect_as_in_one_thread({Crowd::pit, 5, 0.005, 0, true, 500});
    expect_as_in_one_thread({Crowd::pit, 9, 0.005, 0, true, 200});
    expect_as_in_one_thread({Crowd::pit, 16, 0.05, 0, true, 200});
    expect_as_in_one_thread({Crowd::pit, 16, 0.002, 0, true, 60});
    expect_as_in_one_thread({Crowd::pit, 9, 0.005, 0, true, 60, Stepper::exact});
}

TEST(CrowdLong, APileIsFeltAsInOneThread)
{
    expect_as_in_one_thread({Crowd::pile, 20, 0.005, 0, true, 200});
    expect_as_in_one_thread({Crowd::pile, 50, 0.005, 0, true, 200});
}

TEST(CrowdLong, NoEnergyIsMadeAmongFiftyBodies)
{
    for (const double kilograms : {0.001, 0.005})
        for (const Crowd crowd : {Crowd::pit, Crowd::pile})
            expect_quiet({crowd, 50, kilograms});
}
} // namespace
} // namespace ode_predictive_space::haptics
