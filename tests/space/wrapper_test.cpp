#include <type_traits>

#include <ode_predictive_space/predictive_space.hpp>

#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Wrapper = OdeTest;

static_assert(std::is_base_of<dSpace, dPredictiveSpace>::value, "it is used where any dSpace is");
static_assert(!std::is_copy_constructible<dPredictiveSpace>::value, "a copy would destroy the space twice");
static_assert(!std::is_copy_assignable<dPredictiveSpace>::value, "a copy would destroy the space twice");

TEST_F(Wrapper, MayHaveAParent)
{
    dPredictiveSpace outer;
    dPredictiveSpace in_wrapper(static_cast<dSpace &>(outer));
    dPredictiveSpace in_handle(outer.id());
    EXPECT_EQ(outer.getNumGeoms(), 2);
    EXPECT_EQ(outer.query(as_geom(in_wrapper.id())), 1);
    EXPECT_EQ(outer.query(as_geom(in_handle.id())), 1);
}

TEST_F(Wrapper, PassesEverythingOn)
{
    dPredictiveSpace space;
    dSphere first(space.id(), 1);
    dSphere second(space.id(), 1);
    second.setPosition(5, 0, 0);

    space.setProximity(dPredictiveProximitySphere);
    EXPECT_EQ(dPredictiveSpaceGetProximity(space.id()), dPredictiveProximitySphere);
    EXPECT_EQ(space.getProximity(), dPredictiveProximitySphere);

    space.setGeomRole(first.id(), dPredictiveRoleInteractive);
    EXPECT_EQ(dPredictiveSpaceGetGeomRole(space.id(), first.id()), dPredictiveRoleInteractive);
    EXPECT_EQ(space.getGeomRole(first.id()), dPredictiveRoleInteractive);

    space.setDeviation(dPredictiveRoleInteractive, 1, 2, 3);
    dReal a = 0, b = 0, c = 0;
    EXPECT_EQ(space.getDeviation(dPredictiveRoleInteractive, &a, &b, &c), 1);
    EXPECT_EQ(a * 100 + b * 10 + c, 123);

    space.setShapeMargin(0.25);
    EXPECT_EQ(dPredictiveSpaceGetShapeMargin(space.id()), 0.25);
    EXPECT_EQ(space.getShapeMargin(), 0.25);

    space.prepare();
    space.setHorizon(4, 44);
    int min_ticks = 0, max_ticks = 0;
    space.getHorizon(&min_ticks, &max_ticks);
    EXPECT_EQ(min_ticks, 4);
    EXPECT_EQ(max_ticks, 44);

    collide(space.id());
    EXPECT_EQ(space.getStats().ticks, 1u);
    EXPECT_EQ(space.getCounters().unchanged, 0u);
    second.setPosition(0.5, 0, 0);
    dReal ticks = -1;
    EXPECT_EQ(space.getTimeOfProximity(first.id(), second.id(), &ticks), 1);
    EXPECT_EQ(ticks, 0);
    dPredictiveEncounter encounter;
    EXPECT_EQ(space.getEncounters(first.id(), &encounter, 1), 1);
    EXPECT_EQ(encounter.geom, second.id());
    EXPECT_EQ(space.validate(), 1);
}
} // namespace
} // namespace ode_predictive_space
