// The order of traced pairs.

#include "ode_predictive_space/preload/pairs.h"

#include <algorithm>
#include <random>

#include "tests/contract/support/ode_test.h"

namespace ode_predictive_space::preload
{
namespace
{
void keep(void *pairs, dGeomID first, dGeomID second)
{
    static_cast<std::vector<Pair> *>(pairs)->emplace_back(first, second);
}

struct TracedPairs : OdeTest
{
    TracedPairs()
    {
        std::mt19937 random(7);
        std::uniform_real_distribution<dReal> place(-4, 4);
        for (int i = 0; i < 50; ++i)
            dGeomSetPosition(i % 3 ? dCreateSphere(space, 1) : dCreateBox(space, 1, 2, 1), place(random), place(random),
                             place(random));
        dCreatePlane(space, 0, 0, 1, 0);
        dSpaceCollide(space, &pairs, &keep);
    }
    ~TracedPairs() override { dSpaceDestroy(space); }

    dSpaceID space = dSimpleSpaceCreate(nullptr);
    std::vector<Pair> pairs;
};

TEST_F(TracedPairs, OrderDoesNotDependOnHowTheyCame)
{
    ASSERT_GT(pairs.size(), 20u);
    std::vector<Pair> turned;
    for (const Pair &pair : pairs)
        turned.insert(turned.begin(), Pair(pair.second, pair.first));
    EXPECT_EQ(put_in_order(pairs), put_in_order(turned));
    EXPECT_EQ(pairs, turned);
}

TEST_F(TracedPairs, HashChangesWithPairsAndPlaces)
{
    const std::uint64_t hash = put_in_order(pairs);
    const Pair last = pairs.back();
    pairs.pop_back();
    EXPECT_NE(put_in_order(pairs), hash);
    pairs.push_back(last);
    EXPECT_EQ(put_in_order(pairs), hash);
    dGeomSetPosition(last.first, 0.1, 0.2, 0.3);
    EXPECT_NE(put_in_order(pairs), hash);
}

// ODE's rule: the space with the higher sublevel, or else with more geoms, is queried for the geoms of the other.
TEST_F(TracedPairs, ASpaceIsAskedForThem)
{
    const dSpaceID smaller = dSimpleSpaceCreate(nullptr);
    const dGeomID geom = dCreateSphere(smaller, 1);
    const auto as_geom = [](dSpaceID each) { return reinterpret_cast<dGeomID>(each); };
    EXPECT_EQ(asked_space(as_geom(space), as_geom(smaller)), space);
    EXPECT_EQ(asked_space(as_geom(smaller), as_geom(space)), space);
    EXPECT_EQ(asked_space(geom, as_geom(space)), space);
    EXPECT_EQ(asked_space(geom, geom), nullptr);
    dSpaceSetSublevel(smaller, 1);
    EXPECT_EQ(asked_space(as_geom(space), as_geom(smaller)), smaller);
    dSpaceDestroy(smaller);
}
} // namespace
} // namespace ode_predictive_space::preload
