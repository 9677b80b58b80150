#include "ode_predictive_space/broadphase/base/measured_box.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
// As ODE compares: what is not a number overlaps.
bool overlap(const Box &one, const Box &other)
{
    for (int axis = 0; axis < 3; ++axis)
        if (one.min()[axis] > other.max()[axis] || one.max()[axis] < other.min()[axis])
            return false;
    return true;
}

// Says nothing wrong, in either order; returns whether it says anything.
bool decides(const Box &one, const Box &other)
{
    const MeasuredBox first(one), second(other);
    const Comparison forth = compare(first, second), back = compare(second, first);
    EXPECT_EQ(forth.apart(), back.apart());
    EXPECT_EQ(forth.overlap(), back.overlap());
    EXPECT_EQ(forth.apart() + forth.overlap() + forth.unsure(), 1);
    EXPECT_FALSE(forth.apart() && overlap(one, other));
    EXPECT_FALSE(forth.overlap() && !overlap(one, other));
    return !forth.unsure();
}

Box cube_between(double low, double high)
{
    return Box(Vector3::Constant(low), Vector3::Constant(high));
}

TEST(MeasuredBox, DecidesAlmostAlways)
{
    Random random(1);
    for (double place : {0.0, 1.0, -1000.0})
    {
        int decided = 0;
        constexpr int pairs = 20000;
        for (int i = 0; i < pairs; ++i)
        {
            const Vector3 shift = Vector3::Constant(place), half = random.vector(1).cwiseAbs();
            const Vector3 one = shift + random.vector(1), other = shift + random.vector(1);
            decided += decides(Box(one - half, one + half), Box(other - half, other + half));
            ASSERT_FALSE(HasFailure()) << i;
        }
        EXPECT_GT(decided, 99 * pairs / 100) << place;
    }
}

TEST(MeasuredBox, IsUnsureOfWhatTouches)
{
    for (double place : {0.1, 3.7, 1e5 / 3, -1e9 / 7})
        for (double gap : {0.0, 1e-12, -1e-12})
        {
            const double edge = place + 1;
            EXPECT_FALSE(decides(cube_between(place, edge),
                                 cube_between(edge + gap * std::abs(edge), place + 2 + std::abs(place))));
        }
}

TEST(MeasuredBox, IsUnsureOfWhatIsNotFinite)
{
    // A highest coordinate at minus infinity is none that a geom should have.
    for (double bad : {nan, -infinity, 1e300, -1e300})
        for (int axis = 0; axis < 3; ++axis)
        {
            Box box = cube_between(-1, 1);
            box.max()[axis] = bad;
            EXPECT_FALSE(decides(box, cube_between(-1, 1)));
            EXPECT_FALSE(decides(box, cube_between(5, 6)));
            EXPECT_FALSE(decides(box, box));
            EXPECT_TRUE(MeasuredBox(box).outer().overlaps(FloatBox::around(cube_between(1e6, 1e7))))
                << "it may be anywhere";
        }
}

// Planes have such boxes, and everything that lies on one is near it.
TEST(MeasuredBox, KnowsSidesThatLieAtInfinity)
{
    for (int axis = 0; axis < 3; ++axis)
    {
        Box ground = cube_between(-infinity, infinity);
        ground.max()[axis] = 0;
        EXPECT_TRUE(compare(MeasuredBox(ground), MeasuredBox(cube_between(-1, 1))).overlap());
        EXPECT_TRUE(compare(MeasuredBox(ground), MeasuredBox(cube_between(0.1, 1))).apart());
        EXPECT_TRUE(compare(MeasuredBox(ground), MeasuredBox(ground)).overlap());
        EXPECT_FALSE(decides(ground, cube_between(0, 1))) << "it touches";
        EXPECT_TRUE(MeasuredBox(ground).outer().overlaps(FloatBox::around(cube_between(-1e30, -1e29))));
        EXPECT_FALSE(MeasuredBox(ground).outer().overlaps(FloatBox::around(cube_between(0.1, 1))));
    }
}

TEST(MeasuredBox, OuterHoldsTheBox)
{
    Random random(2);
    for (int i = 0; i < 20000; ++i)
    {
        const Vector3 half = random.vector(1).cwiseAbs(), centre = random.vector(i % 2 ? 1 : 1e6);
        const Box box(centre - half, centre + half);
        const FloatBox outer = MeasuredBox(box).outer();
        for (int axis = 0; axis < 3; ++axis)
        {
            ASSERT_LE(outer.low[axis], box.min()[axis]);
            ASSERT_GE(outer.high[axis], box.max()[axis]);
        }
    }
}

TEST(MeasuredBox, OfASceneInSinglePrecisionIsNoWorse)
{
    Random random(3);
    for (int i = 0; i < 20000; ++i)
    {
        float sides[6];
        for (float &side : sides)
            side = static_cast<float>(random.uniform(-10, 10));
        MeasuredBox measured;
        measured.assign(sides);
        const FloatBox outer = measured.outer();
        for (int axis = 0; axis < 3; ++axis)
        {
            ASSERT_LE(outer.low[axis], sides[2 * axis]);
            ASSERT_GE(outer.high[axis], sides[2 * axis + 1]);
            ASSERT_GE(outer.low[axis], sides[2 * axis] - 1e-5f);
            ASSERT_LE(outer.high[axis], sides[2 * axis + 1] + 1e-5f);
        }
    }
}

TEST(MeasuredBox, IsUnknownUntilItIsMeasured)
{
    EXPECT_TRUE(MeasuredBox().outer().overlaps(FloatBox::around(cube_between(1e6, 1e7))));
}

Float4 lanes(const Vector3 &axes)
{
    return Float4::nearest(axes.data());
}

TEST(MeasuredBox, IsInsideOnlyWhereThatIsCertain)
{
    const MeasuredBox box(cube_between(-1, 1));
    EXPECT_TRUE(box.inside(lanes(Vector3::Constant(-1.001)), lanes(Vector3::Constant(1.001))));
    for (int axis = 0; axis < 3; ++axis)
    {
        Vector3 low = Vector3::Constant(-2), high = Vector3::Constant(2);
        low[axis] = -1;
        EXPECT_FALSE(box.inside(lanes(low), lanes(high))) << "too close to tell";
        low[axis] = -2;
        high[axis] = 0.5;
        EXPECT_FALSE(box.inside(lanes(low), lanes(high)));
        high[axis] = nan;
        EXPECT_FALSE(box.inside(lanes(low), lanes(high)));
    }
    EXPECT_FALSE(MeasuredBox(cube_between(nan, nan)).inside(lanes(Vector3::Constant(-2)), lanes(Vector3::Constant(2))));
}
} // namespace
} // namespace ode_predictive_space
