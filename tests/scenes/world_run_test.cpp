#include "demos/runs/world_run.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::worlds
{
namespace
{
TEST(WorldRunTest, FindsTheFirstTickInWhichRunsDiffer)
{
    const OdeSession ode;
    WorldRuns runs = make_runs({SpaceKind::simple, SpaceKind::hash}, WorldFactory({"gas", 80, 1}));
    run_by_turns(runs, 150);
    EXPECT_EQ(first_difference(runs), -1);

    WorldRuns different = make_runs({SpaceKind::simple}, WorldFactory({"gas", 80, 1}));
    different.push_back(std::move(make_runs({SpaceKind::simple}, WorldFactory({"gas", 80, 2})).front()));
    run_by_turns(different, 150);
    EXPECT_EQ(first_difference(different), 0);
}

TEST(WorldRunTest, PairsWithContactsAreTheSameInEveryMeasure)
{
    const OdeSession ode;
    const WorldFactory factory({"classes", 60, 1});
    const WorldRuns runs =
        make_runs({SpaceKind::predictive, SpaceKind::predictive_by_shapes, SpaceKind::hash}, factory);
    for (const auto &run : runs)
        run->measure_contacts();
    run_by_turns(runs, 20);
    for (const auto &run : runs)
    {
        run->start_measuring();
        EXPECT_EQ(run->measured().calls, 0u);
    }
    run_by_turns(runs, 200);
    EXPECT_EQ(first_difference_of_contacts(runs), -1);
    for (const auto &run : runs)
    {
        EXPECT_EQ(run->measured().contact_times.size(), 200u);
        EXPECT_EQ(run->reported().touching_hashes.size(), 220u) << "the warm-up is compared, too";
        EXPECT_EQ(run->measured().touching, runs.front()->measured().touching);
        EXPECT_GT(run->measured().touching, 0u);
        EXPECT_GE(run->measured().calls, run->measured().touching);
    }
    EXPECT_LT(runs[1]->measured().calls, runs[0]->measured().calls);
    EXPECT_EQ(runs[2]->measured().calls, runs[0]->measured().calls);
}
} // namespace
} // namespace ode_predictive_space::worlds
