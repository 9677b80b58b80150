// predictive_bench as a user meets it: exit status, output, result file.

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include "demos/runs/narrow_output.h"
#include "tests/support/program.h"

namespace ode_predictive_space::benchmarks
{
namespace
{
nlohmann::json results_of(const std::string &arguments)
{
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() /
        ("predictive_bench_test_" + std::to_string(std::hash<std::string>()(arguments)) + ".json");
    const Outcome outcome = run(PREDICTIVE_BENCH, arguments + " --json '" + file.string() + "'");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    nlohmann::json results = nlohmann::json::parse(std::ifstream(file));
    std::filesystem::remove(file);
    return results;
}

// With standard output it ended with status 0.
TEST(PredictiveBench, FailsWhenItsOutputCannotBeWritten)
{
    const std::string command = PREDICTIVE_BENCH " scene gas --n 10 --ticks 10";
    const Outcome outcome = run("sh", "-c '" + command + " 2>&1 >/dev/full'");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.output, "predictive_bench: standard output cannot be written\n");
    EXPECT_EQ(run("sh", "-c '" + command + " --json /dev/full'").status, 2);
}

TEST(PredictiveBench, WritesARecordPerContender)
{
    const nlohmann::json records = results_of("scene gas --n 40 --ticks 128 --seed 5 --spaces predictive,hash,sweep");
    ASSERT_EQ(records.size(), 3u);
    for (const nlohmann::json &record : records)
    {
        EXPECT_EQ(record.at("scene"), "gas");
        EXPECT_EQ(record.at("n"), 40);
        EXPECT_EQ(record.at("seed"), 5);
        EXPECT_GE(record.at("ticks"), 128);
        EXPECT_EQ(record.at("pair_hash"), records[0].at("pair_hash"));
        EXPECT_EQ(record.at("pairs"), records[0].at("pairs"));
        for (const char *name :
             {"mean_us", "median_us", "p99_us", "p999_us", "max_us", "bytes_per_geom", "false_pairs", "contacts"})
        {
            EXPECT_TRUE(record.contains(name)) << name;
        }
    }
    EXPECT_EQ(records[0].at("space"), "predictive-box");
    EXPECT_GT(records[0].at("bytes_per_geom").get<double>(), 0);
    EXPECT_TRUE(records[1].at("bytes_per_geom").is_null());
}

TEST(PredictiveBench, WritesARecordPerSpaceAtALimit)
{
    const nlohmann::json records = results_of("limits --scenes spot:20,shuffled:30 --ticks 2 --quick");
    ASSERT_EQ(records.size(), 4u);
    EXPECT_EQ(records[0].at("space"), "predictive-box");
    EXPECT_EQ(records[1].at("space"), "sap");
    for (const nlohmann::json &record : records)
    {
        EXPECT_EQ(record.at("table"), "limits");
        for (const char *name : {"fill_ms", "first_ms", "collide_ms", "empty_ms", "sap_ratio_collide"})
        {
            EXPECT_GE(record.at(name).get<double>(), 0) << name;
        }
    }
    EXPECT_EQ(records[0].at("n"), 20);
    EXPECT_EQ(records[0].at("pairs"), 20 * 19 / 2);
    EXPECT_EQ(records[0].at("pair_hash"), records[1].at("pair_hash"));
    EXPECT_EQ(records[2].at("scene"), "shuffled");
    EXPECT_TRUE(
        results_of("limits --scenes spot:20 --ticks 2 --quick --spaces simple")[0].at("sap_ratio_empty").is_null());
}

TEST(PredictiveBench, FailsWhenASpaceLosesPairs)
{
    const std::string arguments = "scene game --n 40 --ticks 300 --spaces ";
    const Outcome outcome = run(BENCH_THAT_LOSES_PAIRS, arguments + "predictive,simple");
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "THE CONTENDERS DISAGREE: from tick ")) << outcome.output;
    EXPECT_EQ(run(BENCH_THAT_LOSES_PAIRS, arguments + "simple,sap").status, 0);
    const Outcome first_ticks = run(BENCH_THAT_LOSES_PAIRS, "sudden --n 100 --quick --ticks 5");
    EXPECT_EQ(first_ticks.status, 1) << first_ticks.output;
    EXPECT_TRUE(contains(first_ticks.output, "in the first tick ")) << first_ticks.output;
}

TEST(PredictiveBench, ShowsThePapersTableInFourBlocks)
{
    const nlohmann::json records = results_of("table1 --ticks 64");
    std::map<std::string, int> cells;
    int requirements = 0;
    for (const nlohmann::json &record : records)
    {
        cells[record.value("block", "")] += record.contains("gain_percent") ? 1 : 0;
        requirements += record.value("line", "") == "P1" ? 1 : 0;
    }
    for (const char *block : {"broad phase", "broad and narrow phase", "whole tick", "by the clock"})
    {
        EXPECT_EQ(cells[block], 20) << block;
    }
    EXPECT_EQ(requirements, 20);
}

TEST(PredictiveBench, TellsTheWorstTicksAndTheFloor)
{
    const Outcome tail = run(PREDICTIVE_BENCH, "tail --n 300 --ticks 200");
    EXPECT_EQ(tail.status, 0) << tail.output;
    EXPECT_TRUE(contains(tail.output, "P9  gas 300, p99.9 over the median  ")) << tail.output;
    EXPECT_TRUE(contains(tail.output, "P9  gas 300, maximum over the median, of each tick the shortest of"))
        << tail.output;
    EXPECT_TRUE(contains(tail.output, "\nfloor\n")) << "its histogram: " << tail.output;
    const Outcome floor = run(PREDICTIVE_BENCH, "floor --n 300 --ticks 200");
    EXPECT_EQ(floor.status, 0) << floor.output;
    EXPECT_TRUE(contains(floor.output, "P11  gas 300")) << floor.output;
}

TEST(PredictiveBench, ShowsHowCostsGrow)
{
    const Outcome outcome = run(PREDICTIVE_BENCH, "scale --n 1000 --ticks 64 --spaces predictive,sap,sweep");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "game: nanoseconds per moved geom")) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "1,000 (50 % moving)")) << outcome.output;
}

TEST(PredictiveBench, ComparesTheScenesOfOneSize)
{
    const Outcome outcome = run(PREDICTIVE_BENCH, "ratios --n 100 --ticks 64 --check");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "P2  gas 100, best ODE (")) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "P3  game 100, best ODE (")) << outcome.output;
}

TEST(PredictiveBench, StepsEverySceneInAllSpaces)
{
    const nlohmann::json records = results_of("stepped --n 100 --ticks 120 --check");
    std::map<std::string, std::string> hashes;
    ASSERT_GT(records.size(), 0u);
    for (const nlohmann::json &record : records)
    {
        EXPECT_EQ(record.at("measured_ticks"), 120);
        EXPECT_TRUE(record.at("begin_s").is_null());
        for (const char *name : {"mean_us", "median_us", "p99_us", "p999_us", "max_us", "whole_us"})
        {
            EXPECT_GE(record.at(name), 0) << name;
        }
        if (record.at("space") != "predictive-sphere")
        {
            const std::string hash = record.at("pair_hash");
            EXPECT_EQ(hashes.emplace(record.at("scene"), hash).first->second, hash) << record;
        }
    }
    EXPECT_EQ(hashes.size(), 3u) << "gas, game and pile have this size";
    EXPECT_EQ(records.size(), hashes.size() * 6);
}

TEST(PredictiveBench, FindsTheSameContactsInEverySpace)
{
    const nlohmann::json records =
        results_of("contact --scenes mix:40,classes:60,pile:40,terrain:40 --ticks 130 --check");
    std::map<std::string, std::vector<nlohmann::json>> scenes;
    for (const nlohmann::json &record : records)
    {
        if (record.value("table", "") == "contact")
        {
            scenes[record.at("scene")].push_back(record);
        }
    }
    ASSERT_EQ(scenes.size(), 4u);
    for (const auto &[scene, spaces] : scenes)
    {
        ASSERT_EQ(spaces.size(), 7u) << scene;
        for (const nlohmann::json &record : spaces)
        {
            EXPECT_EQ(record.at("in_batches"), scene == "mix");
            EXPECT_EQ(record.at("touching_hash"), spaces[0].at("touching_hash")) << record;
            EXPECT_EQ(record.at("touching_per_tick"), spaces[0].at("touching_per_tick")) << record;
            EXPECT_GE(record.at("calls_per_tick"), record.at("touching_per_tick")) << record;
            const double sum = record.at("sum_us"); // a mean of sums beside a sum of means: rounded in other places
            EXPECT_NEAR(record.at("collide_us").get<double>() + record.at("dcollide_us").get<double>(), sum,
                        1e-9 * sum);
            EXPECT_GE(record.at("whole_us"), 0);
        }
        EXPECT_EQ(spaces[0].at("space"), "predictive-box");
        EXPECT_EQ(spaces[2].at("space"), "predictive-shape");
        EXPECT_EQ(spaces[3].at("calls_per_tick"), spaces[0].at("calls_per_tick")) << "simple reports what boxes report";
        EXPECT_LT(spaces[2].at("calls_per_tick"), spaces[0].at("calls_per_tick")) << scene;
        EXPECT_EQ(spaces[0].at("box_ratio"), 1);
        EXPECT_GT(spaces[0].at("touching_per_tick"), 0) << scene;
    }
}

TEST(PredictiveBench, ContactsAreOfTheChosenSpaces)
{
    const nlohmann::json records =
        results_of("contact --scenes game:60 --ticks 50 --spaces predictive,sweep,brute,floor");
    ASSERT_EQ(records.size(), 2u);
    EXPECT_EQ(records[1].at("space"), "sweep");
    EXPECT_TRUE(records[0].at("best_ode_ratio").is_null()) << "none of ODE's took part";
    EXPECT_EQ(records[0].at("measured_ticks"), 50);
}

TEST(PredictiveBench, FailsWhenASpaceLosesContacts)
{
    const std::string arguments = "contact --scenes pile:40 --ticks 100 --spaces ";
    const Outcome outcome = run(BENCH_THAT_LOSES_PAIRS, arguments + "predictive-shape,simple");
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "on they did not all report the same pairs with contacts")) << outcome.output;
    EXPECT_EQ(run(BENCH_THAT_LOSES_PAIRS, arguments + "simple,sap").status, 0);
}

TEST(PredictiveBench, ShowsThePapersTableForContacts)
{
    const nlohmann::json records = results_of("contact --table1 --ticks 64");
    std::map<std::string, int> cells;
    int lines = 0;
    for (const nlohmann::json &record : records)
    {
        cells[record.value("block", "")] += record.value("ours", "") == "predictive-shape" ? 1 : 0;
        lines += record.value("line", "") == "P16" ? 1 : 0;
    }
    EXPECT_EQ(cells["broad and narrow phase"], 20);
    EXPECT_EQ(cells["whole tick"], 20);
    EXPECT_EQ(lines, 2);
}

std::map<std::string, int> requirements_in(const std::string &arguments)
{
    std::map<std::string, int> lines;
    for (const nlohmann::json &record : results_of(arguments))
    {
        lines[record.value("line", "")] += record.contains("limit") ? 1 : 0;
    }
    return lines;
}

TEST(PredictiveBench, AsksForContactsOnlyInTheScenesThatItHas)
{
    const std::string arguments = "contact --ticks 20 --spaces predictive-box,predictive-shape,sap --scenes ";
    std::map<std::string, int> lines = requirements_in(arguments + "stack,mix:100");
    EXPECT_EQ(lines["P18"], 1) << "mix 100 against the best ODE space";
    EXPECT_EQ(lines["P19"], 2) << "time and calls in stack against boxes";
    lines = requirements_in(arguments + "mix:101,stack:20,dart:20");
    EXPECT_EQ(lines.count("P18") + lines.count("P19") + lines.count("P22"), 0u);
    EXPECT_EQ(requirements_in(arguments + "dart:1000")["P22"], 1);
}

TEST(PredictiveBench, ShowsHowAPileSettlesInWindows)
{
    const nlohmann::json records = results_of("stepped --scenes settling:40 --ticks 200 --spaces predictive,sap");
    ASSERT_EQ(records.size(), 4u);
    EXPECT_EQ(records[0].at("begin_s"), 0);
    EXPECT_EQ(records[0].at("end_s"), 0.5);
    EXPECT_EQ(records[3].at("begin_s"), 0.5);
    EXPECT_EQ(records[3].at("end_s"), 1);
    EXPECT_EQ(records[3].at("measured_ticks"), 100);
    EXPECT_EQ(records[3].at("space"), "sap");
}

TEST(PredictiveBench, StepsWorldsInAllSpacesByAllMeasures)
{
    const nlohmann::json records = results_of("worlds --scenes chain,nested:3 --ticks 40 --check");
    ASSERT_EQ(records.size(), 2u * 7 + 1);
    for (std::size_t i = 0; i < 14; ++i)
    {
        const nlohmann::json &record = records[i];
        EXPECT_EQ(record.at("table"), "worlds");
        EXPECT_EQ(record.at("measured_ticks"), 40);
        EXPECT_GT(record.at("pairs"), 0) << record;
        EXPECT_EQ(record.at("contacts"), records[i / 7 * 7].at("contacts")) << record;
    }
    EXPECT_EQ(records.back().at("scene"), "all");
    EXPECT_GT(records.back().at("best_ode_ratio"), 0);
}

TEST(PredictiveBench, ShowsAHeapAsAWholeAndInWindows)
{
    const nlohmann::json records = results_of("worlds --scenes heap:20 --ticks 200 --spaces predictive");
    ASSERT_EQ(records.size(), 3u);
    EXPECT_TRUE(records[0].at("end_s").is_null());
    EXPECT_EQ(records[0].at("measured_ticks"), 200);
    EXPECT_EQ(records[1].at("begin_s"), 0);
    EXPECT_EQ(records[2].at("end_s"), 1);
    EXPECT_EQ(records[2].at("measured_ticks"), 100);
}

TEST(PredictiveBench, NoticesLostPairsInAWorld)
{
    const Outcome outcome = run(BENCH_THAT_LOSES_PAIRS, "worlds --scenes floor:20 --ticks 200 --spaces predictive,sap");
    EXPECT_EQ(outcome.status, 1) << outcome.output;
}

TEST(PredictiveBench, JudgesQueriesByTheLimitsOfTheirNumberOfObjects)
{
    const auto limits_with = [](const char *objects) {
        std::vector<double> limits;
        for (const nlohmann::json &record : results_of(std::string("query --ticks 3 --n ") + objects))
        {
            if (record.value("line", "") == "P7")
            {
                limits.push_back(record.at("limit"));
            }
        }
        return limits;
    };
    EXPECT_EQ(limits_with("1000"), (std::vector<double>{1, 5, 1, 5}));
    EXPECT_TRUE(limits_with("40").empty()) << "nothing is asked for";
}

TEST(PredictiveBench, PrintsWithinEightyColumns)
{
    for (const char *arguments :
         {"--help", "contact --help", "scene gas --n 40 --ticks 64", "contact --scenes mix:40 --ticks 40",
          "limits --scenes spot:20 --ticks 2 --quick", "table1 --ticks 2", "sudden --n 40 --quick --ticks 2",
          "query --n 1000 --ticks 3", "tail --n 40 --ticks 4", "whole --n 40 --ticks 10", "stepped --n 100 --ticks 10",
          "worlds --help", "instructions --help", "worlds --scenes chain --ticks 5", "memory --n 40 --ticks 20 --quick",
          "scale --n 100 --ticks 4 --spaces predictive,sap"})
    {
        std::istringstream lines(run(PREDICTIVE_BENCH, arguments).output);
        for (std::string line; std::getline(lines, line);)
        {
            line.erase(0, line.rfind('\r') + 1);
            EXPECT_LE(worlds::width(line), worlds::output_width) << arguments << ": " << line;
        }
    }
}

TEST(PredictiveBench, RefusesWhatItCannotDo)
{
    for (const char *arguments : {"", "soup", "--nope", "scene soup", "scene gas --n 0", "scene gas --spaces octree",
                                  "worlds --scenes soup", "worlds --scenes floor:0", "worlds --spaces octree"})
    {
        EXPECT_EQ(run(PREDICTIVE_BENCH, arguments).status, 2) << arguments;
    }
    EXPECT_EQ(run(PREDICTIVE_BENCH, "scene --help").status, 0);
    const Outcome outcome = run(PREDICTIVE_BENCH, "scene still --n 5 --ticks 64 --json /no/such/folder/results.json");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.output, "predictive_bench: cannot write /no/such/folder/results.json\n") << "before it measures";
}
} // namespace
} // namespace ode_predictive_space::benchmarks
