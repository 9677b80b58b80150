// What a space has to report, against what ODE's simple space reports.

#include "ode_predictive_space/preload/pairs.h"

#include <random>
#include <set>

#include "tests/contract/support/ode_test.h"

namespace ode_predictive_space::preload
{
namespace
{
using Keys = std::set<Pair>;

Pair unordered(dGeomID first, dGeomID second)
{
    return std::less<dGeomID>()(second, first) ? Pair(second, first) : Pair(first, second);
}

Keys keys_of(const std::vector<Pair> &pairs)
{
    Keys keys;
    for (const Pair &pair : pairs)
        EXPECT_TRUE(keys.insert(unordered(pair.first, pair.second)).second) << "twice";
    return keys;
}

void note(void *data, dGeomID first, dGeomID second)
{
    static_cast<Keys *>(data)->insert(unordered(first, second));
}

// Geoms of several classes, some disabled, some with other bits, some on one body, one infinite, one that is nowhere.
struct PreloadPairs : OdeTest
{
    PreloadPairs()
    {
        fill(space, 30);
        fill(group, 10);
        fill(other, 50);
        dCreatePlane(space, 0, 0, 1, 0);
        dGeomSetPosition(dCreateSphere(space, 1), NAN, 0, 0);
    }

    ~PreloadPairs() override
    {
        dSpaceDestroy(space);
        dSpaceDestroy(other);
        dWorldDestroy(world);
    }

    void fill(dSpaceID into, int count)
    {
        std::uniform_real_distribution<dReal> place(-4, 4);
        const dBodyID body = dBodyCreate(world);
        for (int i = 0; i < count; ++i)
        {
            dGeomID geom = i % 3 == 0 ? dCreateBox(into, 1, 2, 1) : dCreateSphere(into, 1);
            dGeomSetPosition(geom, place(random), place(random), place(random));
            if (i % 7 == 0)
                dGeomDisable(geom);
            if (i % 5 == 0)
                dGeomSetCollideBits(geom, 2);
            if (i % 5 == 1)
                dGeomSetCategoryBits(geom, 4);
            if (i % 11 == 0)
                dGeomSetBody(geom, body);
        }
    }

    Keys reported(dGeomID first, dGeomID second)
    {
        Keys keys;
        dSpaceCollide2(first, second, &keys, &note);
        return keys;
    }

    static dGeomID as_geom(dSpaceID space) { return reinterpret_cast<dGeomID>(space); }

    std::mt19937 random{7};
    dWorldID world = dWorldCreate();
    dSpaceID space = dSimpleSpaceCreate(nullptr);
    dSpaceID group = dSimpleSpaceCreate(space);
    dSpaceID other = dSimpleSpaceCreate(nullptr);
};

TEST_F(PreloadPairs, OfASpaceAreThoseOfTheSimpleSpace)
{
    Keys keys;
    dSpaceCollide(space, &keys, &note);
    EXPECT_GT(keys.size(), 20u);
    EXPECT_EQ(keys_of(expected_pairs(space)), keys);
}

TEST_F(PreloadPairs, OfTwoAreThoseOfDSpaceCollide2)
{
    dGeomID outside = dCreateBox(nullptr, 9, 9, 9), inside = dSpaceGetGeom(space, 3);
    for (int sublevel : {0, 1})
    {
        dSpaceSetSublevel(group, sublevel);
        for (const auto &[first, second] :
             {Pair(as_geom(space), outside), Pair(outside, as_geom(space)), Pair(as_geom(space), inside),
              Pair(as_geom(space), as_geom(other)), Pair(as_geom(other), as_geom(space)),
              Pair(as_geom(group), as_geom(space)), Pair(as_geom(space), as_geom(space))})
            EXPECT_EQ(keys_of(expected_pairs(first, second)), reported(first, second)) << sublevel;
    }
    EXPECT_TRUE(expected_pairs(outside, inside).empty());
    EXPECT_EQ(asked_space(outside, inside), nullptr);
    dGeomDestroy(outside);
}

TEST_F(PreloadPairs, OrderDoesNotDependOnHowTheyCame)
{
    std::vector<Pair> pairs = expected_pairs(space);
    std::vector<Pair> turned;
    for (const Pair &pair : pairs)
        turned.insert(turned.begin(), Pair(pair.second, pair.first));
    EXPECT_EQ(put_in_order(pairs), put_in_order(turned));
    EXPECT_EQ(pairs, turned);
}

TEST_F(PreloadPairs, HashChangesWithPairsAndPlaces)
{
    std::vector<Pair> pairs = expected_pairs(other);
    const std::uint64_t hash = put_in_order(pairs);
    const Pair last = pairs.back();
    pairs.pop_back();
    EXPECT_NE(put_in_order(pairs), hash);
    pairs.push_back(last);
    EXPECT_EQ(put_in_order(pairs), hash);
    dGeomSetPosition(last.first, 0.1, 0.2, 0.3);
    EXPECT_NE(put_in_order(pairs), hash);
}
} // namespace
} // namespace ode_predictive_space::preload
