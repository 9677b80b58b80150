// Checks that save no reports are given up.

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/near/gap_budget.h"

namespace ode_predictive_space
{
namespace
{
constexpr ProxyId mesh = 3;

class GapBudgets : public testing::Test
{
protected:
    GapBudgets()
    {
        budget.begin_report();
        for (int i = 0; i < pairs; ++i)
            budget.note_new_pair(mesh);
    }

    // Reports all pairs. Each allowed check costs some `cost` contacts and finds nothing. @return the total cost of the checks.
    float check_in_vain(int reports, float cost)
    {
        const float work = cost / tuning::cost_of_reach;
        float spent = 0;
        for (int report = 0; report < reports; ++report)
        {
            budget.begin_report();
            for (int i = 0; i < pairs; ++i)
                if (budget.allows_check(mesh))
                {
                    budget.note_check(mesh, work);
                    spent += cost + tuning::cost_of_check;
                }
                else
                    budget.note_reported(mesh);
        }
        return spent;
    }

    void spare(int reports)
    {
        for (int report = 0; report < reports; ++report)
        {
            budget.begin_report();
            for (int i = 0; i < pairs; ++i)
                budget.note_spared(mesh);
        }
    }

    static float contacts(int reports) { return static_cast<float>(reports) * pairs; }

    static constexpr int pairs = 10;
    GapBudget budget;
};

TEST_F(GapBudgets, InVainCostATwentiethOfTheContactsAtMost)
{
    for (const float cost : {0.06f, 1.2f, 30.0f})
    {
        budget.close(mesh);
        for (int i = 0; i < pairs; ++i)
            budget.note_new_pair(mesh);
        EXPECT_LT(check_in_vain(500, cost), 0.05f * contacts(500) + cost) << "from the beginning, " << cost;
        EXPECT_LT(check_in_vain(500, cost), 0.05f * contacts(500) + cost) << "later, " << cost;
    }
}

TEST_F(GapBudgets, OfLongAgoAreForgotten)
{
    spare(100000);
    EXPECT_LT(check_in_vain(500, 1.2f), 0.05f * contacts(500) + 1.2f);
}

TEST_F(GapBudgets, PayForDataThatChangeAgainAndAgain)
{
    budget.note_hull(mesh, 1, 1000);
    EXPECT_TRUE(budget.allows_check(mesh)) << "all data are read once";
    budget.note_hull(mesh, 1, 1000);
    EXPECT_TRUE(budget.allows_check(mesh)) << "the hull is the same";
    budget.note_hull(mesh, 2, 1000);
    EXPECT_FALSE(budget.allows_check(mesh));
}
} // namespace
} // namespace ode_predictive_space
