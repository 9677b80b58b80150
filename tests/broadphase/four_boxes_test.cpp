#include "ode_predictive_space/broadphase/base/four_boxes.h"

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
constexpr FloatBox all_of_space = {{-float_infinity, -float_infinity, -float_infinity},
                                   {float_infinity, float_infinity, float_infinity}};

TEST(FourBoxes, HoldTheBoxesThatAreSetAndTheBoxAroundThem)
{
    Random random(1);
    for (int i = 0; i < 1000; ++i)
    {
        FourBoxes boxes;
        FloatBox merged{};
        const std::size_t count = 1 + random.index(FourBoxes::most);
        for (std::size_t place = 0; place < count; ++place)
        {
            const FloatBox box = random.box(1, 1);
            boxes.set(place, box);
            ASSERT_TRUE(boxes[place] == box);
            merged = place == 0 ? box : merged.merged(box);
        }
        ASSERT_TRUE(boxes.merged() == merged) << count;
        const FloatBox more = random.box(2, 1), enlarged = boxes[0].merged(more);
        boxes.enlarge(0, more);
        ASSERT_TRUE(boxes[0] == enlarged);
    }
}

TEST(FourBoxes, APlaceWithoutABoxOverlapsNothingThatIsBounded)
{
    const float far = 0.999e15f;
    const FloatBox most_of_space = {{-far, -far, -far}, {far, far, far}};
    ASSERT_TRUE(most_of_space.bounded());
    FourBoxes boxes;
    EXPECT_EQ(BoxProbe(most_of_space).overlaps(boxes), 0u);
    boxes.set(2, all_of_space);
    EXPECT_EQ(BoxProbe(most_of_space).overlaps(boxes), 4u);
    boxes.clear(2);
    EXPECT_EQ(BoxProbe(most_of_space).overlaps(boxes), 0u);
}

TEST(BoxProbe, AnswersForEachAsTheBoxDoesAtInfinityAndInTouch)
{
    const float sides[] = {-float_infinity, -largest_float, -1, -0.0f, 0, 1, largest_float, float_infinity};
    Random random(6);
    auto any_box = [&] {
        FloatBox box;
        for (int axis = 0; axis < 3; ++axis)
        {
            box.low[axis] = sides[random.index(8)];
            box.high[axis] = sides[random.index(8)];
        }
        return box;
    };
    int overlaps = 0;
    for (int i = 0; i < 100000; ++i)
    {
        const FloatBox box = any_box();
        FourBoxes others;
        unsigned expected = 0;
        for (std::size_t place = 0; place < FourBoxes::most; ++place)
        {
            others.set(place, any_box());
            expected |= (box.overlaps(others[place]) ? 1u : 0u) << place;
            overlaps += box.overlaps(others[place]);
        }
        ASSERT_EQ(BoxProbe(box).overlaps(others), expected) << i;
    }
    EXPECT_GT(overlaps, 1000);
}
} // namespace
} // namespace ode_predictive_space
