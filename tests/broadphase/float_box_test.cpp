#include "ode_predictive_space/broadphase/base/float_box.h"

#include <cstring>

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
// Every bit pattern is a double: all magnitudes are equally frequent, and denormal numbers, infinities and NaN occur.
double any_bits(Random &random)
{
    const std::uint64_t bits = random.bits();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

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

TEST(FloatBox, RoundsEachSideAsRoundingDoes)
{
    Random random(10);
    for (int i = 0; i < 200000; ++i)
    {
        const bool tame = random.chance(0.5); // keeps all six sides finite as floats
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

} // namespace
} // namespace ode_predictive_space
