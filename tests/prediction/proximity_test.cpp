#include "ode_predictive_space/prediction/proximity.h"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

using namespace ode_predictive_space;

namespace
{
constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Envelope ball(const Path &path, double radius, const Deviation &deviation = {})
{
    return {path, deviation, Vector3::Constant(-radius), Vector3::Constant(radius), radius};
}

Path resting_at(const Vector3 &position)
{
    return {position, Vector3::Zero(), Vector3::Zero()};
}

std::vector<double *> numbers_of(Envelope &envelope)
{
    std::vector<double *> numbers = {&envelope.deviation.a, &envelope.deviation.b, &envelope.deviation.c};
    for (Vector3 *vector :
         {&envelope.path.position, &envelope.path.velocity, &envelope.path.acceleration, &envelope.low, &envelope.high})
        for (int axis = 0; axis < 3; ++axis)
            numbers.push_back(&(*vector)[axis]);
    return numbers;
}
} // namespace

TEST(FirstRoot, does_not_cancel)
{
    // The textbook's form would subtract numbers that differ only in their last digits.
    EXPECT_NEAR(*first_root(1e-9, -1, 1), 0.5, 1e-9);
    EXPECT_NEAR(*first_root(1, -1e9, 1), 0.5e-9, 1e-23);
    EXPECT_NEAR(*first_root(-1, -1e9, 1), 0.5e-9, 1e-23);
    // For A < 0 < B, C / (sqrt(D) - B) would do so; it would even find no root.
    EXPECT_DOUBLE_EQ(*first_root(-3, 1, 1e-18), 2.0 / 3);
}

TEST(TimeOfProximity, infinite_bounds)
{
    // A floor, the half space z <= 0, has no sphere.
    Envelope floor = ball(resting_at(Vector3::Zero()), unbounded);
    floor.high.z() = 0;
    const Envelope falling = ball({Vector3(1e6, 0, 5), Vector3(0, 0, -1), Vector3::Zero()}, 1);
    const Envelope hovering = ball({Vector3(1e6, 0, 5), Vector3(3, 0, 0), Vector3::Zero()}, 1);
    EXPECT_NEAR(*box_time_of_proximity(floor, falling, 10), 4, 1e-8);
    EXPECT_NEAR(*box_time_of_proximity(falling, floor, 10), 4, 1e-8);
    EXPECT_FALSE(box_time_of_proximity(floor, hovering, 10));
    EXPECT_FALSE(box_time_of_proximity(hovering, floor, 10));
    EXPECT_EQ(sphere_time_of_proximity(floor, hovering, 10), 0.0);
    EXPECT_EQ(box_time_of_proximity(floor, floor, 10), 0.0);

    Envelope ceiling = ball(resting_at(Vector3(0, 0, 20)), unbounded);
    ceiling.low.z() = 0;
    EXPECT_FALSE(box_time_of_proximity(floor, ceiling, 10));
    const Envelope everywhere = ball(resting_at(Vector3::Zero()), unbounded);
    EXPECT_EQ(box_time_of_proximity(everywhere, hovering, 10), 0.0);
}

TEST(TimeOfProximity, nothing_is_apart_that_is_not_a_number)
{
    const Envelope first = ball(resting_at(Vector3::Zero()), 1);
    const Envelope far = ball({Vector3(50, 60, 70), Vector3(1, 2, 3), Vector3(1, 0, 0)}, 1, {0.1, 0.1, 0.1});
    ASSERT_FALSE(box_time_of_proximity(first, far, 10));
    ASSERT_FALSE(sphere_time_of_proximity(first, far, 10));
    Envelope broken = far;
    const std::vector<double *> numbers = numbers_of(broken);
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
        *numbers[i] = not_a_number;
        const std::optional<double> expected = i < 12 ? std::optional(0.0) : std::nullopt; // the others are of its box
        EXPECT_EQ(sphere_time_of_proximity(first, broken, 10), expected) << "number " << i;
        broken = far;
    }
    broken.radius = not_a_number;
    EXPECT_EQ(sphere_time_of_proximity(first, broken, 10), 0.0);
}

// The boxes are apart on one side only. A NaN on that side, or in the deviation, may stand for anything.
TEST(TimeOfProximity, no_side_of_a_box_is_apart_that_is_not_a_number)
{
    const Envelope first = ball(resting_at(Vector3::Zero()), 1);
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0})
        {
            const Vector3 along = sign * Vector3::Unit(axis);
            const Envelope far = ball({50 * along, along, along}, 1, {0.1, 0.1, 0.1});
            ASSERT_FALSE(box_time_of_proximity(first, far, 10));
            Envelope broken = far;
            const std::vector<double *> numbers = numbers_of(broken);
            const std::size_t facing = sign > 0 ? 12 : 15; // its low side or its high side
            for (std::size_t i : {0, 1, 2, 3 + axis, 6 + axis, 9 + axis, static_cast<int>(facing) + axis})
            {
                *numbers[i] = not_a_number;
                EXPECT_EQ(box_time_of_proximity(first, broken, 10), 0.0) << "number " << i;
                EXPECT_EQ(box_time_of_proximity(broken, first, 10), 0.0) << "number " << i;
                broken = far;
            }
        }
}

TEST(TimeOfProximity, infinite_and_huge_positions_are_not_apart_by_mistake)
{
    const Envelope first = ball(resting_at(Vector3::Zero()), 1);
    const Envelope lost = ball(resting_at(Vector3(unbounded, 0, 0)), 1);
    EXPECT_FALSE(box_time_of_proximity(first, lost, 10)) << "its box is, as ODE compares them";
    EXPECT_EQ(sphere_time_of_proximity(first, lost, 10), 0.0);
    EXPECT_EQ(box_time_of_proximity(lost, lost, 10), 0.0);
    const Envelope huge = ball(resting_at(Vector3(1e200, 0, 0)), 1);
    EXPECT_EQ(sphere_time_of_proximity(huge, huge, 10), 0.0);
    const Envelope far = ball({Vector3(1e12, 0, 0), Vector3(1e6, 0, 0), Vector3::Zero()}, 1);
    EXPECT_FALSE(box_time_of_proximity(first, far, 10));
    EXPECT_FALSE(sphere_time_of_proximity(first, far, 10));
}
