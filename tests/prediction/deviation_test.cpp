#include "ode_predictive_space/prediction/deviation.h"

#include <gtest/gtest.h>

using namespace ode_predictive_space;

TEST(Deviation, grows_from_a)
{
    const Deviation deviation = {1, 2, 3};
    EXPECT_EQ(deviation.at(0), 1);
    EXPECT_EQ(deviation.at(2), 17);
    EXPECT_EQ(deviation.growth(2), 16);
}

TEST(Deviation, advanced_is_the_same_function)
{
    const Deviation deviation = {1, 2, 3};
    const Deviation later = deviation.advanced(4);
    for (const double t : {0.0, 1.0, 7.0})
        EXPECT_EQ(later.at(t), deviation.at(4 + t));
}

TEST(Deviation, sum_is_what_two_objects_may_add_up_to)
{
    const Deviation first = {1, 2, 3};
    const Deviation second = {10, 20, 30};
    EXPECT_EQ((first + second).at(5), first.at(5) + second.at(5));
}

TEST(Deviation, chord_lies_above)
{
    const Deviation deviation = {0.5, 0.25, 0.125};
    const double T = 16;
    for (int i = 0; i <= 16; ++i)
    {
        const double m = i / 16.0;
        EXPECT_LE(deviation.at(m * T), (1 - m) * deviation.at(0) + m * deviation.at(T));
    }
}
