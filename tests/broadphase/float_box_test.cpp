#include "ode_predictive_space/broadphase/base/float_box.h"

#include <cstring>

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
// Any pattern of bits is a double: all magnitudes are equally frequent, denormal numbers, infinities and NaN among them.
double any_bits(Random &random)
{
    const std::uint64_t bits = random.bits();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

// Somewhere near a float: on it, beside it, or between it and the next.
double near_a_float(Random &random)
{
    const std::uint32_t bits = static_cast<std::uint32_t>(random.bits());
    float value;
    std::memcpy(&value, &bits, sizeof value);
    switch (random.index(4))
    {
    case 0:
        return value;
    case 1:
        return std::nextafter(double{value}, infinity);
    case 2:
        return std::nextafter(double{value}, -infinity);
    default:
        return 0.5 * (double{value} + std::nextafter(value, float_infinity));
    }
}

// Two units in the last place; for tiny numbers, the smallest of full precision.
double allowed_error(double value)
{
    return 2 * std::numeric_limits<float>::epsilon() * std::abs(value) + 2 * double{std::numeric_limits<float>::min()};
}

void expect_rounded_outwards(double value)
{
    const float down = round_down(value), up = round_up(value);
    if (std::isnan(value))
    {
        EXPECT_EQ(down, -float_infinity);
        EXPECT_EQ(up, float_infinity);
        return;
    }
    EXPECT_LE(down, value);
    EXPECT_GE(up, value);
    if (std::isfinite(value) && down > -largest_float)
    {
        EXPECT_GE(down, std::min(value - allowed_error(value), double{largest_float})) << "much too low for " << value;
    }
    if (std::isfinite(value) && up < largest_float)
    {
        EXPECT_LE(up, std::max(value + allowed_error(value), -double{largest_float})) << "much too high for " << value;
    }
    if (static_cast<double>(static_cast<float>(value)) == value)
    {
        EXPECT_EQ(down, value) << "a float stays as it is";
        EXPECT_EQ(up, value) << "a float stays as it is";
    }
}

Box cube(double low, double high)
{
    return Box(Vector3::Constant(low), Vector3::Constant(high));
}

TEST(Rounding, IsOutwardsAndTightForAllKindsOfDoubles)
{
    Random random(2);
    for (int i = 0; i < 500000 && !testing::Test::HasFailure(); ++i)
    {
        expect_rounded_outwards(any_bits(random));
        expect_rounded_outwards(near_a_float(random));
        expect_rounded_outwards(random.uniform(-100, 100));
    }
}

TEST(Rounding, IsOutwardsAtTheEdgesOfTheRange)
{
    const double tiniest = std::numeric_limits<double>::denorm_min();
    const double tiny = std::numeric_limits<float>::denorm_min();
    for (double value : {0.0, tiniest, tiny, 0.5 * tiny, 1.5 * tiny, double{std::numeric_limits<float>::min()},
                         double{largest_float}, std::nextafter(double{largest_float}, infinity), 1e39, 1e300,
                         std::numeric_limits<double>::max(), infinity, nan})
    {
        expect_rounded_outwards(value);
        expect_rounded_outwards(-value);
    }
}

TEST(Rounding, KeepsInfinitiesAndWhatIsBeyondFloats)
{
    EXPECT_EQ(round_down(infinity), float_infinity);
    EXPECT_EQ(round_up(-infinity), -float_infinity);
    EXPECT_EQ(round_down(1e39), largest_float);
    EXPECT_EQ(round_up(1e39), float_infinity);
    EXPECT_EQ(round_down(-1e39), -float_infinity);
    EXPECT_EQ(round_up(-1e39), -largest_float);
    EXPECT_LT(round_down(-1e-320), 0);
    EXPECT_GT(round_up(1e-320), 0);
}

TEST(FloatBox, HoldsTheBoxItWasMadeOf)
{
    Random random(3);
    for (int i = 0; i < 100000; ++i)
    {
        const Vector3 low = random.vector(1e6);
        const Box box(low, low + random.vector(1).cwiseAbs());
        const FloatBox rounded = FloatBox::around(box);
        for (int axis = 0; axis < 3; ++axis)
        {
            ASSERT_LE(rounded.low[axis], box.min()[axis]);
            ASSERT_GE(rounded.high[axis], box.max()[axis]);
        }
    }
}

TEST(FloatBox, RoundsEachSideAsRoundingDoes)
{
    Random random(10);
    for (int i = 0; i < 200000; ++i)
    {
        const bool tame = random.chance(0.5); // so that all six are finite as floats
        const auto any_side = [&] { return tame ? random.uniform(-1e6, 1e6) : any_bits(random); };
        const Vector3 low(any_side(), any_side(), any_side()), high(any_side(), any_side(), any_side());
        const FloatBox box = FloatBox::around(Box(low, high));
        for (int axis = 0; axis < 3; ++axis)
        {
            ASSERT_EQ(box.low[axis], round_down(low[axis]));
            ASSERT_EQ(box.high[axis], round_up(high[axis]));
        }
    }
}

TEST(FloatBox, OfWhatIsNotANumberIsEverywhere)
{
    const FloatBox lost = FloatBox::around(cube(nan, nan));
    EXPECT_TRUE(lost.overlaps(FloatBox::around(cube(1e30, 2e30))));
    EXPECT_TRUE(lost.overlaps(FloatBox::around(cube(infinity, infinity))));
    EXPECT_TRUE(lost.overlaps(lost));
    EXPECT_FALSE(lost.bounded());
}

TEST(FloatBox, OverlapsWhatItTouches)
{
    const FloatBox box = FloatBox::around(cube(0, 1));
    for (int axis = 0; axis < 3; ++axis)
    {
        Vector3 offset = Vector3::Zero();
        offset[axis] = 1;
        const FloatBox touching = FloatBox::around(Box(offset, offset + Vector3::Ones()));
        EXPECT_TRUE(box.overlaps(touching));
        EXPECT_TRUE(touching.overlaps(box));
        offset[axis] = 1 + 1e-6;
        const FloatBox apart = FloatBox::around(Box(offset, offset + Vector3::Ones()));
        EXPECT_FALSE(box.overlaps(apart));
        EXPECT_FALSE(apart.overlaps(box));
    }
    EXPECT_TRUE(FloatBox::around(cube(1, 1)).overlaps(box)) << "a point at the corner";
}

TEST(FloatBox, OverlapIsThatOfEachAxis)
{
    Random random(4);
    for (int i = 0; i < 100000; ++i)
    {
        const FloatBox a = random.box(1, 1.5), b = random.box(1, 1.5);
        bool expected = true;
        for (int axis = 0; axis < 3; ++axis)
            expected = expected && std::max(a.low[axis], b.low[axis]) <= std::min(a.high[axis], b.high[axis]);
        ASSERT_EQ(a.overlaps(b), expected);
        ASSERT_EQ(b.overlaps(a), expected);
    }
}

TEST(FloatBox, MergedIsTheSmallestThatContainsBoth)
{
    Random random(5);
    for (int i = 0; i < 10000; ++i)
    {
        const FloatBox a = random.box(1, 1), b = random.box(1, 1), merged = a.merged(b);
        ASSERT_TRUE(merged.contains(a));
        ASSERT_TRUE(merged.contains(b));
        for (int axis = 0; axis < 3; ++axis)
        {
            ASSERT_TRUE(merged.low[axis] == a.low[axis] || merged.low[axis] == b.low[axis]);
            ASSERT_TRUE(merged.high[axis] == a.high[axis] || merged.high[axis] == b.high[axis]);
        }
    }
}

TEST(FloatBox, ContainsItselfAndNothingThatSticksOut)
{
    const FloatBox box = FloatBox::around(cube(0, 1));
    EXPECT_TRUE(box.contains(box));
    for (int axis = 0; axis < 3; ++axis)
    {
        FloatBox higher = box, lower = box;
        higher.high[axis] = std::nextafter(1.0f, 2.0f);
        lower.low[axis] = -std::numeric_limits<float>::denorm_min();
        EXPECT_FALSE(box.contains(higher));
        EXPECT_FALSE(box.contains(lower));
    }
}

TEST(FloatBox, HalfAreaIsThatOfThreeSides)
{
    EXPECT_FLOAT_EQ(FloatBox::around(Box(Vector3::Zero(), Vector3(1, 2, 3))).half_area(), 11);
    EXPECT_FLOAT_EQ(FloatBox::around(cube(7, 7)).half_area(), 0);
}

TEST(FloatBox, TheAreaIsThatOfThreeSides)
{
    Random random(9);
    for (int i = 0; i < 1000; ++i)
    {
        const FloatBox box = random.box(10, 3);
        const float x = box.high[0] - box.low[0], y = box.high[1] - box.low[1], z = box.high[2] - box.low[2];
        ASSERT_FLOAT_EQ(box.half_area(), x * y + y * z + z * x);
    }
}

TEST(FloatBox, IsBoundedWhenEverySideIs)
{
    EXPECT_TRUE(FloatBox::around(cube(-1e12, 1e12)).bounded());
    EXPECT_TRUE(FloatBox::around(cube(0, 0)).bounded());
    for (double far : {1e16, infinity, nan, std::numeric_limits<double>::max()})
        for (int axis = 0; axis < 3; ++axis)
        {
            Box box = cube(-1, 1);
            box.max()[axis] = far;
            EXPECT_FALSE(FloatBox::around(box).bounded()) << far;
            box = cube(-1, 1);
            box.min()[axis] = -far;
            EXPECT_FALSE(FloatBox::around(box).bounded()) << -far;
            box.min()[axis] = box.max()[axis] = far;
            EXPECT_FALSE(FloatBox::around(box).bounded()) << "all of it at " << far;
        }
}

TEST(FloatBox, AreasOfBoundedBoxesAreFinite)
{
    const FloatBox huge = FloatBox::around(cube(-9e14, 9e14));
    ASSERT_TRUE(huge.bounded());
    EXPECT_TRUE(std::isfinite(huge.half_area()));
}
} // namespace
} // namespace ode_predictive_space
