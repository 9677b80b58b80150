// Every operation of the vector arithmetic against plain arithmetic, lane by lane and bit for bit. This file tests both
// implementations, the second in broadphase_without_sse2_tests.

#include "ode_predictive_space/broadphase/base/simd.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "ode_predictive_space/broadphase/base/rounding.h"
#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
using Four = std::array<float, 4>;
using Three = std::array<double, 3>;
using Eight = std::array<std::int16_t, 8>;

constexpr float tiniest = std::numeric_limits<float>::denorm_min();
constexpr float smallest = std::numeric_limits<float>::min();
constexpr float edges[] = {0,
                           -0.0f,
                           1,
                           -1,
                           tiniest,
                           -tiniest,
                           smallest,
                           -smallest,
                           largest_float,
                           -largest_float,
                           float_infinity,
                           -float_infinity,
                           float_nan,
                           0.1f};
constexpr int rounds = 100000;

template <typename Value, typename Bits> Value from_bits(std::uint64_t bits)
{
    const auto narrow = static_cast<Bits>(bits);
    Value value;
    static_assert(sizeof value == sizeof narrow, "all bits of the value");
    std::memcpy(&value, &narrow, sizeof value);
    return value;
}

float any_float(Random &random)
{
    switch (random.index(3))
    {
    case 0:
        return edges[random.index(std::size(edges))];
    case 1:
        return from_bits<float, std::uint32_t>(random.bits());
    default:
        return static_cast<float>(random.uniform(-10, 10));
    }
}

double any_double(Random &random)
{
    return random.chance(0.5) ? from_bits<double, std::uint64_t>(random.bits()) : double{any_float(random)};
}

Four four(Random &random)
{
    return {any_float(random), any_float(random), any_float(random), any_float(random)};
}

Three three(Random &random)
{
    return {any_double(random), any_double(random), any_double(random)};
}

Float4 vector_of(const Four &lanes)
{
    return {lanes[0], lanes[1], lanes[2], lanes[3]};
}

Four lanes_of(Float4 vector)
{
    Four lanes;
    vector.store(lanes.data());
    return lanes;
}

bool same(float one, float other)
{
    return (std::isnan(one) && std::isnan(other)) || std::memcmp(&one, &other, sizeof one) == 0;
}

void expect_same(const Four &found, const Four &expected, std::size_t count = 4)
{
    for (std::size_t lane = 0; lane < count; ++lane)
        ASSERT_TRUE(same(found[lane], expected[lane]))
            << "lane " << lane << ": " << found[lane] << " in place of " << expected[lane];
}

template <typename Vectors, typename Numbers> void expect_lane_by_lane(Vectors of_vectors, Numbers of_numbers)
{
    Random random(1);
    for (int i = 0; i < rounds; ++i)
    {
        const Four a = four(random), b = random.chance(0.1) ? a : four(random);
        Four expected;
        for (std::size_t lane = 0; lane < 4; ++lane)
            expected[lane] = of_numbers(a[lane], b[lane]);
        ASSERT_NO_FATAL_FAILURE(expect_same(lanes_of(of_vectors(vector_of(a), vector_of(b))), expected)) << i;
    }
}

template <typename Vectors, typename Numbers> void expect_compared(Vectors of_vectors, Numbers of_numbers)
{
    Random random(2);
    for (int i = 0; i < rounds; ++i)
    {
        const Four a = four(random), b = random.chance(0.1) ? a : four(random);
        unsigned expected = 0;
        for (unsigned lane = 0; lane < 4; ++lane)
            expected += of_numbers(a[lane], b[lane]) ? 1u << lane : 0u;
        ASSERT_EQ(of_vectors(vector_of(a), vector_of(b)).bits(), expected) << i;
    }
}

TEST(Float4, TheSecondIsTakenWhereNeitherIsLarger)
{
    expect_lane_by_lane([](Float4 a, Float4 b) { return max(a, b); }, [](float a, float b) { return a > b ? a : b; });
    expect_lane_by_lane([](Float4 a, Float4 b) { return min(a, b); }, [](float a, float b) { return a < b ? a : b; });
}

TEST(Float4, AComparisonGivesABitForEachLaneAndIsFalseForNaN)
{
    expect_compared([](Float4 a, Float4 b) { return a < b; }, [](float a, float b) { return a < b; });
    expect_compared([](Float4 a, Float4 b) { return a <= b; }, [](float a, float b) { return a <= b; });
    expect_compared([](Float4 a, Float4 b) { return a > b; }, [](float a, float b) { return a > b; });
    expect_compared([](Float4 a, Float4 b) { return a >= b; }, [](float a, float b) { return a >= b; });
    expect_compared([](Float4 a, Float4 b) { return a == b; }, [](float a, float b) { return a == b; });
    expect_compared([](Float4 a, Float4 b) { return (a <= b) & (a >= b); }, [](float a, float b) { return a == b; });
    expect_compared([](Float4 a, Float4 b) { return (a < b) | (a > b); },
                    [](float a, float b) { return a < b || a > b; });
    EXPECT_EQ((Float4(0, 1, 2, 3) < Float4::all(3)).bits(), three_lanes);
    EXPECT_EQ((Float4(0, 1, 2, 3) <= Float4::all(3)).bits(), four_lanes);
}

TEST(Float4, WhatIsNotFiniteBecomesZero)
{
    expect_lane_by_lane([](Float4 a, Float4) { return finite_or_zero(a); },
                        [](float a, float) { return std::isfinite(a) ? a : 0.0f; });
}

TEST(Float4, LoadsAndStoresWhatItHolds)
{
    Random random(3);
    for (int i = 0; i < rounds; ++i)
    {
        const Four values = four(random);
        alignas(16) const Four aligned = values;
        float shifted[5] = {0, values[0], values[1], values[2], values[3]};
        expect_same(lanes_of(Float4::load_aligned(aligned.data())), values);
        expect_same(lanes_of(Float4::load(shifted + 1)), values);
        expect_same(lanes_of(Float4::all(values[0])), {values[0], values[0], values[0], values[0]});
        Four room = {5, 5, 5, 5};
        vector_of(values).store_three(room.data());
        expect_same(room, {values[0], values[1], values[2], 5});
        ASSERT_FALSE(HasFailure()) << i;
    }
}

TEST(Float4, RoundsDoublesToTheNearestFloat)
{
    Random random(6);
    for (int i = 0; i < rounds; ++i)
    {
        const Three a = three(random);
        const Four expected = {static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2]), 0};
        const double spread[] = {a[0], 9, a[1], 9, a[2]};
        expect_same(lanes_of(Float4::nearest(a.data())), expected);
        expect_same(lanes_of(Float4::nearest_of_stored(a.data(), 1)), expected);
        expect_same(lanes_of(Float4::nearest_of_stored(spread, 2)), expected);
        ASSERT_FALSE(HasFailure()) << i;
    }
}

TEST(Float4, RoundsDoublesDownOnEitherSide)
{
    Random random(8);
    for (int i = 0; i < rounds; ++i)
        for (const double sign : {1.0, -1.0})
        {
            Three a = three(random);
            // The result is defined for values that are finite as floats.
            for (double &value : a)
                if (!std::isfinite(static_cast<float>(value)))
                    value = random.uniform(-1e6, 1e6);
            const Four expected = {round_down(sign * a[0]), round_down(sign * a[1]), round_down(sign * a[2])};
            const double spread[] = {a[0], 9, a[1], 9, a[2]};
            ASSERT_NO_FATAL_FAILURE(expect_same(lanes_of(Float4::rounded_down(a.data(), 1, sign)), expected, 3)) << i;
            ASSERT_NO_FATAL_FAILURE(expect_same(lanes_of(Float4::rounded_down(spread, 2, sign)), expected, 3)) << i;
        }
}

TEST(Float4, StoresWholeNumbersWithoutTheirFractions)
{
    const auto whole = [](const Four &values) {
        std::array<std::int32_t, 4> stored{};
        vector_of(values).store_whole(stored.data());
        return stored;
    };
    EXPECT_EQ(whole({0, 0.999f, 1, 65535}), (std::array<std::int32_t, 4>{0, 0, 1, 65535}));
    EXPECT_EQ(whole({tiniest, 32766.5f, -0.0f, 255.5f}), (std::array<std::int32_t, 4>{0, 32766, 0, 255}));
    Random random(9);
    for (int i = 0; i < rounds; ++i)
    {
        Four values;
        std::array<std::int32_t, 4> expected;
        for (std::size_t lane = 0; lane < 4; ++lane)
        {
            values[lane] = static_cast<float>(random.uniform(0, 65535));
            expected[lane] = static_cast<std::int32_t>(values[lane]);
        }
        ASSERT_EQ(whole(values), expected) << i;
    }
}

Eight eight(Random &random)
{
    constexpr std::int16_t extremes[] = {-32768, -1, 0, 1, 32767};
    Eight values;
    for (std::int16_t &value : values)
        value = random.chance(0.5) ? extremes[random.index(std::size(extremes))]
                                   : static_cast<std::int16_t>(random.index(65536));
    return values;
}

template <typename Holds> unsigned bits_where(Holds holds)
{
    unsigned bits = 0;
    for (std::size_t lane = 0; lane < 16; ++lane)
        bits += holds(lane) ? 1u << lane : 0u;
    return bits;
}

TEST(Short8, ComparesAndUnitesEachLane)
{
    Random random(10);
    for (int i = 0; i < rounds; ++i)
    {
        const Eight a = eight(random), b = random.chance(0.1) ? a : eight(random);
        const auto limit = static_cast<std::int16_t>(random.index(65536));
        const Short8 left = Short8::load(a.data()), right = Short8::load(b.data()), all = Short8::all(limit);
        ASSERT_EQ(bits_of(left > right, right > left), bits_where([&](std::size_t lane) {
                      return lane < 8 ? a[lane] > b[lane] : b[lane - 8] > a[lane - 8];
                  }));
        ASSERT_EQ(bits_of(left > all, all > left),
                  bits_where([&](std::size_t lane) { return lane < 8 ? a[lane] > limit : limit > a[lane - 8]; }));
        ASSERT_EQ(bits_of((left > right) | (right > left), (left > all) | (right > all)),
                  bits_where([&](std::size_t lane) {
                      return lane < 8 ? a[lane] != b[lane] : a[lane - 8] > limit || b[lane - 8] > limit;
                  }));
    }
}

} // namespace
} // namespace ode_predictive_space
