#include "demos/ode/demo_probe.h"

#include <gtest/gtest.h>
#include <ode/ode.h>

namespace ode_predictive_space::ode_demos
{
namespace
{
TEST(DemoProbe, TakesItsOwnPairsFromTheDemoAndNoOthers)
{
    dInitODE2(0);
    const dSpaceID space = dSimpleSpaceCreate(nullptr);
    const dGeomID first = dCreateSphere(space, 1);
    const dGeomID second = dCreateSphere(space, 1);
    const dReal bounds[6] = {-1, 1, -1, 1, 0, 1};
    char program[] = "demo";
    char option[] = "-probe";
    char device[] = "hand-path";
    char *arguments[] = {program, option, device, nullptr};

    demoProbeOptions(3, arguments);
    demoProbeSpace(space, bounds);
    EXPECT_EQ(demoProbeTouch(first, second), 0);
    demoProbeStep();
    ASSERT_EQ(dSpaceGetNumGeoms(space), 3);
    dGeomID probe = nullptr;
    for (int i = 0; i < 3; ++i)
    {
        const dGeomID geom = dSpaceGetGeom(space, i);
        probe = geom == first || geom == second ? probe : geom;
    }
    EXPECT_NE(demoProbeTouch(probe, first), 0);
    EXPECT_NE(demoProbeTouch(second, probe), 0);
    EXPECT_EQ(demoProbeTouch(first, second), 0);
    demoProbeDestroy();
    EXPECT_EQ(dSpaceGetNumGeoms(space), 2);

    dSpaceDestroy(space);
    dCloseODE();
}
} // namespace
} // namespace ode_predictive_space::ode_demos
