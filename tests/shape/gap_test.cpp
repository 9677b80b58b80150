// The gap is never above the distance of the shapes, and seldom far below it.

#include "ode_predictive_space/broadphase/shape/gap.h"

#include <gtest/gtest.h>

#include "tests/shape/random_shapes.h"
#include "tests/support/effort.h"

namespace ode_predictive_space
{
namespace
{
constexpr int pairs_of_classes = 20; // pairs of six classes, without that of two planes
#ifdef ODE_PREDICTIVE_SPACE_LONG_TEST
constexpr int poses = 1000000;
#else
constexpr int poses = of_cases(600000) / pairs_of_classes;
#endif
constexpr double rounding = 1e-13;

struct NearShapes
{
    ConvexShape first, second;

    NearShapes(ShapeMaker &maker, SolidKind one, SolidKind other)
        : first(moved(maker.shape(one), maker.rotation(), maker.vector())), second(maker.shape(other))
    {
        second = moved(second, maker.rotation(), maker.vector());
        const Vector3 direction = maker.direction();
        const double away = maker.between(0, 1.2) * (extent(first) + extent(second));
        second.centre = first.centre + away * direction;
        if (one == SolidKind::plane)
            second.centre = first.centre + maker.between(-1, 2) * extent(second) * first.axes[0] + maker.vector();
        else if (other == SolidKind::plane)
            second.centre = first.centre - maker.between(-1, 2) * extent(first) * second.axes[0];
    }

    static double extent(const ConvexShape &shape) { return shape.half_sides.norm() + shape.radius; }
};

template <typename Visit> void for_each_pair_of_classes(Visit visit)
{
    for (SolidKind one : solids)
        for (SolidKind other : solids)
            if (one <= other && !(one == SolidKind::plane && other == SolidKind::plane))
                visit(one, other);
}

TEST(Gap, IsNeverMoreThanTheDistance)
{
    unsigned seed = 1;
    for_each_pair_of_classes([&](SolidKind one, SolidKind other) {
        ShapeMaker maker(seed++);
        long apart = 0;
        for (int i = 0; i < poses; ++i)
        {
            const NearShapes shapes = maker.one_in(2) ? NearShapes(maker, one, other) : NearShapes(maker, other, one);
            const Vector3 axis = maker.one_in(2) ? maker.direction() : Vector3(0, 0, 0);
            const double least = maker.one_in(2) ? 0 : maker.between(0, 0.5);
            const Gap gap = find_gap(shapes.first, shapes.second, axis, least);
            apart += gap.length > 0;
            ASSERT_LE(gap.length, distance_from_above(shapes.first, shapes.second, 8) + rounding)
                << "classes " << static_cast<int>(one) << " " << static_cast<int>(other) << ", pose " << i;
            if (gap.length > 0 && i % 8 == 0)
            {
                ConvexShape farther = shapes.second;
                farther.centre += gap.axis;
                ASSERT_GE(distance_from_above(shapes.first, farther, 8), gap.length + gap.axis.norm() - rounding)
                    << "the axis is from the first to the second; pose " << i;
            }
        }
        EXPECT_GT(apart, poses / 10) << "too few are apart for a test";
    });
}

TEST(Gap, IsSeldomFarLessThanTheDistance)
{
    unsigned seed = 100;
    for_each_pair_of_classes([&](SolidKind one, SolidKind other) {
        ShapeMaker maker(seed++);
        int apart = 0, precise = 0;
        for (int i = 0; i < of_cases(3000); ++i)
        {
            const NearShapes shapes(maker, one, other);
            const double distance = distance_from_above(shapes.first, shapes.second, 100);
            if (distance < 1e-3)
                continue;
            ++apart;
            precise += find_gap(shapes.first, shapes.second, Vector3::Zero(), 0).length > 0.5 * distance;
        }
        EXPECT_GT(apart, of_cases(3000) / 10);
        EXPECT_GT(precise, 0.95 * apart) << "classes " << static_cast<int>(one) << " " << static_cast<int>(other);
    });
}

} // namespace
} // namespace ode_predictive_space
