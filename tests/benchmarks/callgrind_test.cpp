// predictive_bench instructions with valgrind, which the package valgrind has.

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <unistd.h>

#include "tests/support/program.h"

namespace ode_predictive_space::benchmarks
{
namespace
{
const std::string small_scene = "instructions --scenes gas:20 --warm-up 20 --ticks 30 --spaces predictive,sap";

/// A file that goes with this object.
class TemporaryFile
{
public:
    explicit TemporaryFile(const std::string &name)
        : path_(std::filesystem::temp_directory_path() / (name + "_" + std::to_string(getpid()) + ".json"))
    {}
    ~TemporaryFile() { std::filesystem::remove(path_); }
    TemporaryFile(const TemporaryFile &) = delete;
    TemporaryFile &operator=(const TemporaryFile &) = delete;

    std::string quoted() const { return "'" + path_.string() + "'"; }
    nlohmann::json read() const { return nlohmann::json::parse(std::ifstream(path_)); }
    void write(const nlohmann::json &value) const { std::ofstream(path_) << value; }

private:
    std::filesystem::path path_;
};

TEST(Callgrind, TwoRunsCountTheSame)
{
    const TemporaryFile first("callgrind_first");
    const TemporaryFile second("callgrind_second");
    const Outcome outcome = run(PREDICTIVE_BENCH, small_scene + " --json " + first.quoted());
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const Outcome again =
        run(PREDICTIVE_BENCH, small_scene + " --against " + first.quoted() + " --json " + second.quoted());
    ASSERT_EQ(again.status, 0) << again.output;
    EXPECT_TRUE(contains(again.output, "predictive-box: geometric mean 1.0000, largest 1.0000 (gas 20)"))
        << again.output;
    const nlohmann::json records = first.read();
    EXPECT_EQ(records, second.read());
    ASSERT_EQ(records.size(), 2u);
    for (const nlohmann::json &record : records)
    {
        EXPECT_EQ(record.at("scene"), "gas");
        EXPECT_EQ(record.at("n"), 20);
        EXPECT_EQ(record.at("ticks"), 30);
        EXPECT_EQ(record.at("pair_hash"), records[0].at("pair_hash"));
        EXPECT_GT(record.at("collide"), 100) << record;
        EXPECT_GT(record.at("notices"), 10) << record;
        EXPECT_EQ(record.at("sum"), record.at("collide").get<double>() + record.at("notices").get<double>());
    }
}

TEST(Callgrind, MoreTicksAreNotMorePerTick)
{
    const TemporaryFile few("callgrind_few");
    const TemporaryFile many("callgrind_many");
    const std::string scene = "instructions --scenes teleport:50 --warm-up 20 --spaces simple --ticks ";
    ASSERT_EQ(run(PREDICTIVE_BENCH, scene + "20 --json " + few.quoted()).status, 0);
    ASSERT_EQ(run(PREDICTIVE_BENCH, scene + "80 --json " + many.quoted()).status, 0);
    const double once = few.read()[0].at("sum");
    EXPECT_NEAR(many.read()[0].at("sum").get<double>() / once, 1, 0.1);
}

TEST(Callgrind, TheMotionOfAPileIsTheSameThere)
{
    const TemporaryFile counted("callgrind_pile");
    const TemporaryFile timed("callgrind_pile_timed");
    const std::string pile = " --ticks 30 --spaces predictive --json ";
    ASSERT_EQ(run(PREDICTIVE_BENCH, "instructions --scenes pile:30 --warm-up 100" + pile + counted.quoted()).status, 0);
    ASSERT_EQ(run(PREDICTIVE_BENCH, "stepped --scenes pile:30" + pile + timed.quoted()).status, 0);
    EXPECT_EQ(counted.read()[0].at("pair_hash"), timed.read()[0].at("pair_hash"));
    EXPECT_GT(counted.read()[0].at("pairs"), 0);
}

TEST(Callgrind, WholeTicksAreTheSameMotionInEverySpace)
{
    const TemporaryFile file("callgrind_whole");
    const Outcome outcome =
        run(PREDICTIVE_BENCH, "instructions --whole --scenes mix:40,drones:20 --warm-up 0 --ticks 60 --spaces "
                              "predictive,predictive-shape,sap --json " +
                                  file.quoted());
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const nlohmann::json records = file.read();
    ASSERT_EQ(records.size(), 6u);
    for (std::size_t i = 0; i < records.size(); ++i)
    {
        const nlohmann::json &record = records[i], &boxes = records[i / 3 * 3];
        EXPECT_EQ(record.at("count"), "whole ticks");
        EXPECT_EQ(record.at("warm_up_ticks"), 0);
        EXPECT_EQ(record.at("state_hash"), boxes.at("state_hash"));
        EXPECT_EQ(record.at("contacts_per_tick"), boxes.at("contacts_per_tick"));
        EXPECT_EQ(record.at("both"), record.at("collide").get<double>() + record.at("contacts").get<double>());
        EXPECT_GT(record.at("notices"), 10) << record;
        EXPECT_GT(record.at("whole"), record.at("both").get<double>() + record.at("notices").get<double>()) << record;
        EXPECT_LE(record.at("calls_per_tick"), boxes.at("calls_per_tick"));
    }
    EXPECT_LT(records[4].at("calls_per_tick"), records[3].at("calls_per_tick")) << "among the walls";
    EXPECT_LT(records[4].at("contacts"), records[3].at("contacts"));
    EXPECT_NE(records[0].at("state_hash"), records[3].at("state_hash"));
}

TEST(Callgrind, WorldsAreCountedWithTheLifeOfTheirSpaces)
{
    const TemporaryFile file("callgrind_worlds");
    const Outcome outcome =
        run(PREDICTIVE_BENCH, "instructions --scenes many:8,nested:2 --warm-up 0 --ticks 20 --spaces predictive,simple "
                              "--cache-sim --json " +
                                  file.quoted());
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const nlohmann::json records = file.read();
    ASSERT_EQ(records.size(), 4u);
    for (std::size_t i = 0; i < records.size(); ++i)
    {
        const nlohmann::json &record = records[i];
        EXPECT_EQ(record.at("pair_hash"), records[i / 2 * 2].at("pair_hash"));
        EXPECT_GT(record.at("pairs"), 0);
        EXPECT_TRUE(record.contains("first_level_misses"));
        EXPECT_EQ(record.contains("life"), i < 2) << record;
        const double life = i < 2 ? record.at("life").get<double>() : 0;
        EXPECT_EQ(record.at("sum"), record.at("collide").get<double>() + record.at("notices").get<double>() + life);
    }
    EXPECT_GT(records[0].at("life"), 0);
    EXPECT_GT(records[0].at("bytes_per_geom"), 0);
    EXPECT_GT(records[2].at("first_level_misses"), 0);
}

TEST(Callgrind, TicksWithEventsAreCountedApart)
{
    const TemporaryFile file("callgrind_events");
    const std::string scenes = "instructions --scenes recentre:50,recentre_2:50 --spaces predictive --ticks ";
    ASSERT_EQ(run(PREDICTIVE_BENCH, scenes + "1 --json " + file.quoted()).status, 0);
    const nlohmann::json one = file.read();
    ASSERT_EQ(run(PREDICTIVE_BENCH, scenes + "2 --json " + file.quoted()).status, 0);
    const double of_two = file.read()[0].at("sum");
    EXPECT_NEAR(one[0].at("sum").get<double>() / of_two, 1, 0.2);
    EXPECT_GT(of_two, 2 * one[1].at("sum").get<double>()) << "two ticks later";
}

TEST(Callgrind, APoseThatIsSetAgainIsANotice)
{
    const TemporaryFile file("callgrind_dart");
    ASSERT_EQ(run(PREDICTIVE_BENCH,
                  "instructions --scenes dart:100 --warm-up 20 --ticks 20 --spaces simple --json " + file.quoted())
                  .status,
              0);
    EXPECT_GT(file.read()[0].at("notices"), 100 * 10) << "of all geoms, though one in twenty moves";
}

TEST(Callgrind, OtherPairsThanBeforeFail)
{
    const TemporaryFile before("callgrind_before");
    ASSERT_EQ(run(PREDICTIVE_BENCH, small_scene + " --json " + before.quoted()).status, 0);
    nlohmann::json records = before.read();
    records[0]["pair_hash"] = "0123456789abcdef";
    before.write(records);
    const Outcome outcome = run(PREDICTIVE_BENCH, small_scene + " --against " + before.quoted());
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "THE RUNS DISAGREE")) << outcome.output;
}

TEST(Callgrind, WithoutItThePackageIsNamed)
{
    const Outcome outcome =
        run("/usr/bin/env", std::string("PATH=/no/such/folder '") + PREDICTIVE_BENCH + "' " + small_scene);
    EXPECT_EQ(outcome.status, 2) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "valgrind was not found; Debian's package is named valgrind"))
        << outcome.output;
}

TEST(Callgrind, WhatIsNoSceneIsRefused)
{
    const Outcome outcome = run(PREDICTIVE_BENCH, "instructions --scenes soup");
    EXPECT_EQ(outcome.status, 2) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "this command has no scene named \"soup\"")) << outcome.output;
}
} // namespace
} // namespace ode_predictive_space::benchmarks
