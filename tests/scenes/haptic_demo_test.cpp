#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/program.h"
#include "tests/support/scratch.h"

namespace ode_predictive_space::worlds
{
namespace
{
TEST(HapticDemo, EndsWellAndSaysThatAllSpacesAgree)
{
    const Outcome outcome = run(HAPTIC_DEMO, "--compare --objects 40 --seconds 0.4");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "of 6 spaces, alternating")) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "the pairs of spaces that compare boxes were the same")) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "the pairs with contacts were the same")) << outcome.output;
    for (const char *name : {"predictive-box", "predictive-shape", "simple", "hash", "quadtree", "sap"})
        EXPECT_TRUE(contains(outcome.output, name)) << name << " is missing in\n" << outcome.output;
}

TEST(HapticDemo, FailsWhenTheSpacesDisagree)
{
    const Outcome outcome = run(HAPTIC_DEMO_THAT_LOSES_PAIRS, "--objects 40 --seconds 0.4 --space predictive,simple");
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "THE SPACES DISAGREE: in tick ")) << outcome.output;
}

TEST(HapticDemo, FailsWhenContactsAreLost)
{
    const std::string arguments = "--objects 100 --seconds 0.6 --space predictive-shape,predictive-sphere";
    const Outcome outcome = run(HAPTIC_DEMO_THAT_LOSES_PAIRS, arguments);
    EXPECT_EQ(outcome.status, 1) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "the pairs with contacts were not the same")) << outcome.output;
    const Outcome right = run(HAPTIC_DEMO, arguments);
    EXPECT_EQ(right.status, 0) << right.output;
}

TEST(HapticDemo, WritesItsResultsForOtherPrograms)
{
    const ScratchFile file;
    const Outcome outcome = run(HAPTIC_DEMO, "--objects 30 --seconds 0.2 --seed 7 --headless --space predictive,hash "
                                             "--json '" +
                                                 file.path() + "'");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    const nlohmann::json results = nlohmann::json::parse(file.text());

    EXPECT_TRUE(results.at("same_pairs").get<bool>());
    EXPECT_TRUE(results.at("same_contacts").get<bool>());
    ASSERT_EQ(results.at("spaces").size(), 2u);
    const nlohmann::json &predictive = results.at("spaces").at(0);
    const nlohmann::json &hash = results.at("spaces").at(1);
    EXPECT_EQ(predictive.at("space"), "predictive-box");
    EXPECT_EQ(hash.at("space"), "hash");
    EXPECT_EQ(predictive.at("pair_hash"), hash.at("pair_hash"));
    EXPECT_EQ(predictive.at("pairs"), hash.at("pairs"));
    EXPECT_EQ(predictive.at("contacts"), hash.at("contacts"));
    EXPECT_EQ(predictive.at("n"), 30);
    EXPECT_EQ(predictive.at("seed"), 7);
    EXPECT_EQ(predictive.at("ticks"), 200);
    EXPECT_GE(hash.at("mean_us").get<double>(), 0);
    EXPECT_LE(hash.at("median_us").get<double>(), hash.at("p99_us").get<double>());
    EXPECT_LE(hash.at("p99_us").get<double>(), hash.at("max_us").get<double>());
    EXPECT_FALSE(predictive.contains("gain_percent"));
    for (const auto &[gain, time] : {std::pair("gain_percent", "median_us"), {"tick_gain_percent", "tick_us"}})
    {
        const double ratio = predictive.at(time).get<double>() / hash.at(time).get<double>();
        EXPECT_NEAR(hash.at(gain).get<double>(), 100 * (1 - ratio), 1e-6) << "the paper's";
    }
}

// Once, it ended with status 0, or 1 for the help.
TEST(HapticDemo, FailsWhenItsOutputCannotBeWritten)
{
    for (const char *arguments :
         {"--help", "--compare --objects 5 --seconds 0.02", "--headless --fast --objects 5 --seconds 0.02"})
    {
        const Outcome outcome = run("sh", "-c '" HAPTIC_DEMO " " + std::string(arguments) + " 2>&1 >/dev/full'");
        EXPECT_EQ(outcome.status, 2) << arguments;
        EXPECT_TRUE(contains(outcome.output, "standard output cannot be written")) << outcome.output;
    }
}

TEST(HapticDemo, FailsWhenAFileOfResultsIsFull)
{
    const std::string shortly = " --objects 5 --seconds 0.02";
    for (const char *option : {"--compare --json", "--headless --fast --json", "--headless --fast --record"})
    {
        const Outcome outcome = run(HAPTIC_DEMO, std::string(option) + " /dev/full" + shortly);
        EXPECT_EQ(outcome.status, 2) << option;
        EXPECT_TRUE(contains(outcome.output, "/dev/full")) << outcome.output;
    }
}

TEST(HapticDemo, RunsInOneSpaceAlone)
{
    const Outcome outcome = run(HAPTIC_DEMO, "--compare --objects 20 --seconds 0.1 --space quadtree");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "quadtree")) << outcome.output;
}

TEST(BesideOde, ComparesMediansWithinEightyColumns)
{
    const Outcome outcome = run(BESIDE_ODE, "");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "medians")) << outcome.output;
    std::istringstream lines(outcome.output);
    for (std::string line; std::getline(lines, line);)
        EXPECT_LE(line.size(), 80u) << line;
}
} // namespace
} // namespace ode_predictive_space::worlds
