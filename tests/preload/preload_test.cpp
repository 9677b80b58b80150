// Whole programs: their behaviour does not change, and the replaced spaces are reported.

#include "tests/preload/preload_programs.h"

namespace ode_predictive_space::preload
{
namespace
{
std::string native_output(const std::string &program, const std::string &arguments = "")
{
    const Outcome outcome = run(program, arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "pairs: ")) << outcome.output;
    return outcome.output;
}

// The statistics of a program, whose output must be the same as without the preload.
std::string statistics_of(const std::string &options, const std::string &program, const std::string &arguments = "")
{
    const ScratchFile statistics;
    const Outcome outcome = launch("--stats=" + statistics.path() + " " + options + " " + program + " " + arguments);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.output, native_output(program, arguments));
    return statistics.text();
}

std::string one_line_refusal(const std::string &program, const std::string &arguments = "")
{
    const ScratchFile complaints;
    const Outcome outcome = launch("--space all " + program + " " + arguments + " 2>" + complaints.path() + " | cat");
    EXPECT_EQ(outcome.output, run(program, arguments).output);
    EXPECT_EQ(count_of("\n", complaints.text()), 1) << complaints.text();
    EXPECT_TRUE(contains(complaints.text(), "keeps its own spaces")) << complaints.text();
    return complaints.text();
}

// The scene makes one space of each kind, and four groups of the same kind in each.
TEST(Preload, ReplacesAllButSimpleSpaces)
{
    const std::string said = statistics_of("", LINKED);
    EXPECT_EQ(count_of("simple, ODE's own", said), 5) << said;
    for (const char *kind : {"hash, predictive by boxes", "quadtree, predictive by boxes", "sap, predictive by boxes"})
        EXPECT_EQ(count_of(kind, said), 5) << said;
}

TEST(Preload, ReplacesWhatIsAskedFor)
{
    EXPECT_EQ(count_of("predictive by", statistics_of("--space all", LINKED)), 20);
    EXPECT_EQ(count_of("predictive by", statistics_of("--space none", LINKED)), 0);
    const std::string said = statistics_of("--space simple,sap", LINKED);
    EXPECT_EQ(count_of("simple, predictive", said), 5) << said;
    EXPECT_EQ(count_of("sap, predictive", said), 5) << said;
    EXPECT_EQ(count_of("ODE's own", said), 10) << said;
}

TEST(Preload, MeasuresBySpheresWhenAskedTo)
{
    const Outcome outcome = launch("--proximity sphere --stats " LINKED);
    EXPECT_EQ(count_of("hash, predictive by spheres", outcome.output), 5) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "\nlevels -3 10, then -1 5\n")) << outcome.output;
}

TEST(Preload, IsInheritedByChildProcesses)
{
    const ScratchFile statistics;
    const Outcome outcome = launch("--stats=" + statistics.path() + " sh -c '" LINKED "; " LINKED "'");
    EXPECT_EQ(outcome.output, native_output(LINKED) + native_output(LINKED));
    EXPECT_EQ(count_of("(process ", statistics.text()), 2) << statistics.text();
}

TEST(Preload, HabitsOfProgramsMakeNoDifference)
{
    const std::string native = run(HABITS, "").output;
    EXPECT_GT(count_of("\npairs: 1", native), 50) << native;
    for (const char *options : {"", "--space simple", "--space all", "--space hash --stats=/dev/null"})
        EXPECT_TRUE(launch(options + std::string(" " HABITS)).output == native) << options;
}

// The other two have an infinite box inside another space, so their groups are met more often.
TEST(Preload, TracesAreTheSameWithOdesOwnSpaces)
{
    const ScratchFile native, replaced;
    launch("--space none --trace " + native.path() + " " LINKED);
    launch("--space simple,hash --trace " + replaced.path() + " " LINKED);
    EXPECT_TRUE(native.text() == replaced.text());
    EXPECT_GT(count_of("dSpaceCollide ", native.text()), 100);
    EXPECT_GT(count_of("dSpaceCollide2 ", native.text()), 100);
}

TEST(Preload, TracesTellMotionsApart)
{
    const ScratchFile trace;
    launch("--trace " + trace.path() + " " LINKED);
    std::istringstream lines(trace.text());
    std::string first, second;
    std::getline(lines, first);
    while (std::getline(lines, second) && !contains(second, "dSpaceCollide "))
        continue;
    EXPECT_NE(first, second);
}

// Once, the program kept its own spaces.
TEST(Preload, ReachesFunctionsThatAreLookedUp)
{
    const std::string said = statistics_of("", LOOKED_UP, ODE_LIBRARY);
    EXPECT_EQ(count_of("simple, ODE's own", said), 1) << said;
    for (const char *kind : {"hash, predictive by boxes", "quadtree, predictive by boxes", "sap, predictive by boxes"})
        EXPECT_EQ(count_of(kind, said), 1) << said;
    EXPECT_EQ(count_of("dSpaceCollide 2 calls", said), 4) << said;
    EXPECT_EQ(count_of("dSpaceCollide2 1 calls", said), 4) << said;
}

TEST(Preload, LeavesFunctionsAloneThatAreLookedUpInAForeignOde)
{
    EXPECT_TRUE(contains(one_line_refusal(LOOKED_UP, OTHER_ODE), OTHER_ODE));
}

// dlsym() searches from the library that calls it: a preload that passed it on by a call would find the same function again.
TEST(Preload, LookingUpTheNextFunctionWorksAsWithoutIt)
{
    const std::string native = run(NEXT_FUNCTION, "").output;
    EXPECT_EQ(native, "of the second library\nnone\nnone\nno error\n");
    EXPECT_EQ(launch(NEXT_FUNCTION).output, native);
}

// Once, the program ended by an exception: loading the second half initialised what was being initialised.
TEST(Preload, AProgramMayMakeThePredictiveSpaceItself)
{
    for (const char *options : {"--stats ", "--space none --stats ", ""})
        EXPECT_EQ(launch(options + std::string(SWAPPED)).status, 0) << options;
    EXPECT_TRUE(contains(launch("--stats " SWAPPED).output, "predictive by boxes"));
}

TEST(Preload, RefusesAStaticOde)
{
    EXPECT_TRUE(contains(one_line_refusal(STATIC_ODE), "has ODE built in"));
    EXPECT_EQ(launch(STATIC_ODE).status, 3);
}

TEST(Preload, RefusesAForeignOde)
{
    EXPECT_TRUE(contains(one_line_refusal(FOREIGN_ODE), OTHER_ODE));
    EXPECT_EQ(launch(FOREIGN_ODE).status, 3);
}

TEST(Preload, RefusesASecondOde)
{
    EXPECT_TRUE(contains(one_line_refusal(LINKED, OTHER_ODE), "more than one copy"));
}

// Once, the message was that of the dynamic linker, about an undefined symbol.
TEST(Preload, RefusesALibraryOfAnotherPrecisionUnderTheSameName)
{
    const std::string said = one_line_refusal(LINKED_WITH_OTHER_PRECISION);
    EXPECT_TRUE(contains(said, "has another precision")) << said;
    EXPECT_EQ(launch(LINKED_WITH_OTHER_PRECISION).status, 3);
}

// The dynamic linker describes the second library at the first one's address. Once, the wrong ODE made its spaces.
TEST(Preload, TellsALibraryFromOneThatWasThereBefore)
{
    const std::string libraries = FOREIGNER " " EXTENSION " " FOREIGNER;
    EXPECT_EQ(launch(LOCAL " " + libraries).status, 0);
    const ScratchFile complaints;
    const Outcome outcome = launch(LOCAL " " + libraries + " 2>" + complaints.path() + " | cat");
    EXPECT_EQ(outcome.output, run(LOCAL, libraries).output);
}

// A tail call is a jump, so that the caller of the function seems to have called ODE: here a program without ODE, and two
// libraries with an ODE each. Once, the program was ended because no ODE was found.
TEST(Preload, FollowsJumpsToTheRightOde)
{
    const std::string libraries = EXTENSION " " FOREIGNER " " EXTENSION;
    EXPECT_EQ(launch(LOCAL " " + libraries).status, 0);
    const ScratchFile said;
    const Outcome outcome = launch("--stats " LOCAL " " + libraries + " 2>" + said.path() + " | cat");
    EXPECT_EQ(outcome.output, run(LOCAL, libraries).output);
    EXPECT_EQ(count_of("predictive by boxes", said.text()), 2 * 15);
}

// Once, one thread held the preload's lock and waited for the dynamic linker's, and the other did the reverse.
TEST(Preload, ConstructorsMayUseOde)
{
    EXPECT_EQ(launch("timeout 20 " CONSTRUCTING " " CONSTRUCTOR).status, 0);
}

// Once, the check of ODE took the dynamic linker's locks in another order than a thread that loads: one run in fifteen hung.
TEST(Preload, LibrariesMayBeLoadedMeanwhile)
{
    for (int i = 0; i < 60; ++i)
        ASSERT_EQ(launch("timeout 20 " LOADING " " EXTENSION).status, 0);
}

TEST(Preload, ThreadsMayMeetOdeAllAtOnce)
{
    for (int i = 0; i < 10; ++i)
    {
        const ScratchFile trace;
        const std::string said = statistics_of("--trace " + trace.path(), THREADS);
        EXPECT_EQ(count_of("dSpaceCollide 50 calls", said), 4) << said;
        EXPECT_EQ(count_of("\n", trace.text()), 200);
    }
}

// A child has its parent's memory but only one of its threads: locks of other threads stay held, and buffered lines stay
// unwritten. Once, lines were written by parent and children, and children did not end.
TEST(Preload, ChildrenWriteTheirOwnLinesOfATraceOnly)
{
    const ScratchFile trace;
    EXPECT_EQ(launch("--trace " + trace.path() + " " FORKING " 3").status, 0);
    EXPECT_EQ(count_of("\n", trace.text()), 2 + 3 + 1) << trace.text();
}

// Once, exit() in a child, which has its parent's memory, reported the parent's counts.
TEST(Preload, ChildrenCountWhatTheyCollideThemselves)
{
    const ScratchFile statistics;
    EXPECT_EQ(launch("--stats=" + statistics.path() + " " FORKING " 3").status, 0);
    const std::string said = statistics.text();
    EXPECT_EQ(count_of("3 pairs; dSpaceCollide 3 calls", said), 1) << said;
    EXPECT_EQ(count_of("1 pairs; dSpaceCollide 1 calls", said), 3) << said;
    EXPECT_EQ(count_of("dSpaceCollide", said), 4) << said;
}

TEST(Preload, ChildrenDoNotWaitForThreadsThatTheyHaveNot)
{
    const ScratchFile statistics;
    EXPECT_EQ(launch("--stats=" + statistics.path() + " " FORKING " 20 busy").status, 0);
}

// Once, ODE's message came from within the ledger's lock, and a program that continued after it did not end.
TEST(Preload, OdeRefusesWhatItRefusesWithout)
{
    for (const char *options : {"", "--stats=/dev/null"})
        EXPECT_EQ(launch(options + std::string(" timeout 20 " REFUSED)).output, run(REFUSED, "").output) << options;
}

// A library that is loaded into every process must not load others.
TEST(Preload, NeedsTheCLibraryAlone)
{
    const Outcome outcome = run("readelf", "--dynamic --wide " INSTALLED_PRELOAD);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(count_of("(NEEDED)", outcome.output),
              count_of("[libc.so", outcome.output) + count_of("[ld-", outcome.output))
        << outcome.output;
}
} // namespace
} // namespace ode_predictive_space::preload
