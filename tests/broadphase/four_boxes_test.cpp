#include "ode_predictive_space/broadphase/base/four_boxes.h"

#include <gtest/gtest.h>

#include "tests/broadphase/support/numbers.h"
#include "tests/broadphase/support/random.h"

namespace ode_predictive_space
{
namespace
{
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
