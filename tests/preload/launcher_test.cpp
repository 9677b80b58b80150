#include "tests/preload/preload_programs.h"

namespace ode_predictive_space::preload
{
namespace
{
TEST(Launcher, ExplainsItself)
{
    const Outcome outcome = launch("--help");
    EXPECT_EQ(outcome.status, 0);
    for (const char *word : {"--space", "--proximity", "--stats", "--trace", "--report", "--record", "--record-limit",
                             "ODE_PREDICTIVE_SPACE"})
        EXPECT_TRUE(contains(outcome.output, word)) << word;
    EXPECT_EQ(run(TOOL, "run --help").output, outcome.output) << "a link is a call of the command";
    for (const char *command : {"run", "replay", "report"})
        EXPECT_TRUE(contains(run(TOOL, "--help").output, command)) << command;
}

TEST(Launcher, RefusesWrongOptions)
{
    for (const char *arguments :
         {"--space hsah true", "--space= true", "--proximity cube true", "--trace", "--speed true", "--space all", "",
          "--report= true", "--report /proc/no_folder true", "--report /dev/null true",
          "--stats=/nonexistent/file true", "--trace=/nonexistent/file true", "--record", "--record= true",
          "--record /nonexistent/file true", "--record /dev/null true", "--record-limit 0 true",
          "--record-limit 10X true", "--record-limit -1 true"})
    {
        const Outcome outcome = launch(arguments);
        EXPECT_EQ(outcome.status, 2) << arguments;
        EXPECT_EQ(count_of("\n", outcome.output), 1) << outcome.output;
    }
}

TEST(Launcher, RefusesAnUnknownCommand)
{
    const Outcome outcome = run(TOOL, "replya file");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.output, "ode-predictive: there is no command replya; the commands are run, replay and report\n");
}

// A page said that the program had not collided.
TEST(Launcher, RefusesAReportOnAMissingRecording)
{
    const ScratchFolder folder;
    const Outcome outcome = run(TOOL, "report /nonexistent/file " + folder.path());
    EXPECT_EQ(outcome.status, 2);
    EXPECT_TRUE(contains(outcome.output, "/nonexistent/file")) << outcome.output;
    EXPECT_FALSE(std::ifstream(folder.path() + "/index.html"));
}

// Once, the report was written without a message.
TEST(Launcher, SaysWhereTheReportIs)
{
    const ScratchFolder folder;
    const Outcome outcome = launch("--report " + folder.path() + " " LINKED);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(count_of("ode_predictive_space: report: " + folder.path() + "/index.html\n", outcome.output), 1)
        << outcome.output;
    EXPECT_TRUE(std::ifstream(folder.path() + "/recording.odehist")) << "what it rests on";
}

// Once, this was only on the page.
TEST(Launcher, SaysThatAReportHasNothingToReportOn)
{
    const ScratchFolder folder;
    const Outcome outcome = launch("--report " + folder.path() + " true");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(count_of("nothing was recorded: no call of dSpaceCollide() was seen; ", outcome.output), 1)
        << outcome.output;
}

TEST(Launcher, LeavesFilesToThePrograms)
{
    const ScratchFile place;
    const std::string file = place.path() + ".new";
    EXPECT_EQ(launch("--stats=" + file + " --trace=" + file + " true").status, 0);
    EXPECT_FALSE(std::ifstream(file)) << "nothing was written to it";
}

TEST(Launcher, PassesArgumentsAndStatusOn)
{
    const Outcome outcome = launch("--space all -- sh -c 'echo \"$1|$2\"; exit 9' sh 'a b' --stats");
    EXPECT_EQ(outcome.output, "a b|--stats\n");
    EXPECT_EQ(outcome.status, 9);
    EXPECT_EQ(launch("sh -c 'echo \"$1|$2\"' sh -- b").output, "--|b\n") << "the program's own mark";
    EXPECT_EQ(launch("/nonexistent/program").status, 127);
}

TEST(Launcher, SetsTheVariables)
{
    const Outcome outcome = launch("--space=hash,sap --proximity=sphere --stats --trace=t env");
    for (const char *line : {"ODE_PREDICTIVE_SPACE=hash,sap\n", "ODE_PREDICTIVE_PROXIMITY=sphere\n",
                             "ODE_PREDICTIVE_STATS=1\n", "LD_PRELOAD=" PRELOAD "\n"})
        EXPECT_TRUE(contains(outcome.output, line)) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "ODE_PREDICTIVE_TRACE=/")) << outcome.output;
}

// Once, our library came before libraries that must be first.
TEST(Launcher, LeavesOtherPreloadsInFront)
{
    allow_preload();
    const Outcome outcome = run("env", "LD_PRELOAD=" ODE_LIBRARY " " LAUNCHER " env");
    EXPECT_TRUE(contains(outcome.output, "\nLD_PRELOAD=" ODE_LIBRARY ":" PRELOAD "\n")) << outcome.output;
}

TEST(Launcher, PrintsNamesWithoutControlCharacters)
{
    const Outcome missing = launch("\"$(printf '/nonexistent/\\033[31m')\"");
    EXPECT_EQ(missing.output, "ode-predictive: /nonexistent/\\x1b[31m cannot be started: No such file or directory\n");
    const Outcome refused = launch("--space \"$(printf 'x\\033[31m')\" true");
    EXPECT_TRUE(contains(refused.output, "'x\\x1b[31m'")) << refused.output;
    const ScratchFile place;
    const std::string name = place.path() + "\x1b[31m";
    ASSERT_EQ(symlink(LINKED, name.c_str()), 0);
    const Outcome named = launch("--stats '" + name + "'");
    EXPECT_TRUE(contains(named.output, "\\x1b[31m (process ")) << named.output;
    EXPECT_FALSE(contains(named.output, "\x1b")) << named.output;
    unlink(name.c_str());
}

// Without the launcher, variables may hold anything.
TEST(Variables, UnknownValuesAreNamedAndDefaultsTaken)
{
    const Outcome outcome =
        run_preloaded("ODE_PREDICTIVE_SPACE=hash,octree ODE_PREDICTIVE_PROXIMITY=cube ODE_PREDICTIVE_STATS=1 " LINKED);
    EXPECT_EQ(outcome.status, 0);
    for (const char *word : {"'octree'", "'cube'"})
        EXPECT_EQ(count_of(word, outcome.output), 1) << outcome.output;
    EXPECT_EQ(count_of("predictive by boxes", outcome.output), 15) << outcome.output;
}

TEST(Variables, FilesThatCannotBeWrittenAreNamed)
{
    const Outcome outcome =
        run_preloaded("ODE_PREDICTIVE_STATS=/nonexistent/said ODE_PREDICTIVE_RECORD=/nonexistent/file " LINKED);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(contains(outcome.output, "/nonexistent/said cannot be written")) << outcome.output;
    EXPECT_EQ(count_of("/nonexistent/file cannot be written", outcome.output), 1) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "predictive by boxes")) << outcome.output;
}
} // namespace
} // namespace ode_predictive_space::preload
