// Checks that save no reports are given up.

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/near/look_budget.h"

namespace ode_predictive_space
{
namespace
{
constexpr ProxyId mesh = 3;

class LookBudgets : public testing::Test
{
protected:
    LookBudgets()
    {
        budget.begin_report();
        for (int i = 0; i < pairs; ++i)
            budget.note_new_pair(mesh);
    }

    // Reports all pairs. Each allowed check takes about `cost` instructions and finds nothing.
    //
    // @return the total cost of the checks.
    float look_in_vain(int reports, float cost)
    {
        const float work = cost / tuning::cost_of_reach;
        float spent = 0;
        for (int report = 0; report < reports; ++report)
        {
            budget.begin_report();
            for (int i = 0; i < pairs; ++i)
                if (budget.allows_look(mesh))
                {
                    budget.note_look(mesh, work);
                    spent += cost + tuning::cost_of_look;
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

    static float contacts(int reports) { return static_cast<float>(reports) * pairs * tuning::cost_of_contacts; }

    static constexpr int pairs = 10;
    LookBudget budget;
};

TEST_F(LookBudgets, InVainCostATwentiethOfTheContactsAtMost)
{
    for (const float cost : {100.0f, 2000.0f, 50000.0f})
    {
        budget.close(mesh);
        for (int i = 0; i < pairs; ++i)
            budget.note_new_pair(mesh);
        EXPECT_LT(look_in_vain(500, cost), 0.05f * contacts(500) + cost) << "from the beginning, " << cost;
        EXPECT_LT(look_in_vain(500, cost), 0.05f * contacts(500) + cost) << "later, " << cost;
    }
}

TEST_F(LookBudgets, OfLongAgoAreForgotten)
{
    spare(100000);
    EXPECT_LT(look_in_vain(500, 2000), 0.05f * contacts(500) + 2000);
}

TEST_F(LookBudgets, PayForDataThatChangeAgainAndAgain)
{
    budget.note_hull(mesh, 1, 1000);
    EXPECT_TRUE(budget.allows_look(mesh)) << "all data are read once";
    budget.note_hull(mesh, 1, 1000);
    EXPECT_TRUE(budget.allows_look(mesh)) << "the hull is the same";
    budget.note_hull(mesh, 2, 1000);
    EXPECT_FALSE(budget.allows_look(mesh));
}

TEST_F(LookBudgets, DoNotGrowWithPairsThatComeAndGo)
{
    look_in_vain(500, 2000);
    const float before = look_in_vain(500, 2000);
    for (int report = 0; report < 500; ++report)
    {
        budget.begin_report();
        budget.note_new_pair(mesh);
    }
    EXPECT_LT(look_in_vain(500, 2000), 1.1f * before + 4000);
}

TEST_F(LookBudgets, EndWithTheObject)
{
    budget.note_look(mesh, 1e6f);
    budget.close(mesh);
    budget.note_new_pair(mesh);
    EXPECT_TRUE(budget.allows_look(mesh));
}
} // namespace
} // namespace ode_predictive_space
