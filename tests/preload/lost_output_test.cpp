// Output that cannot be written is never lost without a message, and the program continues.

#include "tests/preload/preload_programs.h"

namespace ode_predictive_space::preload
{
namespace
{
constexpr const char *full = "/dev/full cannot be written: No space left on device\n";
constexpr const char *too_large = " cannot be written: File too large\n";

/// A sparse file that ends a few bytes before the limit for sizes of files.
class FileAtItsLimit
{
public:
    FileAtItsLimit() { EXPECT_EQ(truncate(path().c_str(), limit - 10), 0); }

    const std::string &path() const { return file_.path(); }

    static std::string limited(const std::string &command)
    {
        return "-c 'ulimit -f " + std::to_string(limit / 512) + "; exec " + command + "'";
    }

private:
    static constexpr long limit = 1L << 20;
    ScratchFile file_;
};

// Once, SIGXFSZ ended the program.
TEST(LostOutput, AtTheLimitForSizesOfFilesDoesNotEndTheProgram)
{
    allow_preload();
    for (const std::string option : {"--stats=", "--trace="})
    {
        const FileAtItsLimit file;
        const Outcome outcome =
            run("sh", FileAtItsLimit::limited(LAUNCHER " " + option + file.path() + " " ENDING " return"));
        EXPECT_EQ(outcome.status, 0) << option;
        EXPECT_EQ(count_of(file.path() + too_large, outcome.output), 1) << outcome.output;
    }
}

// Once, there was a message, but the status was 0.
TEST(LostOutput, OfAReportHasStatus2)
{
    const std::string folder = testing::TempDir() + "lost_report";
    const Outcome outcome = launch("--report " + folder + " sh -c '" ENDING " return; rm -r " + folder + "'");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(count_of(folder + "/index.html cannot be written: No such file or directory\n", outcome.output), 1)
        << outcome.output;
}

TEST(LostOutput, OfAReportKeepsTheStatusOfAProgramThatFailed)
{
    const std::string folder = testing::TempDir() + "lost_report";
    EXPECT_EQ(launch("--report " + folder + " sh -c '" ENDING " exit; rm -r " + folder + "; exit 4'").status, 4);
}

TEST(LostOutput, OfTheLaunchersHelpHasStatus2)
{
    EXPECT_EQ(run("sh", "-c '" LAUNCHER " --help >/dev/full'").status, 2);
}

// Once, there was no message.
TEST(LostOutput, WithoutALauncherIsSaidAndChangesNothing)
{
    const Outcome outcome = run_preloaded("ODE_PREDICTIVE_STATS=/dev/full ODE_PREDICTIVE_TRACE=/dev/full " ENDING);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(count_of(full, outcome.output), 2) << outcome.output;
    EXPECT_EQ(count_of("dSpaceCollide 3 calls", outcome.output), 1) << outcome.output;
}

// Once, SIGPIPE ended the program during its exit.
TEST(LostOutput, InAPipeWithoutReaderDoesNotEndTheProgram)
{
    allow_preload();
    const Outcome outcome = run("bash", "-c 'exec 3> >(true); wait $!; env LD_PRELOAD=" PRELOAD
                                        " ODE_PREDICTIVE_STATS=/dev/fd/3 " ENDING "; echo status $?'");
    EXPECT_EQ(count_of("status 0\n", outcome.output), 1) << outcome.output;
}
} // namespace
} // namespace ode_predictive_space::preload
