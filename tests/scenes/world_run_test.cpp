#include "demos/runs/result_records.h"
#include "demos/runs/world_run.h"

#include <gtest/gtest.h>
#include <sstream>
#include <stdexcept>

namespace ode_predictive_space::worlds
{
namespace
{
class WorldRunTest : public testing::Test
{
protected:
    OdeSession ode_;
    WorldFactory factory_{{"gas", 80, 1}};
};

TEST_F(WorldRunTest, FindsTheFirstTickInWhichRunsDiffer)
{
    WorldRuns runs = make_runs({SpaceKind::simple, SpaceKind::hash}, factory_);
    run_by_turns(runs, 150);
    EXPECT_EQ(first_difference(runs), -1);

    WorldRuns different;
    different.push_back(std::make_unique<WorldRun>(SpaceKind::simple, factory_));
    different.push_back(std::make_unique<WorldRun>(SpaceKind::simple, WorldFactory({"gas", 80, 2})));
    run_by_turns(different, 150);
    EXPECT_EQ(first_difference(different), 0);
}

WorldRuns contact_runs(const std::vector<SpaceKind> &kinds, const WorldFactory &factory)
{
    WorldRuns runs = make_runs(kinds, factory);
    for (const auto &run : runs)
        run->measure_contacts();
    return runs;
}

TEST_F(WorldRunTest, PairsWithContactsAreTheSameInEveryMeasure)
{
    const WorldFactory factory({"classes", 60, 1});
    const WorldRuns runs =
        contact_runs({SpaceKind::predictive, SpaceKind::predictive_by_shapes, SpaceKind::hash}, factory);
    run_by_turns(runs, 20);
    for (const auto &run : runs)
    {
        run->start_measuring();
        EXPECT_EQ(run->calls(), 0u);
    }
    run_by_turns(runs, 200);
    EXPECT_EQ(first_difference_of_contacts(runs), -1);
    for (const auto &run : runs)
    {
        EXPECT_EQ(run->contact_times().size(), 200u);
        EXPECT_EQ(run->touching_hashes().size(), 220u) << "the warm-up is compared, too";
        EXPECT_EQ(run->touching(), runs.front()->touching());
        EXPECT_GT(run->touching(), 0u);
        EXPECT_GE(run->calls(), run->touching());
    }
    EXPECT_LT(runs[1]->calls(), runs[0]->calls());
    EXPECT_EQ(runs[2]->calls(), runs[0]->calls());
}

TEST_F(WorldRunTest, FindsTheFirstTickInWhichContactsDiffer)
{
    const WorldFactory factory({"mix", 60, 1});
    WorldRuns runs = contact_runs({SpaceKind::predictive_by_shapes}, factory);
    runs.push_back(std::make_unique<WorldRun>(SpaceKind::simple, WorldFactory({"mix", 60, 2})));
    runs.back()->measure_contacts();
    run_by_turns(runs, 400);
    EXPECT_GE(first_difference_of_contacts(runs), 0);
}

TEST_F(WorldRunTest, RunsThatHaveUsedUpTheirTimeRestAndAreComparedInTheTicksTheyHave)
{
    WorldRuns runs = make_runs({SpaceKind::simple, SpaceKind::hash}, factory_);
    run_by_turns(runs, 250, {}, 1e-9);
    for (const auto &run : runs)
        EXPECT_EQ(run->ticks(), 1u);
    runs.front()->turn(10);
    EXPECT_EQ(first_difference(runs), -1);
}

TEST_F(WorldRunTest, ChecksThePredictiveSpace)
{
    WorldRun run(SpaceKind::predictive, factory_);
    run.check_every_tick();
    for (int tick = 0; tick < 300; ++tick)
        run.tick();
    EXPECT_TRUE(run.invariant_held());
}

/// Two boxes with a gap that single precision cannot resolve, and a third that touches the first.
class AlmostTouching : public World
{
public:
    explicit AlmostTouching(dSpaceID space) : World({}, space)
    {
        for (const double place : {0.0, 1 + 1e-9, -1.0})
            set_position(objects_.add_geom(dCreateBox(space, 1, 1, 1)), {place, 0, 0});
    }

    void advance() override {}
};

std::unique_ptr<WorldRun> run_almost_touching(SpaceKind kind, dSpaceID space)
{
    auto world = std::make_unique<AlmostTouching>(space);
    auto run = std::make_unique<WorldRun>(make_contender(kind, OwnedSpace(space)), std::move(world));
    run->tick();
    return run;
}

TEST_F(WorldRunTest, FalsePairsOfSweepAndPruneAreCountedApart)
{
    WorldRuns runs;
    runs.push_back(run_almost_touching(SpaceKind::simple, dSimpleSpaceCreate(nullptr)));
    runs.push_back(run_almost_touching(SpaceKind::sweep_and_prune, dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)));
    EXPECT_EQ(runs[0]->pairs(), 1u);
    EXPECT_EQ(runs[0]->false_pairs(), 0u);
    EXPECT_EQ(runs[1]->pairs(), 1u);
    EXPECT_EQ(runs[1]->false_pairs(), 1u);
    EXPECT_EQ(first_difference(runs), -1);
}

TEST_F(WorldRunTest, FalsePairsOfOtherSpacesAreNotForgiven)
{
    WorldRuns runs;
    runs.push_back(run_almost_touching(SpaceKind::simple, dSimpleSpaceCreate(nullptr)));
    // A space that reports too much, as sweep-and-prune does, under another name.
    runs.push_back(run_almost_touching(SpaceKind::predictive, dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ)));
    EXPECT_EQ(runs[1]->pairs(), 2u);
    EXPECT_EQ(runs[1]->false_pairs(), 0u);
    EXPECT_EQ(first_difference(runs), 0);
}

TEST_F(WorldRunTest, ARecordHasAllThatAReaderNeeds)
{
    WorldRun run(SpaceKind::sweep_and_prune, factory_);
    run.tick();
    const nlohmann::json record = record_of(run, factory_.spec());
    EXPECT_EQ(record.at("scene"), "gas");
    EXPECT_EQ(record.at("space"), "sap");
    EXPECT_EQ(record.at("n"), 80);
    EXPECT_EQ(record.at("seed"), 1);
    EXPECT_EQ(record.at("ticks"), 1);
    EXPECT_EQ(record.at("pair_hash").get<std::string>().size(), 16u);
    for (const char *name : {"mean_us", "median_us", "p99_us", "p999_us", "max_us", "pairs"})
        EXPECT_TRUE(record.contains(name)) << name;
    EXPECT_THROW(write_json("/no/such/folder/file.json", record), std::runtime_error);
}
} // namespace
} // namespace ode_predictive_space::worlds
