#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "demos/haptic/options.h"
#include "demos/haptic/report.h"
#include "demos/worlds/spaces.h"
#include "ode_predictive_space/haptics/drivers.h"
#include "tests/support/program.h"
#include "tests/support/scratch.h"

namespace ode_predictive_space::demo
{
namespace
{
class ProbeRun : public testing::Test
{
protected:
    std::string file(const char *name) const { return folder_.path() + "/" + name; }

    nlohmann::json results(const std::string &options)
    {
        const Outcome outcome = run(HAPTIC_DEMO, "--headless --fast --json '" + file("results.json") + "' " + options);
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        return nlohmann::json::parse(std::ifstream(file("results.json")));
    }

    const ScratchFolder folder_;
};

TEST_F(ProbeRun, FeelsTheSameInEverySpace)
{
    const std::string options = "--objects 60 --seconds 1.2 --space ";
    const nlohmann::json predictive = results(options + "predictive-box").at("servo");
    EXPECT_GT(predictive.at("ticks_with_force").get<int>(), 0);
    for (const char *space : {"hash", "quadtree", "simple", "sap"})
    {
        // The sums differ in the last bits, as the order of touches depends on the space.
        const nlohmann::json force = results(options + space).at("servo");
        EXPECT_EQ(force.at("ticks_with_force"), predictive.at("ticks_with_force")) << space;
        EXPECT_NEAR(force.at("force_sum").get<double>(), predictive.at("force_sum").get<double>(), 1e-6) << space;
    }
}

TEST_F(ProbeRun, ReplaysTheForcesToTheLastBit)
{
    const std::string options = "--objects 60 --seconds 1.2 ";
    results(options + "--record '" + file("run.txt") + "'");
    const nlohmann::json replay = results(options + "--replay '" + file("run.txt") + "'").at("replay");
    EXPECT_EQ(replay.at("ticks"), 1200);
    EXPECT_EQ(replay.at("force_error").at("max"), 0.0);
}

TEST_F(ProbeRun, RunsInEverySceneThatItOffers)
{
    for (const std::string &scene : scenes_for_probes())
    {
        const nlohmann::json result = results("--scene " + scene + " --objects 30 --seconds 0.1");
        EXPECT_GE(result.at("loop").at("steps").get<int>(), 20) << scene;
        EXPECT_GE(result.at("loop").at("ticks").get<int>(), 90) << scene << ": the servo's, at 1 kHz";
        EXPECT_EQ(result.at("scene"), scene);
    }
}

TEST_F(ProbeRun, RefusesWhatContradictsItself)
{
    for (const char *options :
         {"--headless --screenshot a.png", "--screenshot a.png --seconds 0.5", "--replay a.txt --device virtual"})
        EXPECT_EQ(run(HAPTIC_DEMO, options).status, 2) << options;
}

TEST_F(ProbeRun, RefusesWhatItDoesNotKnow)
{
    for (const char *options :
         {"everything",      "--object 30",         "--objects",        "--objects many",
          "--objects 0",     "--objects=100001",    "--objects 2.5",    "--seed x",
          "--seconds 0.001", "--seconds -1",        "--rate 99",        "--law magnetism",
          "--scene",         "--space octree",      "--space hash,sap", "--space hash sap",
          "--compare",       "--headless 7 --fast", "--headless=maybe", "--headless --device sponge"})
    {
        const Outcome outcome = run(HAPTIC_DEMO, options);
        EXPECT_EQ(outcome.status, 2) << options;
        EXPECT_FALSE(outcome.output.empty()) << options;
    }
}

TEST_F(ProbeRun, PrintsNothingEmpty)
{
    for (const char *options : {"--help", "--device virtual --objects 60 --seconds 1.2 --fast",
                                "--device virtual --objects 1 --seconds 0.01 --fast"})
    {
        const Outcome outcome = run(HAPTIC_DEMO, std::string("--headless ") + options);
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        std::istringstream lines(outcome.output);
        for (std::string line; std::getline(lines, line);)
            EXPECT_FALSE(contains(line, "of 0 ") || contains(line, "in 0.00 %")) << line;
    }
}

double force_sum(double stiffness)
{
    const worlds::OdeSession ode;
    Options options;
    options.fast = true;
    options.seconds = 1.2;
    DemoDevice device(haptics::make_device("hand-path", options.seed)); // it moves whatever the force is
    RunControl control;
    const worlds::WorldFactory factory({options.scene, 60, options.seed, -1, false});
    HapticRun run(options, factory, device, control, [](const haptics::Notice &) {});
    return run.run([&] { control.stiffness = stiffness; }).servo.force_sum;
}

TEST(RunControl, StiffnessIsFeltWithoutARestart)
{
    EXPECT_GT(force_sum(100), 0);
    EXPECT_GT(force_sum(200), 1.5 * force_sum(100));
}

// Once, a stop by the guard was reported on standard error only.
TEST(Summary, TellsOfSafetyNotices)
{
    for (const std::uint64_t notices : {0, 1, 2})
    {
        RunResult result;
        result.safety_notices = notices;
        Options options;
        const std::string text = page_of(options, result).text;
        const std::string expected = std::to_string(notices) + (notices == 1 ? " notice that" : " notices that");
        EXPECT_EQ(contains(text, "Safety"), notices > 0) << text;
        EXPECT_EQ(contains(text, expected), notices > 0) << text;
    }
}

TEST_F(ProbeRun, NoticesAnUnwritableFileBeforeTheRun)
{
    const Outcome outcome = run(HAPTIC_DEMO, "--headless --json /no/such/folder/a.json --seconds 0.1");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.output,
              "predictive_haptic_demo: /no/such/folder/a.json cannot be written: No such file or directory\n");
}

TEST_F(ProbeRun, KeepsTheResultsOfAnEarlierRunWhenItFails)
{
    std::ofstream(file("results.json")) << "kept";
    EXPECT_EQ(run(HAPTIC_DEMO, "--replay /no/such/recording --headless --json '" + file("results.json") + "'").status,
              2);
    std::string text;
    std::ifstream(file("results.json")) >> text;
    EXPECT_EQ(text, "kept");
}

// Once, it ended with status 0, or 1 for the help.
TEST_F(ProbeRun, FailsWhenItsOutputCannotBeWritten)
{
    for (const char *arguments : {"--help", "--headless --fast --objects 5 --seconds 0.02"})
    {
        const Outcome outcome = run("sh", "-c '" HAPTIC_DEMO " " + std::string(arguments) + " 2>&1 >/dev/full'");
        EXPECT_EQ(outcome.status, 2) << arguments;
        EXPECT_TRUE(contains(outcome.output, "standard output cannot be written")) << outcome.output;
    }
}

TEST_F(ProbeRun, FailsWhenAFileOfResultsIsFull)
{
    for (const char *option : {"--json", "--record"})
    {
        const Outcome outcome =
            run(HAPTIC_DEMO, std::string(option) + " /dev/full --headless --fast --objects 5 --seconds 0.02");
        EXPECT_EQ(outcome.status, 2) << option;
        EXPECT_TRUE(contains(outcome.output, "/dev/full")) << outcome.output;
    }
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
} // namespace ode_predictive_space::demo
