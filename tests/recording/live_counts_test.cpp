// A recording is faithful: its replay takes the instructions of the program's space, and its pairs have the same contacts.

#include <cstdio>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <ode/ode.h>

#include "ode_predictive_space/recording/instructions.h"
#include "ode_predictive_space/recording/recording.h"
#include "ode_predictive_space/recording/stage.h"
#include "tests/contract/support/ode_test.h"
#include "tests/support/scratch.h"

namespace ode_predictive_space::recording
{
namespace
{

struct Collisions
{
    unsigned long calls = 0, contacts = 0;

    static void collide(void *self, dGeomID first, dGeomID second)
    {
        dContactGeom found[8];
        auto &collisions = *static_cast<Collisions *>(self);
        ++collisions.calls;
        collisions.contacts += static_cast<unsigned long>(dCollide(first, second, 8, found, sizeof found[0]));
    }
};

Collisions in_program(const std::string &scene, const std::string &kind, const std::string &file)
{
    Collisions collisions;
    std::FILE *output = popen((COUNTED_LIVE " " + scene + " " + kind + " " + file).c_str(), "r");
    EXPECT_EQ(std::fscanf(output, "%lu %lu", &collisions.calls, &collisions.contacts), 2);
    EXPECT_EQ(pclose(output), 0);
    return collisions;
}

Collisions in_replay(const std::string &file, SpaceKind kind)
{
    const Recording recording = Recording::read(file);
    EXPECT_EQ(recording.stand_ins(), 0u);
    Collisions collisions;
    recording::Stage stage(recording, kind);
    for (const Record &record : recording.records())
        if (record.kind == RecordKind::collide)
            stage.ask(record, &collisions, Collisions::collide);
        else
            stage.apply(record);
    return collisions;
}

class Recorded : public OdeTest, public testing::WithParamInterface<const char *>
{
protected:
    ScratchFile file_;
};

TEST_P(Recorded, PairsByShapeHaveTheirContacts)
{
    const Collisions live = in_program(GetParam(), "shape", file_.path());
    const Collisions replayed = in_replay(file_.path(), SpaceKind::shape);
    EXPECT_GT(live.contacts, 100u);
    EXPECT_EQ(replayed.calls, live.calls);
    EXPECT_EQ(replayed.contacts, live.contacts);
}

#ifdef COUNT_INSTRUCTIONS // only in the long tests, for which valgrind is installed
double difference(std::optional<std::uint64_t> all, std::optional<std::uint64_t> without_space)
{
    EXPECT_TRUE(all && without_space);
    return static_cast<double>(all.value_or(0)) - static_cast<double>(without_space.value_or(0));
}

TEST_P(Recorded, InstructionsAreThoseOfTheProgramWithinFivePercent)
{
    ASSERT_TRUE(recording::has_valgrind());
    in_program(GetParam(), "box", file_.path());
    const std::string program = COUNTED_LIVE, scene = GetParam();
    const double live = difference(recording::instructions_of({program, scene, "box"}),
                                   recording::instructions_of({program, scene, "none"}));
    const double replayed = difference(recording::count_instructions(TOOL, file_.path(), SpaceKind::box),
                                       recording::count_instructions(TOOL, file_.path(), SpaceKind::none));
    EXPECT_GT(live, 1e6);
    EXPECT_NEAR(replayed / live, 1, 0.05);
}
#endif

INSTANTIATE_TEST_SUITE_P(, Recorded, testing::Values("poses", "terrain"), [](const auto &info) { return info.param; });
} // namespace
} // namespace ode_predictive_space::recording
