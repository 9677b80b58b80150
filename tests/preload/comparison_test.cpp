#include "ode_predictive_space/preload/comparison.h"

#include "tests/contract/support/ode_test.h"

namespace ode_predictive_space::preload
{
namespace
{
struct PreloadComparison : OdeTest
{
    PreloadComparison()
    {
        for (int i = 0; i < 3; ++i)
            dGeomSetPosition(geoms[i] = dCreateSphere(space, 1), 1.5 * i, 0, 0);
        expected = expected_pairs(space);
    }

    ~PreloadComparison() override { dSpaceDestroy(space); }

    static std::string found(Comparison &comparison)
    {
        std::string all;
        for (const Difference &difference : comparison.finish())
            all += std::string(difference.what) + ";";
        return all;
    }

    dSpaceID space = dSimpleSpaceCreate(nullptr);
    dGeomID geoms[3];
    std::vector<Pair> expected; // the first two, the last two
};

TEST_F(PreloadComparison, IsSilentWhenAllIsReportedInAnyOrder)
{
    Comparison comparison(expected, false);
    comparison.note(geoms[2], geoms[1]);
    comparison.note(geoms[0], geoms[1]);
    EXPECT_EQ(found(comparison), "");
}

TEST_F(PreloadComparison, FindsWhatIsMissingTooMuchOrTwice)
{
    Comparison comparison(expected, false);
    comparison.note(geoms[0], geoms[2]);
    comparison.note(geoms[0], geoms[1]);
    comparison.note(geoms[1], geoms[0]);
    EXPECT_EQ(found(comparison), "reported although apart;reported twice;not reported;");
}

TEST_F(PreloadComparison, DoesNotMissWhatACallbackDisabled)
{
    Comparison comparison(expected, false);
    comparison.note(geoms[0], geoms[1]);
    dGeomDisable(geoms[2]);
    EXPECT_EQ(found(comparison), "");
}

TEST_F(PreloadComparison, BySpheresMissesContactsOnly)
{
    dGeomSetPosition(geoms[2], 1.5 + 1.9, 1.9, 0); // boxes overlap, spheres do not
    expected = expected_pairs(space);
    ASSERT_EQ(expected.size(), 2u);
    Comparison without_contact(expected, true);
    without_contact.note(geoms[0], geoms[1]);
    EXPECT_EQ(found(without_contact), "");
    Comparison with_contact(expected, true);
    EXPECT_EQ(found(with_contact), "not reported;");
}

// The contacts were looked for after the callbacks, which may move geoms.
TEST_F(PreloadComparison, ByContactsCountsThoseFromBeforeTheCallbacks)
{
    Comparison parted(expected, true);
    parted.note(geoms[0], geoms[1]);
    dGeomSetPosition(geoms[2], 9, 0, 0);
    EXPECT_EQ(found(parted), "not reported;");

    dGeomSetPosition(geoms[2], 1.5 + 1.9, 1.9, 0); // boxes overlap, spheres do not
    Comparison met(expected_pairs(space), true);
    met.note(geoms[0], geoms[1]);
    dGeomSetPosition(geoms[2], 3, 0, 0);
    EXPECT_EQ(found(met), "");
}
} // namespace
} // namespace ode_predictive_space::preload
