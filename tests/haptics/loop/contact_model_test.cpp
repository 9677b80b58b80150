#include "ode_predictive_space/haptics/loop/contact_model.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
Touch wall(double depth, const Vector3 &normal = Vector3::UnitZ())
{
    Touch touch;
    touch.normal = normal.normalized();
    touch.depth = depth;
    touch.object = 1;
    return touch;
}

TEST(ContactModel, AtItsOwnPlaceAndTimeItIsWhatItWasMadeOf)
{
    ContactModel model;
    Touch touch = wall(0.002);
    touch.point = {1, 2, 3};
    touch.surface_velocity = {0.1, 0.2, 0.3};
    model.set({touch}, true, {0, 0, 1}, 5);
    std::vector<Touch> touches;
    model.evaluate({0, 0, 1}, 5, {}, touches);
    ASSERT_EQ(touches.size(), 1U);
    EXPECT_EQ(touches[0].depth, 0.002);
    EXPECT_EQ(touches[0].point, touch.point);
    EXPECT_EQ(touches[0].object, touch.object);
}

TEST(ContactModel, DepthFollowsTheToolAlongTheNormal)
{
    ContactModel model;
    model.set({wall(0.002, {1, 0, 1})}, true, {0, 0, 1}, 0);
    std::vector<Touch> touches;
    const Vector3 deeper(-0.001, 0.7, -0.001);
    model.evaluate(Vector3(0, 0, 1) + deeper, 0, {}, touches);
    ASSERT_EQ(touches.size(), 1U);
    EXPECT_NEAR(touches[0].depth, 0.002 + 0.001 * std::sqrt(2), 1e-15);
    EXPECT_NEAR(touches[0].point.y(), 0.7, 1e-15) << "the contact goes with the tool along the surface";
    model.evaluate({0.002, 0, 1.001}, 0, {}, touches);
    EXPECT_TRUE(touches.empty()) << "outside";
}

TEST(ContactModel, SurfacesMove)
{
    ContactModel model;
    Touch touch = wall(-0.001); // 1 mm away
    touch.surface_velocity = {0.5, 0, 1};
    model.set({touch}, true, Vector3::Zero(), 10);
    std::vector<Touch> touches;
    model.evaluate(Vector3::Zero(), 10.0005, {}, touches);
    EXPECT_TRUE(touches.empty());
    model.evaluate(Vector3::Zero(), 10.003, {}, touches);
    ASSERT_EQ(touches.size(), 1U);
    EXPECT_NEAR(touches[0].depth, 0.002, 1e-12);
    EXPECT_NEAR(touches[0].point.z(), 0.003, 1e-12);
}

TEST(ContactModel, LeavesOutWhatTheServoKnowsBetter)
{
    ContactModel model;
    Touch held = wall(0.002);
    held.from_entry_side = true;
    model.set({held, wall(0.001)}, true, Vector3::Zero(), 0);
    std::vector<Touch> touches;
    model.evaluate(Vector3::Zero(), 0, {}, touches);
    ASSERT_EQ(touches.size(), 1U);
    EXPECT_EQ(touches[0].depth, 0.001);
}

TEST(ContactModel, KeepsTheDeepestOfTooMany)
{
    std::vector<Touch> many;
    for (int i = 0; i < 1000; ++i)
        many.push_back(wall(0.001 * (i * 37 % 1000)));
    ContactModel model;
    model.set(many, true, Vector3::Zero(), 0);
    EXPECT_EQ(model.count(), touch_capacity);
    std::vector<Touch> touches;
    model.evaluate(Vector3::Zero(), 0, {}, touches);
    for (const Touch &touch : touches)
        EXPECT_GE(touch.depth, 0.744 - 1e-12);
}
} // namespace
} // namespace ode_predictive_space::haptics
