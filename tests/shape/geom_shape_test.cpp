// How far a geom has moved, as the space sees it.

#include <cmath>

#include <gtest/gtest.h>

#include "ode_predictive_space/space/geom_shape.h"
#include "tests/contract/support/ode_test.h"

namespace ode_predictive_space
{
namespace
{
class FollowedGeom : public OdeTest
{
protected:
    double moved(dGeomID geom) { return follow_geom(geom, hulls_, shape_); }

    HullStore hulls_;
    ConvexShape shape_;
};

TEST_F(FollowedGeom, IsNewAtFirst)
{
    const dGeomID sphere = dCreateSphere(nullptr, 1);
    EXPECT_TRUE(std::isinf(moved(sphere)));
    EXPECT_EQ(moved(sphere), 0);
    dGeomDestroy(sphere);
}

TEST_F(FollowedGeom, OfASphereItsGrowthCountsAsMotion)
{
    const dGeomID sphere = dCreateSphere(nullptr, 1);
    moved(sphere);
    dGeomSphereSetRadius(sphere, REAL(1.5));
    dGeomSetPosition(sphere, 0, 0, 2);
    const double grown = moved(sphere);
    EXPECT_GE(grown, 2 + 0.5 * (1 + 2e-3)) << "the gap's change and the margin's";
    EXPECT_LE(grown, 2 + 0.5 * 1.02);
    EXPECT_EQ(shape_.radius, 1.5);
    dGeomSphereSetRadius(sphere, 1);
    EXPECT_EQ(moved(sphere), 0) << "no gap becomes less";
    EXPECT_EQ(shape_.radius, 1);
    dGeomDestroy(sphere);
}

TEST_F(FollowedGeom, ASphereThatHadNoSizeIsNew)
{
    const dGeomID sphere = dCreateSphere(nullptr, 0);
    EXPECT_TRUE(std::isinf(moved(sphere)));
    dGeomSphereSetRadius(sphere, 1);
    EXPECT_TRUE(std::isinf(moved(sphere)));
    dGeomSphereSetRadius(sphere, 0);
    EXPECT_TRUE(std::isinf(moved(sphere)));
    dGeomDestroy(sphere);
}

TEST_F(FollowedGeom, AnyOtherOfAnotherSizeIsNew)
{
    const dGeomID box = dCreateBox(nullptr, 1, 1, 1);
    moved(box);
    dGeomBoxSetLengths(box, 1, 1, 2);
    EXPECT_TRUE(std::isinf(moved(box)));
    dGeomDestroy(box);
}
} // namespace
} // namespace ode_predictive_space
