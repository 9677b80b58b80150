// What remains of a program, however it ends, and that its end is passed on.

#include <csignal>
#include <utility>
#include <vector>

#include <pty.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "tests/preload/preload_programs.h"

namespace ode_predictive_space::preload
{
namespace
{
// The status that its parent sees, as from waitpid().
int raw_status(const std::string &command)
{
    allow_preload();
    return std::system(("ulimit -c 0; exec " + command + " >/dev/null 2>&1").c_str());
}

/// A program under the launcher that waits for signals. A test that does not end is ended.
class Waiting
{
public:
    enum class Output
    {
        pipe,
        terminal
    };

    explicit Waiting(const std::string &statistics, Output output = Output::pipe)
    {
        alarm(300);
        allow_preload();
        launcher_ = output == Output::terminal ? forkpty(&output_, nullptr, nullptr, nullptr) : fork_with_pipe();
        if (launcher_ == 0)
        {
            execl(LAUNCHER, LAUNCHER, ("--stats=" + statistics).c_str(), ENDING, "wait", nullptr);
            _exit(126);
        }
        program_ = std::atoi(line().c_str());
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

    pid_t launcher() const { return launcher_; }
    pid_t program() const { return program_; }

    /// What the program says next; empty when it has ended. A terminal shows ^C and ends lines in its own way.
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
    pid_t fork_with_pipe()
    {
        int ends[2];
        EXPECT_EQ(pipe(ends), 0);
        const pid_t child = fork();
        if (child == 0)
            dup2(ends[1], STDOUT_FILENO);
        if (child == 0)
            close(ends[0]);
        close(ends[1]);
        output_ = ends[0];
        return child;
    }

    int output_ = -1;
    pid_t launcher_ = -1, program_ = -1;
};

/// A named pipe.
class Fifo
{
public:
    Fifo()
    {
        unlink(place_.path().c_str());
        EXPECT_EQ(mkfifo(path().c_str(), 0600), 0);
    }

    const std::string &path() const { return place_.path(); }

private:
    ScratchFile place_;
};

struct EndOfAProgram : testing::TestWithParam<const char *>
{};

// Those that the process itself can write are written; of the others a line says how to keep what they did.
TEST_P(EndOfAProgram, LeavesItsTraceAndStatisticsOrAWordAboutThem)
{
    const ScratchFile statistics, trace;
    const std::string program = std::string(ENDING " ") + GetParam();
    const std::string options = " --compare --stats=" + statistics.path() + " --trace=" + trace.path() + " ";
    EXPECT_EQ(raw_status(LAUNCHER + options + program), raw_status(program));
    EXPECT_EQ(count_of("dSpaceCollide space 1 geoms 2 pairs 1 hash ", trace.text()), 3) << trace.text();
    const bool can_write = GetParam() == std::string("return") || GetParam() == std::string("exit");
    const std::string said = statistics.text();
    EXPECT_EQ(count_of("preload_ending (process ", said), can_write) << said;
    EXPECT_EQ(count_of("hash, predictive by boxes; at most 2 geoms, 3 pairs; dSpaceCollide 3 calls", said), can_write)
        << said;
    EXPECT_EQ(count_of("    ticks 3,", said), can_write) << said;
    EXPECT_EQ(count_of("  compared with all pairs: 3 collides, 0 differences\n", said), can_write) << said;
    const std::string warned = launch("--stats=/dev/null " + program).output;
    EXPECT_EQ(count_of("1 of 1 processes with ODE wrote no statistics: ", warned), !can_write) << warned;
}

INSTANTIATE_TEST_SUITE_P(Ways, EndOfAProgram,
                         testing::Values("return", "exit", "_exit", "abort", "crash", "2", "9", "15"));

TEST_P(EndOfAProgram, LeavesAPageWithPlots)
{
    const ScratchFile place;
    const std::string folder = place.path() + ".report";
    const std::string program = std::string(ENDING " ") + GetParam();
    EXPECT_EQ(raw_status(LAUNCHER " --report " + folder + " " + program), raw_status(program));
    std::ostringstream page;
    page << std::ifstream(folder + "/index.html").rdbuf();
    constexpr int of_the_run = 1, of_its_replay_in_three_spaces = 2 * 3;
    EXPECT_EQ(count_of("<polyline", page.str()), of_the_run + of_its_replay_in_three_spaces) << page.str();
    EXPECT_TRUE(contains(page.str(), "<title>ode-predictive run " + program + "</title>")) << page.str();
    unlink((folder + "/index.html").c_str());
    unlink((folder + "/recording.odehist").c_str());
    rmdir(folder.c_str());
}

// Of a child that had its parent's memory, exit() told what the parent had counted.
TEST(EndOfAChild, IsToldOfItsOwnCollidesAlone)
{
    const ScratchFile statistics;
    EXPECT_EQ(raw_status(LAUNCHER " --stats=" + statistics.path() + " " ENDING " child exit"), 0);
    const std::string said = statistics.text();
    EXPECT_EQ(count_of("(process ", said), 2) << said;
    EXPECT_EQ(count_of("1 pairs; dSpaceCollide 1 calls", said), 1) << said;
    EXPECT_EQ(count_of("    ticks 1,", said), 1) << said;
    EXPECT_EQ(count_of("3 pairs; dSpaceCollide 3 calls", said), 1) << said;
}

TEST(EndOfAChild, ThatCannotWriteItsStatisticsIsNotForgotten)
{
    for (const char *way : {"_exit", "9", "crash"})
    {
        const std::string said = launch("--stats=/dev/null " ENDING " child " + std::string(way)).output;
        EXPECT_EQ(count_of("1 of 2 processes with ODE wrote no statistics: ", said), 1) << said;
    }
}

// It is not the launcher's to tell: it still counts.
TEST(EndOfAChild, ThatOutlivesItsParentIsToldByItself)
{
    const ScratchFile statistics;
    const Fifo fifo;
    const std::string path = statistics.path();
    const Outcome outcome = launch("--stats=" + path + " " ENDING " orphan " + fifo.path() + "; grep -c process " +
                                   path + "; echo > " + fifo.path());
    EXPECT_EQ(outcome.output, "1\n");
    EXPECT_EQ(count_of("(process ", statistics.text()), 2) << statistics.text();
    EXPECT_EQ(count_of("dSpaceCollide 1 calls", statistics.text()), 1) << statistics.text();
}

TEST(EndOfAChild, ThatOutlivesTheLauncherIsNotForgotten)
{
    const Fifo fifo;
    const std::string orphan = ENDING " orphan " + fifo.path();
    const std::string said = launch("--stats=/dev/null " + orphan + " 2>&1; echo > " + fifo.path()).output;
    EXPECT_EQ(count_of(" of 2 processes with ODE wrote no statistics: ", said), 1) << said;
}

TEST(EndOfAChild, ThatCollidesNothingIsNotMissed)
{
    EXPECT_EQ(launch("--stats=/dev/null " ENDING " idle_child").output, "");
}

TEST(EndOfAChild, ThatItsScriptWaitsForIsNotMissed)
{
    EXPECT_EQ(launch("--stats=/dev/null sh -c '" ENDING " & wait'").output, "");
}

TEST(LauncherThatWaits, PassesASignalOn)
{
    const ScratchFile statistics;
    Waiting waiting(statistics.path());
    waiting.signal(SIGUSR1);
    EXPECT_EQ(waiting.line(), "counted");
    waiting.signal(SIGTERM);
    const int status = waiting.wait();
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
}

// The terminal sends it to both. The launcher is stopped meanwhile: two signals at the same time would count as one.
TEST(LauncherThatWaits, LeavesControlCToTheProgram)
{
    const ScratchFile statistics;
    Waiting waiting(statistics.path(), Waiting::Output::terminal);
    waiting.signal(SIGSTOP);
    EXPECT_TRUE(WIFSTOPPED(waiting.wait(WUNTRACED)));
    waiting.press('\003');
    EXPECT_EQ(waiting.line(), "counted");
    waiting.signal(SIGCONT);
    EXPECT_EQ(waiting.line(), "continued");
    waiting.signal(SIGTERM);
    const int status = waiting.wait();
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1); // counted once
}

TEST(LauncherThatWaits, StopsAndGoesOnWithTheProgram)
{
    const ScratchFile statistics;
    Waiting waiting(statistics.path());
    kill(waiting.program(), SIGSTOP);
    EXPECT_TRUE(WIFSTOPPED(waiting.wait(WUNTRACED)));
    waiting.signal(SIGCONT);
    EXPECT_EQ(waiting.line(), "continued");
    waiting.signal(SIGTERM);
    EXPECT_TRUE(WIFEXITED(waiting.wait()));
}

TEST(LauncherThatWaits, TakesTheProgramAlongWhenItIsKilled)
{
    const ScratchFile statistics;
    Waiting waiting(statistics.path());
    waiting.signal(SIGKILL);
    EXPECT_EQ(waiting.line(), "");
}

// What a program says whose parent ignored the end of its children, which is handed on.
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
    const std::string said = output_after_ignoring_children({LAUNCHER, "--stats", ENDING, "exit"});
    EXPECT_TRUE(contains(said, "dSpaceCollide 3 calls")) << said;
}

TEST(LauncherThatWaits, LeavesTheSignalsOfItsParentToTheProgram)
{
    const std::vector<const char *> program = {"grep", "Sig[BI]", "/proc/self/status"};
    const std::string native = output_after_ignoring_children(program);
    const std::size_t at = native.find("SigIgn:\t");
    ASSERT_NE(at, std::string::npos) << native;
    EXPECT_TRUE(std::stoull(native.substr(at + 8), nullptr, 16) >> (SIGCHLD - 1) & 1) << native;
    std::vector<const char *> launched = {LAUNCHER, "--stats=/dev/null"};
    launched.insert(launched.end(), program.begin(), program.end());
    EXPECT_EQ(output_after_ignoring_children(launched),
              native + "ode_predictive_space: no process with a space of ODE was seen\n");
}

// The reader of a pipe waits for all writers; here the program waits for the reader.
TEST(LauncherThatWaits, KeepsNoPipeOpen)
{
    allow_preload();
    const Fifo fifo;
    const std::string program = LAUNCHER " --stats=/dev/null sh -c \"exec >&-; read word <" + fifo.path() + "\"";
    EXPECT_EQ(run("timeout", "20 sh -c '" + program + " | { cat; echo word >" + fifo.path() + "; }'").status, 0);
}

// A measure that was changed later was compared by the one from the beginning, which misses pairs.
TEST(Statistics, NameTheMeasureThatAProgramChose)
{
    const Outcome outcome = launch("--stats --compare " MEASURING);
    EXPECT_TRUE(contains(outcome.output, "hash, predictive by spheres; at most 2 geoms, 0 pairs")) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "20 collides, 0 differences")) << outcome.output;
}

// The check of ODE in the plugin had the preload loaded, which had ODE checked by the plugin, and the program ended.
TEST(Statistics, CountASpaceThatTheProgramItselfMakesPredictive)
{
    const Outcome outcome = launch("--stats " MEASURING " own");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "hash, predictive by spheres; at most 2 geoms")) << outcome.output;
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

TEST(Statistics, NeedNoLauncher)
{
    const Outcome outcome = run("env", "ASAN_OPTIONS=verify_asan_link_order=0 LD_PRELOAD=" PRELOAD
                                       " ODE_PREDICTIVE_STATS=1 ODE_PREDICTIVE_NOTES=1:1 " ENDING);
    EXPECT_TRUE(contains(outcome.output, "dSpaceCollide 3 calls")) << outcome.output;
}
} // namespace
} // namespace ode_predictive_space::preload
