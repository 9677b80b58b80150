#include "tests/haptics/forecast/leaning.h"

namespace ode_predictive_space::haptics
{
namespace
{
class LongLeaningTest : public LeaningTest
{};

TEST_P(LongLeaningTest, TenMinutesAreAsOneThread)
{
    expect_steady(600);
}

TEST_P(LongLeaningTest, TenMinutesOfScrubbingAreAsOneThread)
{
    expect_even(600);
}

INSTANTIATE_TEST_SUITE_P(Loops, LongLeaningTest, leaning_loops, leaning_name);
} // namespace
} // namespace ode_predictive_space::haptics
