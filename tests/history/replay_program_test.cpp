// ode-predictive-replay, as a user calls it.

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <ode/common.h>

#include "tests/history/scratch_recording.h"
#include "tests/support/program.h"

namespace ode_predictive_space::history
{
namespace
{
const std::string nested = std::string(RECORDINGS) + "/nested.odehist";

int lines_of(const std::string &text)
{
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

TEST(ReplayProgram, ExplainsItself)
{
    const Outcome outcome = run(REPLAYER, "--help");
    EXPECT_EQ(outcome.status, 0);
    for (const char *word : {"--space", "--times", "--answer", "--seconds", "Exit status"})
        EXPECT_TRUE(contains(outcome.output, word)) << word;
    std::istringstream lines(outcome.output);
    for (std::string line; std::getline(lines, line);)
        EXPECT_LE(line.size(), 80u) << line;
    EXPECT_EQ(run(REPLAYER, "--version").status, 0);
}

TEST(ReplayProgram, RefusesWrongOptions)
{
    for (const char *arguments : {"", "--space octree x", "--seconds no x", "--seconds -1 x", "--speed x", "x y",
                                  "--space", "/nonexistent/file"})
    {
        const Outcome outcome = run(REPLAYER, arguments);
        EXPECT_EQ(outcome.status, 2) << arguments;
        EXPECT_EQ(lines_of(outcome.output), 1) << outcome.output;
    }
}

TEST(ReplayProgram, RefusesABrokenFileWithItsOffsetAndNothingElse)
{
    std::ifstream file(nested, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    for (const std::size_t size : {std::size_t{0}, std::size_t{20}, bytes.size() / 2, bytes.size() - 1})
    {
        const ScratchRecording broken;
        std::ofstream(broken.path(), std::ios::binary) << bytes.substr(0, size);
        const Outcome outcome = run(REPLAYER, broken.path());
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(lines_of(outcome.output), 1) << outcome.output;
        EXPECT_TRUE(contains(outcome.output, ": byte ")) << outcome.output;
    }
}

TEST(ReplayProgram, ComparesTheSpacesThatAreNamed)
{
    if (sizeof(dReal) == sizeof(float))
        return;
    const Outcome outcome = run(REPLAYER, "--times --space box --space hash " + nested);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "\nbox ")) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "\nhash ")) << outcome.output;
    EXPECT_FALSE(contains(outcome.output, "\nsap ")) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "the same")) << outcome.output;
}

TEST(ReplayProgram, AnswersWhatWouldBeGained)
{
    if (sizeof(dReal) == sizeof(float))
        return;
    const Outcome outcome = run(REPLAYER, "--answer " + nested);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    for (const char *line : {"answer\t", "\nrow\tspaces\t", "\nplot\tTime per collide", "\ncurve\t", "\nend\n"})
        EXPECT_TRUE(contains(outcome.output, line)) << line << outcome.output;
}
} // namespace
} // namespace ode_predictive_space::history
