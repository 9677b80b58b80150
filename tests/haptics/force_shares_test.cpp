#include "ode_predictive_space/haptics/law/force_shares.h"

#include <gtest/gtest.h>
#include <random>

namespace ode_predictive_space::haptics
{
namespace
{
Touch touch_of(std::uintptr_t object)
{
    Touch touch;
    touch.object = object;
    touch.point = Vector3(static_cast<double>(object), 0, 0);
    return touch;
}

Vector3 share_of(const ForceSplit &split, std::uintptr_t object)
{
    for (const ForceShare &share : split.shares())
        if (share.object == object)
            return share.force;
    return Vector3::Zero();
}

Vector3 total(const ForceSplit &split)
{
    Vector3 sum = Vector3::Zero();
    for (const ForceShare &share : split.shares())
        sum += share.force;
    return sum;
}

TEST(ForceSplit, WhatIsNotLimitedIsAsRequested)
{
    ForceSplit split;
    const TouchForces requested = {{1, 0, 0}, {0, 2, 0}};
    split.split({touch_of(1), touch_of(2)}, requested, {1, 2, 0});
    EXPECT_LE((share_of(split, 1) - requested[0]).norm(), 1e-15);
    EXPECT_LE((share_of(split, 2) - requested[1]).norm(), 1e-15);
}

TEST(ForceSplit, AClampedForceIsSharedInProportion)
{
    ForceSplit split;
    split.split({touch_of(1), touch_of(2)}, {{10, 0, 0}, {0, 20, 0}}, {1, 2, 0});
    EXPECT_LE((share_of(split, 1) - Vector3(1, 0, 0)).norm(), 1e-15);
    EXPECT_LE((share_of(split, 2) - Vector3(0, 2, 0)).norm(), 1e-15);
}

TEST(ForceSplit, AForceThatLagsBelongsToWhoMadeIt)
{
    ForceSplit split;
    split.split({touch_of(1)}, {{4, 0, 0}}, {4, 0, 0});
    // The first is left, the second pushes in another direction; the force is half way between.
    split.split({touch_of(2)}, {{0, 6, 0}}, {2, 3, 0});
    EXPECT_LE((share_of(split, 1) - Vector3(2, 0, 0)).norm(), 1e-14);
    EXPECT_LE((share_of(split, 2) - Vector3(0, 3, 0)).norm(), 1e-14);
    // And on, with nothing touched.
    split.split({}, {}, {1, 1.5, 0});
    EXPECT_LE((share_of(split, 1) - Vector3(1, 0, 0)).norm(), 1e-14);
    EXPECT_EQ(split.shares().size(), 2U);
}

TEST(ForceSplit, OfOneDirectionTheWishComesFirst)
{
    ForceSplit split;
    split.split({touch_of(1)}, {{5, 0, 0}}, {5, 0, 0});
    split.split({touch_of(2)}, {{1, 0, 0}}, {4, 0, 0});
    EXPECT_LE((share_of(split, 2) - Vector3(1, 0, 0)).norm(), 1e-15);
    EXPECT_LE((share_of(split, 1) - Vector3(3, 0, 0)).norm(), 1e-15);
}

TEST(ForceSplit, TheSumIsAlwaysWhatWasGiven)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-5, 5);
    const auto vector = [&] { return Vector3(number(random), number(random), number(random)); };
    ForceSplit split;
    for (int tick = 0; tick < 2000; ++tick)
    {
        std::vector<Touch> touches;
        TouchForces requested;
        for (std::uintptr_t object = 1 + random() % 3; object < 5; object += 1 + random() % 3)
        {
            touches.push_back(touch_of(object));
            requested.push_back(vector());
        }
        const Vector3 given = vector();
        split.split(touches, requested, given);
        ASSERT_LE((total(split) - given).norm(), 1e-13) << tick;
    }
}

/// What an object gets of 2 N, with 1 N of free space beside it.
TEST(ForceSplit, AForceInFreeSpaceHasAShareOfItsOwn)
{
    ForceSplit split;
    const TouchForces requested = {{0, 0, 2}, {-1, 0, 0}, {0, 0, -0.5}};
    for (int tick = 0; tick < 3; ++tick)
    {
        split.split({touch_of(1)}, requested, {-1, 0, 1.5});
        EXPECT_LE((share_of(split, 1) - requested[0]).norm(), 1e-15);
        EXPECT_LE((total(split) - Vector3(-1, 0, 1.5)).norm(), 1e-15);
    }
    // Clamped, all are shortened alike.
    split.clear();
    split.split({touch_of(1)}, requested, {-0.5, 0, 0.75});
    split.split({touch_of(1)}, requested, {-0.5, 0, 0.75});
    EXPECT_LE((share_of(split, 1) - 0.5 * requested[0]).norm(), 1e-12);
}

TEST(ForceSplit, WithoutATouchFreeSpaceAloneHasAShare)
{
    ForceSplit split;
    split.split({}, {{0, 3, 0}}, {0, 3, 0});
    ASSERT_EQ(split.shares().size(), 1U);
    EXPECT_EQ(split.shares()[0].object, free_space);
    EXPECT_EQ(split.shares()[0].force, Vector3(0, 3, 0));
}

TEST(ForceSplit, WithoutATouchNobodyGetsAnything)
{
    ForceSplit split;
    split.split({}, {}, {1, 0, 0});
    EXPECT_TRUE(split.shares().empty());
    split.split({touch_of(1)}, {{1, 0, 0}}, {1, 0, 0});
    split.clear();
    EXPECT_TRUE(split.shares().empty());
}
} // namespace
} // namespace ode_predictive_space::haptics
