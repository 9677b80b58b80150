#include "ode_predictive_space/prediction/envelope.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/prediction/random_pairs.h"

using namespace ode_predictive_space;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

} // namespace

TEST(Envelope, swept_holds_the_envelope_at_every_time)
{
    RandomPairs random(41);
    for (int i = 0; i < 10000 * pair_kinds; ++i)
    {
        EnvelopePair pair = random.make(static_cast<PairKind>(i % pair_kinds));
        if (i % 3 == 0) // a deviation could hide a rounding error
            pair.second.deviation = {};
        const Box swept = pair.second.swept(pair.duration);
        for (int k = 0; k <= 8; ++k)
            ASSERT_TRUE(swept.contains(pair.second.at(pair.duration * k / 8))) << "pair " << i << " at " << k << "/8";
        const Vector3 turns = -pair.second.path.velocity.cwiseQuotient(pair.second.path.acceleration);
        for (int axis = 0; axis < 3; ++axis)
        {
            const bool turns_within = turns[axis] > 0 && turns[axis] < pair.duration;
            const Box box = pair.second.at(turns_within ? turns[axis] : 0);
            ASSERT_TRUE(swept.contains(box)) << "pair " << i << " where it turns";
        }
    }
}

TEST(Envelope, swept_is_tight_on_every_side)
{
    RandomPairs random(42);
    for (int i = 0; i < 1000; ++i)
    {
        Envelope envelope = random.make(PairKind::curved).second;
        envelope.deviation = {0.5, 0, 0};
        const double T = 100;
        Box visited;
        for (int k = 0; k <= 1000; ++k)
            visited.extend(envelope.at(T * k / 1000));
        const double step = 1e-6 * envelope.path.acceleration.norm() * T * T + 1e-9;
        const Box swept = envelope.swept(T);
        EXPECT_LE((visited.min() - swept.min()).maxCoeff(), step);
        EXPECT_LE((swept.max() - visited.max()).maxCoeff(), step);
    }
}

TEST(Envelope, infinite_sides_stay_infinite)
{
    Envelope floor;
    floor.low = Vector3::Constant(-infinity);
    floor.high = Vector3(infinity, infinity, 0);
    floor.deviation = {0.5, 0, 0};
    for (const Box &box : {floor.at(3), floor.swept(3)})
    {
        EXPECT_EQ(box.min(), floor.low);
        EXPECT_EQ(box.max().x(), infinity);
        EXPECT_EQ(box.max().y(), infinity);
        EXPECT_NEAR(box.max().z(), 0.5, 1e-12);
    }
}
