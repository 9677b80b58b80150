// Looks at primitives go on where they spare reports, are given up where they do not, and are tried again.

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/near/look_payoff.h"

namespace ode_predictive_space
{
namespace
{
class LookPayoffs : public testing::Test
{
protected:
    // Reports that each have so many looks and so many postponed pairs.
    void pass(int reports, int looks, int postponed)
    {
        for (; reports > 0; --reports)
        {
            for (int i = 0; i < looks; ++i)
                payoff.note_look();
            for (int i = 0; i < postponed; ++i)
                payoff.note_postponed();
            changes += payoff.end_report();
        }
    }

    static constexpr int trial = tuning::reports_of_trial, between = tuning::reports_between_trials;
    LookPayoff payoff;
    int changes = 0;
};

TEST_F(LookPayoffs, GoOnWhereLooksSpareReports)
{
    pass(100 * trial, 2, 5);
    EXPECT_TRUE(payoff.pays());
    pass(100 * trial, 0, 0);
    EXPECT_TRUE(payoff.pays()) << "nothing is near";
    EXPECT_EQ(changes, 0);
}

TEST_F(LookPayoffs, EndWhereTheySpareNoneAndAreTriedAgain)
{
    pass(2 * trial - 1, 2, 1);
    EXPECT_TRUE(payoff.pays());
    pass(1, 2, 1);
    EXPECT_FALSE(payoff.pays());
    pass(between - 1, 0, 0);
    EXPECT_FALSE(payoff.pays());
    pass(1, 0, 0);
    EXPECT_TRUE(payoff.pays());
    EXPECT_EQ(changes, 2);
    pass(2 * trial, 2, 1);
    EXPECT_FALSE(payoff.pays());
}

TEST_F(LookPayoffs, EndLaterWhenTheSceneChanges)
{
    pass(10 * trial, 1, 10);
    pass(20 * trial, 1, 1);
    EXPECT_FALSE(payoff.pays());
}

TEST_F(LookPayoffs, GoOnAfterAFewBadReports)
{
    pass(100 * trial, 1, 10);
    pass(trial, 1, 1);
    EXPECT_TRUE(payoff.pays());
}

TEST_F(LookPayoffs, OfTheFirstReportsSayNothing)
{
    pass(trial, 10, 0);
    pass(trial, 1, 10);
    EXPECT_TRUE(payoff.pays());
}

TEST_F(LookPayoffs, AreNotJudgedWhileASurfaceIsBuilt)
{
    for (int i = 0; i < 10 * trial; ++i)
    {
        payoff.note_waiting();
        pass(1, 10, 0);
    }
    EXPECT_TRUE(payoff.pays());
}
} // namespace
} // namespace ode_predictive_space
