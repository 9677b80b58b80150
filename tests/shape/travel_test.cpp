// A pair is postponed until its gap may have closed, however its shapes move and turn: no point moves farther than their travel.

#include <gtest/gtest.h>

#include "tests/shape/random_shapes.h"

namespace ode_predictive_space
{
namespace
{
TEST(Travel, MovesNoPointFartherThanItSays)
{
    ShapeMaker maker(1);
    for (int i = 0; i < 500000; ++i)
    {
        const SolidKind solid = solids[static_cast<std::size_t>(maker.between(0, 4.999))];
        const ConvexShape before = moved(maker.shape(solid), maker.rotation(), maker.vector());
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(maker.between(0, maker.one_in(2) ? 3 : 0.01), maker.direction()).toRotationMatrix();
        const ConvexShape after = moved(before, turn, maker.between(0, 0.1) * maker.vector());
        const Vector3 direction = maker.direction();
        const double change =
            direction.dot(after.centre - before.centre) + after.reach(direction) - before.reach(direction);
        ASSERT_LE(std::abs(change), after.moved_from(before) + 1e-13) << "shape " << i;
    }
}

// The travel of the capsule itself would be too small when it turns: a contact could be missed.
TEST(Travel, OfACapsuleBesideMeshesIsThatOfTheCylinderAroundIt)
{
    ShapeMaker maker(1);
    for (int i = 0; i < 100000; ++i)
    {
        ConvexShape capsule = maker.shape(SolidKind::capsule);
        capsule.blunt_beside = 1;
        capsule.blunt_margin = maker.between(0, 0.01);
        const ConvexShape before = moved(capsule, maker.rotation(), maker.vector());
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(maker.between(0, maker.one_in(2) ? 3 : 0.01), maker.direction()).toRotationMatrix();
        const ConvexShape after = moved(before, turn, Vector3::Zero());
        const Vector3 direction = maker.direction();
        const double change = after.blunt().reach(direction) - before.blunt().reach(direction);
        ASSERT_LE(std::abs(change), after.moved_from(before) + 1e-13) << "capsule " << i;
    }
}
} // namespace
} // namespace ode_predictive_space
