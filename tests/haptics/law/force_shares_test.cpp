#include "ode_predictive_space/haptics/law/force_shares.h"

#include <gtest/gtest.h>

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

TEST(ForceSplit, AClampedForceIsSharedInProportion)
{
    ForceSplit split;
    split.split({touch_of(1), touch_of(2)}, {{10, 0, 0}, {0, 20, 0}}, {1, 2, 0});
    EXPECT_LE((share_of(split, 1) - Vector3(1, 0, 0)).norm(), 1e-15);
    EXPECT_LE((share_of(split, 2) - Vector3(0, 2, 0)).norm(), 1e-15);
    ForceSplit damped; // along an axis of which no touch has a part
    damped.split({touch_of(1), touch_of(2)}, {{10, 0, 0}, {0, 20, 0}}, {1, 2, 3});
    EXPECT_LE((share_of(damped, 2) - Vector3(0, 2, 3)).norm(), 1e-15) << "the largest one gets the rest";
}

TEST(ForceSplit, AForceThatLagsBelongsToWhoMadeIt)
{
    ForceSplit split;
    split.split({touch_of(1)}, {{4, 0, 0}}, {4, 0, 0});
    // The tool went from the first object to the second; the force is halfway between theirs.
    split.split({touch_of(2)}, {{0, 6, 0}}, {2, 3, 0});
    EXPECT_LE((share_of(split, 1) - Vector3(2, 0, 0)).norm(), 1e-14);
    EXPECT_LE((share_of(split, 2) - Vector3(0, 3, 0)).norm(), 1e-14);
    // The force fades further without a touch.
    split.split({}, {}, {1, 1.5, 0});
    EXPECT_LE((share_of(split, 1) - Vector3(1, 0, 0)).norm(), 1e-14);
    EXPECT_EQ(split.shares().size(), 2U);
}

TEST(ForceSplit, OfParallelForcesThePresentOneComesFirst)
{
    ForceSplit split;
    split.split({touch_of(1)}, {{4, 0, 0}}, {4, 0, 0});
    split.split({touch_of(2)}, {{2, 0, 0}}, {3, 0, 0});
    EXPECT_LE((share_of(split, 2) - Vector3(2, 0, 0)).norm(), 1e-15);
    EXPECT_LE((share_of(split, 1) - Vector3(1, 0, 0)).norm(), 1e-15);
    split.split({touch_of(3)}, {{6, 0, 0}}, {3, 0, 0});
    EXPECT_LE((share_of(split, 3) - Vector3(3, 0, 0)).norm(), 1e-15);
    EXPECT_EQ(split.shares().size(), 1U) << "the former ones have ended";
}

TEST(ForceSplit, AForceThatLagsStaysWhereTheObjectWasTouched)
{
    ForceSplit split;
    Touch here = touch_of(1), there = touch_of(1);
    here.id = 1;
    there.id = 2;
    there.point = Vector3(0, 3, 0);
    here.arm = Vector3(0, 0, 1);
    split.split({here}, {{4, 0, 0}}, {4, 0, 0});
    split.split({there}, {{0, 6, 0}}, {2, 3, 0});
    ASSERT_EQ(split.shares().size(), 2U);
    for (const ForceShare &share : split.shares())
    {
        EXPECT_LE((share.force - (share.touch == 1 ? Vector3(2, 0, 0) : Vector3(0, 3, 0))).norm(), 1e-14);
        EXPECT_EQ(share.arm, (share.touch == 1 ? here : there).arm);
        EXPECT_EQ(share.point, (share.touch == 1 ? here : there).point);
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
