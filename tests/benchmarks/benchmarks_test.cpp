#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/program.h"
#include "tests/support/scratch.h"

namespace ode_predictive_space::benchmarks
{
namespace
{
std::string filtered(const std::string &pattern)
{
    return "--brief '--benchmark_filter=" + pattern + "'";
}

TEST(PredictiveBench, MeasuresEachKindInAllSpacesAndWritesWhatItFound)
{
    const ScratchFile file;
    const Outcome outcome = run(PREDICTIVE_BENCH, filtered("(gas|game_stepped|chain|spheres|rays|spot)/") +
                                                      " --benchmark_out=" + file.path());
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const nlohmann::json content = nlohmann::json::parse(file.text());
    std::map<std::string, std::string> hashes;
    std::map<std::string, int> kinds;
    for (const nlohmann::json &record : content.at("benchmarks"))
    {
        const std::string name = record.at("name"), row = name.substr(0, name.rfind('/', name.find("/iterations") - 1));
        ++kinds[name.substr(0, name.find('/'))];
        for (const char *time : {"real_time", "p50", "p99", "p99.9", "max"})
            EXPECT_GE(record.value(time, 0.0), 0) << name;
        if (record.contains("label"))
        {
            EXPECT_EQ(hashes.emplace(row, record.at("label")).first->second, record.at("label")) << name;
        }
    }
    for (const char *kind : {"collide", "tick", "contact", "query", "life"})
        EXPECT_GE(kinds[kind], 3) << kind;
    EXPECT_TRUE(content.at("context").contains("ode"));
}

TEST(PredictiveBench, AllSpacesAgreeInAllRows)
{
    const Outcome outcome = run(PREDICTIVE_BENCH, "--brief");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
}

TEST(PredictiveBench, FailsWhenASpaceLosesPairs)
{
    for (const char *pattern : {"collide/game/", "tick/floor/", "contact/pile/", "life/spot/"})
    {
        const Outcome outcome = run(BENCH_THAT_LOSES_PAIRS, filtered(pattern));
        EXPECT_EQ(outcome.status, 1) << pattern << outcome.output;
        EXPECT_TRUE(contains(outcome.output, "THE SPACES DISAGREE")) << outcome.output;
    }
    EXPECT_EQ(run(BENCH_THAT_LOSES_PAIRS, filtered("collide/game/.*/(simple|sap)")).status, 0);
}

TEST(PredictiveBench, RefusesWhatItCannotDo)
{
    for (const char *arguments : {"--nope", "soup", "--benchmark_filter=soup", "--brief --benchmark_filter=soup"})
        EXPECT_EQ(run(PREDICTIVE_BENCH, arguments).status, 2) << arguments;
    EXPECT_EQ(run(PREDICTIVE_BENCH, "--help").status, 0);
    const std::string command = std::string(PREDICTIVE_BENCH) + " " + filtered("collide/chain/");
    EXPECT_EQ(run("sh", "-c \"" + command + " > /dev/full\"").status, 2);
}

TEST(SmallPrograms, PrintAndWriteTheirFigures)
{
    const std::map<std::string, std::string> programs = {{BENCH_SERVO, "--n 40 --seconds 0.2"},
                                                         {BENCH_TABLE1, "--ticks 64"}};
    for (const auto &[program, arguments] : programs)
    {
        const ScratchFile file;
        const Outcome outcome = run(program, arguments + " --json " + file.path());
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_GE(nlohmann::json::parse(file.text()).size(), 10u) << program;
        EXPECT_EQ(run(program, "--nope").status, 2) << program;
        EXPECT_EQ(run(program, arguments + " --json /no/such/folder/results.json").status, 2) << program;
    }
}

TEST(RecordWorlds, WritesWhatCanBeReplayed)
{
    const ScratchFile file;
    const Outcome recorded = run(RECORD_WORLDS, "nested 4 --ticks 5 --output " + file.path());
    ASSERT_EQ(recorded.status, 0) << recorded.output;
    const nlohmann::json first_events = nlohmann::json::parse(recorded.output).at("first_events");
    EXPECT_EQ(first_events.size(), 6u);
    EXPECT_GE(first_events[5], 5);
    const Outcome replayed = run(TOOL, "replay --pairs --space box --space sap " + file.path());
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    for (const char *arguments : {"", "soup 4 --output x", "gas 0 --output x", "gas 4", "gas 4 --output /no/such/x"})
        EXPECT_EQ(run(RECORD_WORLDS, arguments).status, 2) << arguments;
}
} // namespace
} // namespace ode_predictive_space::benchmarks
