#include "tests/times/motion_history.h"

#include <algorithm>
#include <iostream>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/ode_test.h"

namespace ode_predictive_space
{
namespace
{
double quantile(std::vector<double> &values, double part)
{
    if (values.empty())
        return 0;
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

class MotionHistories : public ::testing::TestWithParam<int>
{};

TEST_P(MotionHistories, NoTimeIsLaterThanTheMeeting)
{
    const OdeMessages messages;
#ifdef ODE_PREDICTIVE_SPACE_LONG_TEST
    constexpr std::uint64_t histories = 60000;
#else
    constexpr std::uint64_t histories = 400;
#endif
    MotionTally tally;
    for (std::uint64_t seed = 1; seed <= histories; ++seed)
        ASSERT_EQ(run_motion_history(seed, GetParam(), tally), "") << "seed " << seed;
    std::cout << tally.questions << " questions, " << tally.compared << " compared, " << tally.unknown
              << " answers not known yet, " << tally.needlessly_unknown << " later, " << tally.late_after_a_change
              << " late before the third sample; time over time until the meeting, quantiles 0, 0.1, 0.5, 0.9: ";
    for (auto *parts : {&tally.parts, &tally.parts_of_apart})
    {
        for (double part : {0.0, 0.1, 0.5, 0.9})
            std::cout << quantile(*parts, part) << " ";
        std::cout << "of " << parts->size() << "; ";
    }
    std::cout << "\n";
    EXPECT_GT(tally.compared, tally.questions / 20);
    EXPECT_LT(tally.needlessly_unknown, tally.questions / 20);
    EXPECT_GT(quantile(tally.parts, 0.5), 0.3);
}

std::string name_of(const ::testing::TestParamInfo<int> &info)
{
    static const char *const names[] = {"by_box", "by_sphere", "by_shape"};
    return names[info.param];
}

INSTANTIATE_TEST_SUITE_P(Each, MotionHistories,
                         ::testing::Values(dPredictiveProximityBox, dPredictiveProximitySphere,
                                           dPredictiveProximityShape),
                         name_of);
} // namespace
} // namespace ode_predictive_space
