#include <csignal>
#include <utility>
#include <vector>

#include <pty.h>
#include <sys/wait.h>

#include "tests/preload/preload_programs.h"

namespace ode_predictive_space::preload
{
namespace
{
int raw_status(const std::string &command)
{
    allow_preload();
    return std::system(("ulimit -c 0; exec " + command + " >/dev/null 2>&1").c_str());
}

/// A program that waits for signals, under the launcher in a terminal. An alarm ends a test that hangs.
class Waiting
{
public:
    explicit Waiting(const std::string &report)
    {
        alarm(300);
        allow_preload();
        launcher_ = forkpty(&output_, nullptr, nullptr, nullptr);
        if (launcher_ == 0)
        {
            execl(LAUNCHER, LAUNCHER, "--report", report.c_str(), ENDING, "wait", nullptr);
            _exit(126);
        }
        line(); // the program has begun to wait
    }

    ~Waiting()
    {
        kill(launcher_, SIGKILL);
        waitpid(launcher_, nullptr, 0);
        close(output_);
        alarm(0);
    }

    Waiting(const Waiting &) = delete;
    Waiting &operator=(const Waiting &) = delete;

    /// The next line of the program; empty when it has ended. A terminal shows ^C and uses other line ends.
    std::string line()
    {
        std::string text;
        for (char letter; read(output_, &letter, 1) == 1 && letter != '\n';)
            if (letter != '\r')
                text += letter;
        return text.substr(0, 2) == "^C" ? text.substr(2) : text;
    }

    void press(char key) { EXPECT_EQ(write(output_, &key, 1), 1); }

    void signal(int number) { EXPECT_EQ(kill(launcher_, number), 0); }

    int wait(int options = 0)
    {
        int status = 0;
        EXPECT_EQ(waitpid(launcher_, &status, options), launcher_);
        return status;
    }

private:
    int output_ = -1;
    pid_t launcher_ = -1;
};

struct EndOfAProgram : testing::TestWithParam<const char *>
{};

// A process that a signal or _exit() ends cannot write its statistics.
TEST_P(EndOfAProgram, LeavesItsTraceAndWhereItCanItsStatistics)
{
    const ScratchFile statistics, trace;
    const std::string program = std::string(ENDING " ") + GetParam();
    const std::string options = " --stats=" + statistics.path() + " --trace=" + trace.path() + " ";
    EXPECT_EQ(raw_status(LAUNCHER + options + program), raw_status(program));
    EXPECT_EQ(count_of("dSpaceCollide space 1 geoms 2 pairs 1 hash ", trace.text()), 3) << trace.text();
    const bool can_write = GetParam() == std::string("return") || GetParam() == std::string("exit");
    const std::string said = statistics.text();
    EXPECT_EQ(count_of("preload_ending (process ", said), can_write) << said;
    EXPECT_EQ(count_of("hash, predictive by boxes; at most 2 geoms, 3 pairs; dSpaceCollide 3 calls", said), can_write)
        << said;
    EXPECT_EQ(count_of("    ticks 3,", said), can_write) << said;
}

INSTANTIATE_TEST_SUITE_P(Ways, EndOfAProgram,
                         testing::Values("return", "exit", "_exit", "abort", "crash", "2", "9", "15"));

TEST_P(EndOfAProgram, LeavesAPageWithPlots)
{
    const ScratchFolder folder;
    const std::string program = std::string(ENDING " ") + GetParam();
    EXPECT_EQ(raw_status(LAUNCHER " --report " + folder.path() + " " + program), raw_status(program));
    std::ostringstream page;
    page << std::ifstream(folder.path() + "/index.html").rdbuf();
    constexpr int of_the_run = 1, of_its_replay_in_three_spaces = 3;
    EXPECT_EQ(count_of("<polyline", page.str()), of_the_run + of_its_replay_in_three_spaces) << page.str();
    EXPECT_TRUE(contains(page.str(), "<title>ode-predictive run " + program + "</title>")) << page.str();
}

// A terminal sends ^C to both. The launcher is stopped meanwhile, as two signals at the same time would count as one.
TEST(LauncherThatWaits, PassesASignalOnAndLeavesControlCToTheProgram)
{
    const ScratchFolder report;
    Waiting waiting(report.path());
    waiting.signal(SIGUSR1);
    EXPECT_EQ(waiting.line(), "counted");
    waiting.signal(SIGSTOP);
    EXPECT_TRUE(WIFSTOPPED(waiting.wait(WUNTRACED)));
    waiting.press('\003');
    EXPECT_EQ(waiting.line(), "counted");
    waiting.signal(SIGCONT);
    waiting.signal(SIGTERM);
    const int status = waiting.wait();
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 2) << "each was counted once";
}

// The output of a program whose parent ignored SIGCHLD, which is inherited.
std::string output_after_ignoring_children(std::vector<const char *> command)
{
    allow_preload();
    command.push_back(nullptr);
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0)
    {
        std::signal(SIGCHLD, SIG_IGN);
        dup2(ends[1], STDOUT_FILENO);
        dup2(ends[1], STDERR_FILENO);
        close(ends[1]);
        execvp(command[0], const_cast<char **>(command.data()));
        _exit(126);
    }
    close(ends[1]);
    std::string text;
    for (char letter; read(ends[0], &letter, 1) == 1;)
        text += letter;
    close(ends[0]);
    waitpid(child, nullptr, 0);
    return text;
}

TEST(LauncherThatWaits, SeesTheEndOfAProgramAlsoWhereSuchEndsAreIgnored)
{
    const ScratchFolder report;
    const std::string said =
        output_after_ignoring_children({LAUNCHER, "--report", report.path().c_str(), ENDING, "exit"});
    EXPECT_TRUE(contains(said, "report: ")) << said;
}

TEST(LauncherThatWaits, LeavesTheSignalsOfItsParentToTheProgram)
{
    const std::vector<const char *> program = {"grep", "Sig[BI]", "/proc/self/status"};
    const std::string native = output_after_ignoring_children(program);
    const std::size_t at = native.find("SigIgn:\t");
    ASSERT_NE(at, std::string::npos) << native;
    EXPECT_TRUE(std::stoull(native.substr(at + 8), nullptr, 16) >> (SIGCHLD - 1) & 1) << native;
    const ScratchFolder report;
    std::vector<const char *> launched = {LAUNCHER, "--report", report.path().c_str()};
    launched.insert(launched.end(), program.begin(), program.end());
    const std::string said = output_after_ignoring_children(launched);
    EXPECT_EQ(said.substr(0, native.size()), native) << said;
}

// Once, an ignored signal, as by nohup, ended the launcher while it wrote the report after the program's end.
TEST(LauncherThatWaits, StillIgnoresAfterwardsWhatItsParentIgnored)
{
    allow_preload();
    const ScratchFolder report;
    const Outcome outcome =
        run("sh", "-c 'trap \"\" HUP; exec " LAUNCHER " --report " + report.path() +
                      " sh -c \"" ENDING
                      " return; for i in 1 2 3 4 5 6 7 8 9 10; do kill -HUP \\$PPID; sleep 0.1; done &\"'");
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(count_of("report: ", outcome.output), 1) << outcome.output;
}

TEST(Statistics, AreBoundedAndCompleteForAnyNumberOfSpaces)
{
    const ScratchFile statistics;
    EXPECT_EQ(launch("--stats=" + statistics.path() + " " ENDING " many").status, 0);
    const std::string said = statistics.text();
    EXPECT_EQ(count_of("\n  space ", said), 1000);
    EXPECT_EQ(count_of("\n  space 1: hash, predictive by boxes; at most 2 geoms, 3 pairs; dSpaceCollide 3 calls", said),
              1);
    EXPECT_EQ(count_of("\n  space 1000 and later ones: hash, predictive by boxes; at most 0 geoms, 0 pairs; "
                       "dSpaceCollide 101 calls",
                       said),
              1);
}
} // namespace
} // namespace ode_predictive_space::preload
