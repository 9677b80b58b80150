// --record: the calls of programs to their spaces, and the replay of these calls.

#include <ode/common.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <sys/file.h>

#include "tests/preload/preload_programs.h"

namespace ode_predictive_space::preload
{
namespace
{
struct RecordingFolder : ScratchFolder
{
    std::string file() const { return path() + "/file"; }
    long files() const { return std::distance(std::filesystem::directory_iterator(path()), {}); }
};

TEST(Record, AProgramGoesTheSameWayAndItsRecordingHasItsPairs)
{
    const RecordingFolder folder;
    const Outcome plain = run(LINKED, "");
    for (const char *options : {"", "--space none ", "--proximity shape "})
    {
        const Outcome recorded = launch(std::string(options) + "--record " + folder.file() + " " LINKED);
        EXPECT_EQ(recorded.status, plain.status);
        EXPECT_EQ(folder.files(), 1) << "the one of an earlier run is gone";
        const Outcome replayed = run(REPLAYER, "--pairs " + folder.file());
        EXPECT_EQ(replayed.status, 0) << replayed.output;
        // ODE's own sweep-and-prune and quadtree spaces are reported with everything when they are nested. All geoms are
        // primitives, which the shape test compares by box.
        EXPECT_EQ(contains(replayed.output, "in all of its"), std::string(options) != "--space none ")
            << replayed.output;
    }
}

TEST(Record, SaysWhichSpacesTheProgramMadeAndWhetherNoticesAreKnown)
{
    const RecordingFolder folder;
    struct Case
    {
        const char *options, *program, *own;
        bool notices_are_known;
    };
    for (const Case &each :
         {Case{"--space all ", LINKED, "own (simple)", true}, Case{"--space none ", LINKED, "own (simple)", false},
          Case{"--space none ", SWAPPED, "own (predictive, by box)", true}})
    {
        launch(std::string(each.options) + "--record " + folder.file() + " " + each.program);
        const Outcome replayed = run(REPLAYER, "--pairs --space own " + folder.file());
        EXPECT_TRUE(contains(replayed.output, each.own)) << replayed.output;
        EXPECT_EQ(contains(replayed.output, "spaces of ODE were recorded"), !each.notices_are_known) << replayed.output;
    }
}

TEST(Record, HasTheTimesOfTheProgram)
{
    const RecordingFolder folder;
    launch("--space all --record " + folder.file() + " " LINKED);
    run(TOOL, "report " + folder.file() + " " + folder.file() + ".page");
    std::ifstream file(folder.file() + ".page/index.html");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    EXPECT_TRUE(contains(page, "In the program a collide took")) << page;
}

TEST(Record, HasThePairsOfAProgramThatIsTracedToo)
{
    const RecordingFolder folder, traced;
    EXPECT_EQ(launch("--trace " + traced.file() + " --record " + folder.file() + " " LINKED).status, 0);
    const Outcome replayed = run(REPLAYER, "--pairs " + folder.file());
    EXPECT_TRUE(contains(replayed.output, "in all of its")) << replayed.output;
}

TEST(Record, EndsAtItsLimit)
{
    const RecordingFolder folder;
    EXPECT_EQ(launch("--record-limit 20K --record " + folder.file() + " " LINKED).status, 0);
    EXPECT_LE(std::filesystem::file_size(folder.file()), 20u << 10);
    const Outcome replayed = run(REPLAYER, "--pairs --space box " + folder.file());
    EXPECT_EQ(replayed.status, 0) << replayed.output;
    EXPECT_TRUE(contains(replayed.output, "ended at its limit of bytes")) << replayed.output;
}

TEST(Record, EachProcessHasAFileOfItsOwn)
{
    const RecordingFolder folder;
    EXPECT_EQ(launch("--record " + folder.file() + " sh -c '" LINKED "; " LINKED "'").status, 0);
    EXPECT_EQ(folder.files(), 2);
}

TEST(Record, AChildThatIsForkedLeavesTheRecordingToItsParent)
{
    const RecordingFolder folder;
    launch("--record " + folder.file() + " " FORKING " 2");
    EXPECT_GT(folder.files(), 1);
    const Outcome replayed = run(REPLAYER, "--pairs --space box " + folder.file());
    EXPECT_EQ(replayed.status, 0) << replayed.output;
}

// Once, nothing was recorded of the second program.
TEST(Record, AProcessThatBecomesAnotherProgramHasAFurtherFile)
{
    const RecordingFolder folder;
    const Outcome outcome = launch("--record " + folder.file() + " sh -c '" LINKED "; " ENDING " become'");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_EQ(folder.files(), 3) << outcome.output;
}

// Once, the file was removed while a program was still writing to it.
TEST(Record, ASecondLauncherLeavesTheRecordingOfTheFirstAlone)
{
    const RecordingFolder folder;
    const std::string record = "--record " + folder.file() + " ";
    EXPECT_EQ(launch(record + LINKED).status, 0);
    const int file = open(folder.file().c_str(), O_WRONLY | O_CLOEXEC);
    ASSERT_EQ(flock(file, LOCK_EX), 0);
    const Outcome busy = launch(record + LINKED);
    EXPECT_EQ(busy.status, 2);
    EXPECT_EQ(count_of("another program is recording to " + folder.file(), busy.output), 1) << busy.output;
    close(file);
    EXPECT_EQ(launch(record + LINKED).status, 0);
}
} // namespace
} // namespace ode_predictive_space::preload
