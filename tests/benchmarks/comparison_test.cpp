#include "tests/benchmarks/comparison.h"

#include "tests/benchmarks/batches.h"
#include "tests/benchmarks/contenders/contenders.h"
#include "tests/benchmarks/first_tick.h"
#include "tests/benchmarks/weight.h"

#include "demos/runs/spaces.h"

#include <cmath>
#include <gtest/gtest.h>
#include <sstream>

namespace ode_predictive_space::benchmarks
{
namespace
{
using namespace worlds;

class ComparisonTest : public testing::Test
{
protected:
    static Plan plan(const char *scene, int objects)
    {
        Plan plan;
        plan.spec = {scene, objects, 1};
        plan.contenders = {"predictive-box", "sap", "quadtree"};
        plan.ticks = 130;
        plan.warm_up_ticks = 20;
        return plan;
    }

    OdeSession ode_;
    Findings findings_;
};

TEST_F(ComparisonTest, SmallScenesAreTimedInBatchesAndComparedTickByTick)
{
    const Comparison comparison = compare(plan("mix", 30), findings_);
    EXPECT_TRUE(comparison.in_batches);
    ASSERT_EQ(comparison.results.size(), 3u);
    for (const Result &result : comparison.results)
    {
        EXPECT_EQ(result.times.size(), 130u / ticks_per_batch);
        EXPECT_EQ(result.clock_times.size(), 130u);
        EXPECT_EQ(result.tick_times.size(), 130u);
        EXPECT_EQ(result.ticks, 150u);
        EXPECT_EQ(result.pair_hash, comparison.results.front().pair_hash);
    }
    EXPECT_EQ(findings_.status(), exit_ok);
}

TEST_F(ComparisonTest, LargerOnesAreTimedTickByTick)
{
    const Comparison comparison = compare(plan("gas", objects_for_single_ticks), findings_);
    EXPECT_FALSE(comparison.in_batches);
    EXPECT_EQ(comparison.results.front().times.size(), 130u);
}

TEST_F(ComparisonTest, TheBestOfOdeIsTheOneWithTheLeastMean)
{
    Comparison comparison;
    comparison.results.resize(3);
    comparison.results[0].times = {1, 1};
    comparison.results[0].family = Family::predictive;
    comparison.results[1].name = "slow";
    comparison.results[1].times = {4, 8};
    comparison.results[1].family = Family::ode;
    EXPECT_EQ(comparison.best_of_ode()->name, "slow");
    comparison.results[2].name = "fast";
    comparison.results[2].times = {5, 5};
    comparison.results[2].family = Family::ode;
    EXPECT_EQ(comparison.best_of_ode()->name, "fast");
    EXPECT_EQ(comparison.find("slow"), &comparison.results[1]);
    EXPECT_EQ(comparison.find("octree"), nullptr);
    EXPECT_EQ(Comparison().best_of_ode(), nullptr);
}

TEST_F(ComparisonTest, ARatioIsOverTheTicksThatBothHave)
{
    Comparison comparison;
    Result ours;
    constexpr std::size_t enough = Comparison::least_common_ticks;
    ours.times = std::vector<double>(enough, 1);
    ours.times.insert(ours.times.end(), enough, 10);
    ours.clock_times = ours.times;
    ours.ticks = 2 + 2 * enough; // two of them warm-up
    Result other;
    other.times = std::vector<double>(1 + enough, 2);
    other.times.front() = 9;
    other.clock_times = other.times;
    other.ticks = 2 + enough; // one of them warm-up
    EXPECT_DOUBLE_EQ(comparison.ratio(other, ours), 2);
    Result stopped_soon;
    stopped_soon.times = stopped_soon.clock_times = {44, 44, 44};
    stopped_soon.ticks = 5;
    EXPECT_DOUBLE_EQ(comparison.ratio(stopped_soon, ours), 8) << "few ticks in common: means";
    Result much_earlier;
    much_earlier.times = much_earlier.clock_times = {11};
    much_earlier.ticks = 1;
    EXPECT_DOUBLE_EQ(comparison.ratio(much_earlier, ours), 2) << "no tick in common: means";
    comparison.in_batches = true;
    other.times = {44};
    EXPECT_DOUBLE_EQ(comparison.ratio(other, ours), 8) << "batches: means";
}

TEST_F(ComparisonTest, OneThatCannotTakePartIsLeftOutWithANote)
{
    Plan with_floor = plan("churn", 40);
    with_floor.contenders.emplace_back("floor");
    const Comparison comparison = compare(with_floor, findings_);
    EXPECT_EQ(comparison.results.size(), 3u);
    std::ostringstream text;
    findings_.print(text);
    EXPECT_NE(text.str().find("without floor"), std::string::npos) << text.str();
}

TEST_F(ComparisonTest, WhatIsTooSlowIsLeftOutWithANote)
{
    EXPECT_EQ(fast_enough({"simple", "sap"}, {"gas", 1000}, findings_), (std::vector<std::string>{"simple", "sap"}));
    EXPECT_EQ(fast_enough({"simple", "sap"}, {"gas", 100000}, findings_), (std::vector<std::string>{"sap"}));
    std::ostringstream text;
    findings_.print(text);
    EXPECT_NE(text.str().find("gas 100,000, without simple"), std::string::npos) << text.str();
}

TEST_F(ComparisonTest, APlanFollowsTheOptions)
{
    Options options;
    options.seed = 7;
    EXPECT_EQ(plan_for({"gas", 100}, {"sap"}, 1000, options).ticks, 1000);
    EXPECT_EQ(plan_for({"gas", 100}, {"sap"}, 1000, options).spec.seed, 7u);
    EXPECT_EQ(plan_for({"gas", 100}, {"sap"}, 1000, options).contenders, (std::vector<std::string>{"sap"}));
    options.quick = true;
    EXPECT_LT(plan_for({"gas", 100}, {"sap"}, 1000, options).ticks, 1000);
    options.ticks = 5;
    options.spaces = {"hash"};
    EXPECT_EQ(plan_for({"gas", 100}, {"sap"}, 1000, options).ticks, 5);
    EXPECT_EQ(plan_for({"gas", 100}, {"sap"}, 1000, options).contenders, options.spaces);
}

TEST_F(ComparisonTest, FirstTicksAreThoseOfFreshCopies)
{
    const Comparison comparison = compare_first_ticks(plan("game", 30), 4, findings_);
    ASSERT_EQ(comparison.results.size(), 3u);
    for (const Result &result : comparison.results)
    {
        EXPECT_EQ(result.times.size(), 4u);
        EXPECT_EQ(result.pair_hash, comparison.results.front().pair_hash);
        EXPECT_GT(result.pairs, 0u);
    }
    EXPECT_EQ(findings_.status(), exit_ok);
}

TEST_F(ComparisonTest, IsMadeOnceForAllThatAskForTheSame)
{
    Plan asked = plan("gas", objects_for_single_ticks);
    const auto made = compare_once(asked, findings_);
    const std::size_t records = findings_.records().size();
    asked.contenders = {"sap"};
    EXPECT_EQ(compare_once(asked, findings_), made) << "it is one of the contenders";
    EXPECT_EQ(findings_.records().size(), records) << "recorded once";
    asked.contenders = {"sap", "sweep"};
    EXPECT_NE(compare_once(asked, findings_), made) << "another contender";
    asked.contenders = {"sap"};
    asked.spec.seed = 2;
    EXPECT_NE(compare_once(asked, findings_), made) << "another seed";
    asked.spec.moving = 0.1;
    EXPECT_NE(compare_once(asked, findings_), made) << "another share of moving objects";
    Findings others;
    EXPECT_NE(compare_once(plan("gas", objects_for_single_ticks), others), made) << "nothing was found there";
}

TEST_F(ComparisonTest, OneThatCannotTakePartNeedNotHave)
{
    Plan with_floor = plan("churn", 40);
    with_floor.contenders.emplace_back("floor");
    const auto made = compare_once(with_floor, findings_);
    EXPECT_EQ(compare_once(with_floor, findings_), made);
}

TEST_F(ComparisonTest, ASpaceIsWeighedWithoutItsGeoms)
{
    const WorldFactory factory({"gas", 500, 1});
    EXPECT_EQ(bytes_per_geom("predictive-box", factory) > 0, heap_in_use() > 0) << "an instrumented heap tells nothing";
    EXPECT_TRUE(std::isnan(bytes_per_geom("hash", factory)));
}

TEST_F(ComparisonTest, APredictiveSpaceTellsItsWeightOthersAreWeighedIfWanted)
{
    Plan asked = plan("gas", objects_for_single_ticks);
    const Comparison told = compare(asked, findings_);
    EXPECT_GT(told.find("predictive-box")->bytes_per_geom, 0);
    EXPECT_TRUE(std::isnan(told.find("sap")->bytes_per_geom));
    asked.weigh = true;
    EXPECT_FALSE(std::isnan(compare(asked, findings_).find("sap")->bytes_per_geom));
}
} // namespace
} // namespace ode_predictive_space::benchmarks
