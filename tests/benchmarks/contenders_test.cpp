// Whatever takes part finds the same pairs, in every scene.

#include "demos/runs/world_run.h"
#include "tests/benchmarks/contenders/contenders.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <stdexcept>

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
        // The floors must know the pairs beforehand, and in churn geoms come and go.
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

class Contenders : public testing::Test
{
protected:
    OdeSession ode_;
};

TEST_F(Contenders, TheFloorKnowsThePairsOfAScene)
{
    for (const char *scene : {"gas", "pile"})
    {
        const WorldRuns runs = runs_of_all({scene, 300, 1});
        run_by_turns(runs, 60);
        EXPECT_EQ(first_difference(runs), -1) << scene;
        const std::vector<std::string> names = {runs[runs.size() - 2]->name(), runs.back()->name()};
        EXPECT_EQ(names, (std::vector<std::string>{"floor-boxes", "floor"}));
        EXPECT_EQ(runs.back()->pair_hash(), runs.front()->pair_hash()) << scene;
        EXPECT_EQ(runs[runs.size() - 2]->pair_hash(), runs.front()->pair_hash()) << scene;
    }
}

TEST_F(Contenders, SpheresLeaveOutPairsButNoContact)
{
    const WorldRuns runs = runs_of_all({"pile", 60, 1});
    run_by_turns(runs, 50);
    const auto is = [](const char *name) { return [name](const auto &run) { return run->name() == name; }; };
    const auto spheres = std::find_if(runs.begin(), runs.end(), is("predictive-sphere"));
    ASSERT_NE(spheres, runs.end());
    EXPECT_FALSE((*spheres)->contender().exact());
    EXPECT_LT((*spheres)->pairs(), runs.front()->pairs());
    EXPECT_EQ((*spheres)->contacts(), runs.front()->contacts());
}

TEST_F(Contenders, AnUnknownOneIsRefused)
{
    const WorldFactory factory({"gas", 10, 1});
    EXPECT_THROW(benchmarks::make_contender("octree", factory), std::invalid_argument);
    EXPECT_EQ(benchmarks::make_contender("predictive", factory)->name(), "predictive-box");
}

/// Reports nothing.
class Blind : public Contender
{
public:
    Blind() : Contender("blind", Family::reference, OwnedSpace(dSimpleSpaceCreate(nullptr))) {}

    std::size_t finish(PairList &list) override
    {
        list.clear();
        return 0;
    }
};

TEST_F(Contenders, OneThatLosesPairsIsNoticed)
{
    const WorldFactory factory({"game", 40, 1});
    WorldRuns runs;
    runs.push_back(std::make_unique<WorldRun>(SpaceKind::simple, factory));
    runs.push_back(std::make_unique<WorldRun>(std::make_unique<Blind>(), factory));
    run_by_turns(runs, 100);
    EXPECT_GE(first_difference(runs), 0);
}
} // namespace
} // namespace ode_predictive_space::benchmarks
