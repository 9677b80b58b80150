// Hands that press on many light bodies at once: no energy is made, and forces change no faster than hand and bodies move.

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

/// What dCollide() alone knows has no proxy: its normals turn faster, the deeper the tool is. Up to 2.4 times the exchanged energy was made when
/// these balls did not yield.
TEST(CrowdThatOnlyCollideKnows, MakesLittleEnergy)
{
    for (const int balls : {4, 9})
    {
        const CrowdCase scenario = {Crowd::pit, balls, 0.005, 0, true, 0, Stepper::quick, true};
        for (int hand = 0; hand < hands_of_crowd; ++hand)
        {
            const CrowdOutcome outcome = CrowdRun(scenario, hand).outcome();
            EXPECT_LE(outcome.made_energy, 0.15 * outcome.exchanged)
                << name_of(scenario) << ", hand " << hand << ": " << outcome;
            EXPECT_GT(outcome.peak_force, 0.01);
        }
    }
}

/// Where each is felt alone, a touch needs no proxy. In transforms the balls lay beside the centres of their bodies, whose spin moved the surfaces faster
/// than the bodies: up to 2.2 N were not explained.
TEST(CrowdThatOnlyCollideKnows, DoesNotJumpWhereEachIsFeltAlone)
{
    for (const int balls : {4, 5})
        for (const double physics_rate : {0.0, 200.0})
            expect_quiet({Crowd::pit, balls, 0.005, 0, false, physics_rate, Stepper::quick, true});
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
