#include "ode_predictive_space/preload/pairs.h"

#include "tests/contract/support/ode_test.h"

namespace ode_predictive_space::preload
{
namespace
{
// ODE's rule: the space with the higher sublevel, or else with more geoms, is queried for the geoms of the other.
TEST_F(OdeTest, OfTwoSpacesOneIsAsked)
{
    const dSpaceID larger = dSimpleSpaceCreate(nullptr), smaller = dSimpleSpaceCreate(nullptr);
    const dGeomID geom = dCreateSphere(larger, 1);
    const auto as_geom = [](dSpaceID space) { return reinterpret_cast<dGeomID>(space); };
    EXPECT_EQ(asked_space(as_geom(larger), as_geom(smaller)), larger);
    EXPECT_EQ(asked_space(as_geom(smaller), as_geom(larger)), larger);
    EXPECT_EQ(asked_space(geom, as_geom(smaller)), smaller);
    dSpaceSetSublevel(smaller, 1);
    EXPECT_EQ(asked_space(as_geom(larger), as_geom(smaller)), smaller);
    dSpaceDestroy(smaller);
    dSpaceDestroy(larger);
}
} // namespace
} // namespace ode_predictive_space::preload
