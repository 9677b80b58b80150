#include "ode_predictive_space/prediction/envelope.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/prediction/random_pairs.h"

using namespace ode_predictive_space;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

const Envelope example = {
    {Vector3(0, 0, 10), Vector3(1, 0, 4), Vector3(0, 0, -2)}, {0.5, 0.25, 0}, Vector3(-1, -2, -3), Vector3(3, 2, 1), 4};
} // namespace

TEST(Envelope, moves_and_grows)
{
    EXPECT_EQ(example.at(0).min(), Vector3(-1.5, -2.5, 6.5));
    EXPECT_EQ(example.at(0).max(), Vector3(3.5, 2.5, 11.5));
    EXPECT_EQ(example.at(2).min(), Vector3(0, -3, 10));
    EXPECT_EQ(example.at(2).max(), Vector3(6, 3, 16));
}

TEST(Envelope, advanced_is_the_same_envelope)
{
    const Envelope later = example.advanced(3);
    for (const double t : {0.0, 1.0, 2.0})
        EXPECT_TRUE(later.at(t).isApprox(example.at(3 + t), 1e-15));
    EXPECT_EQ(later.radius, example.radius);
}

TEST(Envelope, swept_holds_the_turning_point)
{
    // z climbs from 10 to 14 at t = 2 and is back at 10 at t = 4.
    const Box swept = example.swept(4);
    EXPECT_TRUE(swept.min().isApprox(Vector3(-2.5, -3.5, 5.5), 1e-12));
    EXPECT_TRUE(swept.max().isApprox(Vector3(8.5, 3.5, 16.5), 1e-12));
}

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

TEST(Envelope, swept_of_no_time_is_the_box_itself)
{
    EXPECT_TRUE(example.swept(0).isApprox(example.at(0), 1e-12));
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
