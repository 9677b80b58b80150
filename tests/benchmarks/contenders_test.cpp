// All contenders find the same pairs in every scene.

#include "demos/runs/world_run.h"
#include "tests/benchmarks/contenders/contenders.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

class ContendersInScene : public testing::TestWithParam<std::string>
{
protected:
    OdeSession ode_;
};

INSTANTIATE_TEST_SUITE_P(Contenders, ContendersInScene, testing::ValuesIn(world_names(Group::scene)),
                         [](const auto &info) { return info.param; });

WorldRuns runs_of_all(const WorldSpec &spec)
{
    const WorldFactory factory(spec);
    WorldRuns runs;
    for (const std::string &name : contender_names())
    {
        // The floors need the pairs beforehand; in churn geoms come and go.
        if (spec.name != "churn" || name.rfind("floor", 0) != 0)
        {
            runs.push_back(std::make_unique<WorldRun>(benchmarks::make_contender(name, factory), factory));
        }
    }
    return runs;
}

TEST_P(ContendersInScene, AllExactOnesReportTheSamePairs)
{
    const WorldRuns runs = runs_of_all({GetParam(), 40, 3});
    run_by_turns(runs, 250);
    EXPECT_EQ(first_difference(runs), -1);
    EXPECT_EQ(runs.size(), contender_names().size() - (GetParam() == "churn" ? 2 : 0))
        << "all, in churn all but the floors";
    for (const auto &run : runs)
    {
        EXPECT_TRUE(!run->contender().exact() || run->pair_hash() == runs.front()->pair_hash()) << run->name();
        EXPECT_EQ(run->contacts(), runs.front()->contacts()) << run->name();
        EXPECT_GT(run->pairs(), 0u) << run->name();
    }
}
} // namespace
} // namespace ode_predictive_space::benchmarks
