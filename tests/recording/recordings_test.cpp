// Recordings of independent programs: the same pairs in every kind of space.

#include <algorithm>

#include <gtest/gtest.h>

#include "ode_predictive_space/recording/check.h"
#include "ode_predictive_space/recording/replay.h"
#include "tests/contract/support/ode_test.h"
#include "tests/recording/recorded.h"

namespace ode_predictive_space::recording
{
namespace
{
class RecordedProgram : public OdeTest, public testing::WithParamInterface<std::string>
{};

TEST_P(RecordedProgram, HasTheSamePairsInEverySpace)
{
    const std::string path = std::string(RECORDINGS) + "/" + GetParam() + ".odehist";
    if (sizeof(dReal) == sizeof(float))
    {
        EXPECT_THROW(Recording::read(path), BadRecording) << "it is in double precision";
        return;
    }
    const Recording recording = Recording::read(path);
    ASSERT_GT(recording.events().size(), 20u);
    const Pairs simple = find_pairs(recording, SpaceKind::simple);
    EXPECT_TRUE(std::any_of(simple.events.begin(), simple.events.end(),
                            [](const EventPairs &event) { return event.count > 0; }));
    expect_pairs_agree(recording);
    EXPECT_NE(compared_with_program(recording, simple).find("in all of its"), std::string::npos)
        << compared_with_program(recording, simple);
}

INSTANTIATE_TEST_SUITE_P(, RecordedProgram, testing::Values("pyode_boxes", "ign_world", "haptic_demo", "nested"),
                         [](const auto &info) { return info.param; });

TEST(Comparison, NamesTheFirstEventThatDiffers)
{
    if (sizeof(dReal) == sizeof(float))
        return;
    const Recording recording = Recording::read(std::string(RECORDINGS) + "/nested.odehist");
    const Pairs simple = find_pairs(recording, SpaceKind::simple);
    Pairs wrong = simple;
    wrong.events[5].count += 1;
    wrong.events[9].hash += 1;
    const Verdict verdict = compare(recording, SpaceKind::box, wrong, simple);
    EXPECT_FALSE(verdict.agrees);
    EXPECT_NE(verdict.text.find("in 2 events, first in event 5"), std::string::npos) << verdict.text;
    const std::string sentence = compared_with_program(recording, wrong);
    EXPECT_NE(sentence.find(" in 2 of "), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("first in event 5 ("), std::string::npos) << sentence;
    wrong = simple;
    wrong.lost_contacts = 1;
    EXPECT_FALSE(compare(recording, SpaceKind::shape, wrong, simple).agrees);
    wrong.failure = "an assertion";
    EXPECT_NE(compare(recording, SpaceKind::hash, wrong, simple).text.find("ended at event"), std::string::npos);
}
} // namespace
} // namespace ode_predictive_space::recording
