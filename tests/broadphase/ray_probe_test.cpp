#include "ode_predictive_space/broadphase/index/ray_probe.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
// Clips the line to the three slabs of the box, grown by `margin`.
bool line_meets(const Vector3 &start, const Vector3 &end, const FloatBox &box, long double margin)
{
    long double enter = 0, leave = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
        const long double from = start[axis], way = static_cast<long double>(end[axis]) - from;
        const long double low = box.low[axis] - margin, high = box.high[axis] + margin;
        if (way == 0)
        {
            if (from < low || from > high)
                return false;
            continue;
        }
        const long double one = (low - from) / way, other = (high - from) / way;
        enter = std::max(enter, std::min(one, other));
        leave = std::min(leave, std::max(one, other));
    }
    return enter <= leave;
}

struct Region
{
    const char *name;
    double offset; // distance from the origin
    double length; // largest length of the lines
    double size;   // largest size of the boxes
};

void PrintTo(const Region &place, std::ostream *out)
{
    *out << place.name;
}

class AnyRay : public testing::TestWithParam<Region>
{};

TEST_P(AnyRay, MeetsWhateverClippingMeetsAndHardlyMore)
{
    const Region place = GetParam();
    Random random(5);
    const Vector3 origin = place.offset * Vector3(1, -0.7, 0.3);
    const double margin = 8e-6 * (place.offset + place.length + place.size) + 1e-30;
    std::size_t met = 0, missed = 0;
    for (int i = 0; i < 200000; ++i)
    {
        const Vector3 start = origin + random.vector(place.length);
        Vector3 end = origin + random.vector(place.length);
        for (int axis = 0; axis < 3; ++axis)
            if (random.chance(0.1))
                end[axis] = start[axis];
        const Vector3 centre = origin + random.vector(place.length), half = 0.5 * random.vector(place.size).cwiseAbs();
        const FloatBox box = FloatBox::around(Box(centre - half, centre + half));
        const bool overlaps = RayProbe(start, end).overlaps(box);
        if (line_meets(start, end, box, 0))
        {
            ASSERT_TRUE(overlaps) << i;
            ++met;
        }
        else if (!line_meets(start, end, box, margin))
        {
            ASSERT_FALSE(overlaps) << i;
            ++missed;
        }
    }
    EXPECT_GT(met, 100u);
    EXPECT_GT(missed, 100u);
}

INSTANTIATE_TEST_SUITE_P(RayProbe, AnyRay,
                         testing::Values(Region{"near", 0, 1, 1}, Region{"long", 0, 100, 20},
                                         Region{"far", 1e6, 100, 50}, Region{"very_far", 1e12, 1e9, 1e9},
                                         Region{"tiny", 0, 1e-12, 1e-12}, Region{"huge", 0, 1e14, 5e13}),
                         [](const auto &info) { return info.param.name; });

TEST(RayProbe, MeetsSmallBoxesOnALongLineWhoseMiddleIsTheOrigin)
{
    Random random(6);
    const Vector3 half = Vector3::Constant(1e-3);
    for (int i = 0; i < 100000; ++i)
    {
        const Vector3 end = random.vector(5e6), point = random.uniform(-1, 1) * end;
        ASSERT_TRUE(RayProbe(-end, end).overlaps(FloatBox::around(Box(point - half, point + half)))) << i;
    }
}

TEST(RayProbe, TouchingIsMeeting)
{
    const FloatBox box = {{0, 0, 0}, {1, 1, 1}};
    EXPECT_TRUE(RayProbe({1, 0.5, 0.5}, {2, 0.5, 0.5}).overlaps(box)) << "its beginning";
    EXPECT_TRUE(RayProbe({-1, 0.5, 0.5}, {0, 0.5, 0.5}).overlaps(box)) << "its end";
    EXPECT_TRUE(RayProbe({-1, 1, 1}, {2, 1, 1}).overlaps(box)) << "an edge";
    EXPECT_TRUE(RayProbe({0, 2, 0.5}, {2, 0, 0.5}).overlaps(box)) << "an edge, across";
    EXPECT_TRUE(RayProbe({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}).overlaps(box)) << "a point within";
    EXPECT_TRUE(RayProbe({1, 0.5, 0.5}, {2, 0.5, 0.5}).overlaps({{-1e7f, -1e7f, -1e7f}, {1, 1, 1}})) << "far larger";
    EXPECT_TRUE(RayProbe({0, 0.5, 0.5}, {2, 2.5, 1}).overlaps({{-1e7f, 0.5f, -1e7f}, {0, 1e7f, 1e7f}})) << "the same";
    EXPECT_FALSE(RayProbe({0, 2.001, 0.5}, {2.001, 0, 0.5}).overlaps(box));
    EXPECT_FALSE(RayProbe({1.001, 0.5, 0.5}, {2, 0.5, 0.5}).overlaps(box));
}

TEST(RayProbe, WhatIsInfiniteOrNotANumberIsMet)
{
    const RayProbe line({0, 0, 0}, {1, 2, 3});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(line.overlaps(
        {{-float_infinity, -float_infinity, -float_infinity}, {float_infinity, float_infinity, float_infinity}}));
    EXPECT_TRUE(
        line.overlaps({{-float_infinity, -float_infinity, -float_infinity}, {float_infinity, float_infinity, 1}}));
    EXPECT_TRUE(line.overlaps({{nan, nan, nan}, {nan, nan, nan}}));
}
} // namespace
} // namespace ode_predictive_space
