// Hands press on many light bodies at once: no energy is made, and forces change no faster than hand and bodies move.

#include "tests/haptics/forecast/crowd_run.h"

namespace ode_predictive_space::haptics
{
namespace
{
class CrowdTest : public testing::TestWithParam<CrowdCase>
{};

TEST_P(CrowdTest, NoEnergyIsMadeAndForcesDoNotJump)
{
    expect_quiet(GetParam());
}

std::vector<CrowdCase> crowds_in_one_thread()
{
    return {{Crowd::pit, 1, 0.005},
            {Crowd::pit, 4, 0.005},
            {Crowd::pit, 5, 0.005},
            {Crowd::pit, 16, 0.005, 0, false},
            {Crowd::pit, 9, 0.002},
            {Crowd::pit, 16, 0.005},
            {Crowd::pit, 9, 0.05},
            {Crowd::pile, 20, 0.005},
            {Crowd::wedge, 2, 0.005, 20},
            {Crowd::wedge, 2, 0.005, 1.5},
            {Crowd::wedge, 8, 0.05, 3},
            {Crowd::pit, 9, 0.5},
            {Crowd::pit, 50, 0.05},
            {Crowd::pit, 50, 0.5},
            {Crowd::pit, 9, 0.005, 0, true, 0, Stepper::exact},
            {Crowd::pit, 5, 0.005, 0, false, 0, Stepper::exact},
            {Crowd::wedge, 2, 0.005, 1, true, 0, Stepper::exact}};
}

INSTANTIATE_TEST_SUITE_P(OneThread, CrowdTest, testing::ValuesIn(crowds_in_one_thread()), name_of_crowd);

/// Each ball is a plane at its point nearest to the proxy. Once, balls were contacts of the tool, whose normals turned faster
/// the deeper the tool was: 15 % of the energy was made, and forces jumped by 2.2 N.
TEST(CrowdThatOnlyCollideKnows, IsAsQuietAsOthers)
{
    for (const int balls : {5, 9})
        for (const double physics_rate : {0.0, 1000.0})
            expect_quiet({Crowd::pit, balls, 0.005, 0, true, physics_rate, Stepper::quick, true});
    for (const double physics_rate : {0.0, 200.0})
        expect_quiet({Crowd::pit, 5, 0.005, 0, false, physics_rate, Stepper::quick, true});
    expect_quiet({Crowd::pit, 5, 0.005, 0, true, 200, Stepper::quick, true});
    expect_quiet({Crowd::pit, 2, 0.001, 0, true, 0, Stepper::quick, true});
    expect_quiet({Crowd::pit, 5, 0.05, 0, true, 0, Stepper::quick, true});
}

class CrowdInTwoThreadsTest : public testing::TestWithParam<CrowdCase>
{};

TEST_P(CrowdInTwoThreadsTest, IsFeltAsInOne)
{
    expect_as_in_one_thread(GetParam());
}

std::vector<CrowdCase> crowds_in_two_threads()
{
    return {{Crowd::pit, 1, 0.005, 0, true, 200},
            {Crowd::pit, 5, 0.005, 0, true, 200},
            {Crowd::pit, 5, 0.005, 0, true, 60},
            {Crowd::pit, 5, 0.005, 0, true, 1000},
            {Crowd::pit, 5, 0.005, 0, false, 200},
            {Crowd::pit, 9, 0.05, 0, true, 60},
            {Crowd::pit, 50, 0.05, 0, true, 200},
            {Crowd::wedge, 8, 0.05, 3, true, 200},
            {Crowd::pit, 5, 0.005, 0, true, 200, Stepper::exact},
            {Crowd::pit, 5, 0.005, 0, true, 60, Stepper::exact}};
}

INSTANTIATE_TEST_SUITE_P(TwoThreads, CrowdInTwoThreadsTest, testing::ValuesIn(crowds_in_two_threads()), name_of_crowd);
} // namespace
} // namespace ode_predictive_space::haptics
