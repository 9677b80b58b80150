// The file of a recording on a full disk, which a limit of the process simulates.

#include "ode_predictive_space/recording/history_file.h"

#include <cerrno>
#include <csignal>
#include <filesystem>

#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "tests/support/scratch.h"

namespace ode_predictive_space::recording
{
namespace
{
int signals_of_size;

void count_signal(int /*number*/)
{
    ++signals_of_size;
}

/// During its lifetime, this process writes no larger files, and counts the signals of the limit.
class LimitOfFiles
{
public:
    explicit LimitOfFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, count_signal))
    {
        signals_of_size = 0;
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit small{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
    }
    ~LimitOfFiles()
    {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    LimitOfFiles(const LimitOfFiles &) = delete;
    LimitOfFiles &operator=(const LimitOfFiles &) = delete;

private:
    void (*handler_)(int);
    rlimit before_;
};

TEST(HistoryFile, EndsWithTheLastWholeRecordWhenTheDiskIsFull)
{
    const ScratchFile scratch;
    HistoryFile file(scratch.path(), false);
    {
        const LimitOfFiles limit(150);
        EXPECT_TRUE(file.write(std::string(100, 'a')));
        EXPECT_FALSE(file.write(std::string(100, 'b')));
        EXPECT_EQ(signals_of_size, 0) << "the program may not expect it";
        std::raise(SIGXFSZ);
        EXPECT_EQ(signals_of_size, 1) << "signals come again";
        sigset_t of_size;
        sigemptyset(&of_size);
        sigaddset(&of_size, SIGXFSZ);
        pthread_sigmask(SIG_BLOCK, &of_size, nullptr);
        std::raise(SIGXFSZ);
        file.write("c");
        pthread_sigmask(SIG_UNBLOCK, &of_size, nullptr);
        EXPECT_EQ(signals_of_size, 2) << "the program has held this one back";
    }
    EXPECT_EQ(file.error(), EFBIG);
    EXPECT_EQ(file.size(), 100u);
    EXPECT_EQ(std::filesystem::file_size(scratch.path()), 100u) << "half of a record would make it a broken file";
    EXPECT_FALSE(file.write("c")) << "what comes later would follow on what is missing";
    EXPECT_FALSE(file.close());
    EXPECT_EQ(std::filesystem::file_size(scratch.path()), 100u);
}

TEST(HistoryFile, ADeviceThatIsFullIsSaidToBeFull)
{
    HistoryFile file("/dev/full", false);
    EXPECT_FALSE(file.write("a"));
    EXPECT_EQ(file.error(), ENOSPC);
}

// Once, its content was lost, while the first recording continued.
TEST(HistoryFile, LeavesAFileAloneThatAnotherRecordingIsWrittenTo)
{
    const ScratchFile scratch;
    HistoryFile first(scratch.path(), false);
    EXPECT_TRUE(first.write("a record"));
    EXPECT_EQ(HistoryFile(scratch.path(), false).error(), EBUSY);
    EXPECT_EQ(std::filesystem::file_size(scratch.path()), 8u);
    EXPECT_EXIT((first.abandon(), _exit(0)), testing::ExitedWithCode(0), "");
    EXPECT_EQ(HistoryFile(scratch.path(), false).error(), EBUSY) << "a child has left it to this process";
    const pid_t child = fork();
    if (child == 0)
    {
        pause();
        _exit(0);
    }
    EXPECT_TRUE(first.close());
    EXPECT_EQ(HistoryFile(scratch.path(), false).error(), 0) << "a child of this process has the file open, too";
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    EXPECT_EQ(std::filesystem::file_size(scratch.path()), 0u);
}

// The recorded program starts another one, and ends without closing the file.
TEST(HistoryFile, IsNotKeptByAProgramThatTheRecordedOneStarted)
{
    const ScratchFile scratch;
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t recorded = fork();
    if (recorded == 0)
    {
        const HistoryFile file(scratch.path(), false);
        char name[] = "sleep", seconds[] = "60";
        char *const arguments[] = {name, seconds, nullptr};
        pid_t started = 0;
        posix_spawnp(&started, name, nullptr, nullptr, arguments, environ);
        _exit(write(ends[1], &started, sizeof started) == sizeof started ? 0 : 1);
    }
    pid_t started = 0;
    ASSERT_EQ(read(ends[0], &started, sizeof started), static_cast<ssize_t>(sizeof started));
    waitpid(recorded, nullptr, 0);
    EXPECT_EQ(HistoryFile(scratch.path(), false).error(), 0);
    EXPECT_EQ(kill(started, SIGKILL), 0) << "the other program lives until now";
    close(ends[0]);
    close(ends[1]);
}
} // namespace
} // namespace ode_predictive_space::recording
