#include "tests/recording/recorded.h"

#include "ode_predictive_space/recording/check.h"
#include "ode_predictive_space/recording/replay.h"

namespace ode_predictive_space::recording
{
void expect_pairs_agree(const Recording &recording, const std::vector<SpaceKind> &kinds)
{
    const recording::Pairs simple = find_pairs(recording, SpaceKind::simple);
    ASSERT_EQ(simple.failure, "");
    ASSERT_EQ(simple.events.size(), recording.events().size());
    for (const SpaceKind kind : kinds)
    {
        const recording::Verdict verdict = compare(recording, kind, find_pairs(recording, kind), simple);
        EXPECT_TRUE(verdict.agrees) << name_of(kind) << ": " << verdict.text;
    }
    for (std::size_t i = 0; i < simple.events.size(); ++i)
    {
        const EventSummary &event = recording.events()[i];
        if (!event.has_pairs)
            continue;
        EXPECT_EQ(event.pairs, simple.events[i].count) << "event " << i;
        EXPECT_EQ(event.hash, simple.events[i].hash) << "event " << i;
    }
}
} // namespace ode_predictive_space::recording
