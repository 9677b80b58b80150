// Meshes that were not prepared are read in parts; meanwhile ODE's contacts are rendered.

#include "ode_predictive_space/haptics/contact/mesh_store.h"
#include "tests/haptics/contact/contact_fixture.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
class MeshReadingTest : public testing::Test
{
protected:
    /// @return the number of ticks until the tree is ready. @param steps of each tick.
    static int ticks_to_read(MeshStore &store, dGeomID geom, std::size_t steps)
    {
        int ticks = 0;
        do
        {
            store.begin(steps);
            ++ticks;
        } while (store.tree_of(geom, {}) == nullptr);
        return ticks;
    }

    const OdeUse ode_;
    ProbeWorld world_;
};

TEST_F(MeshReadingTest, ATickReadsAPartThatDoesNotDependOnTheMesh)
{
    constexpr std::size_t steps = 2000;
    for (const int cells : {20, 40, 80})
    {
        const OdeMesh mesh(sheet_mesh(1, cells));
        const dGeomID geom = mesh.add_to(world_.space);
        const int triangles = dGeomTriMeshGetTriangleCount(geom);
        MeshStore store, again;
        const int ticks = ticks_to_read(store, geom, steps);
        EXPECT_GT(ticks, 10 * triangles / static_cast<int>(steps)) << cells;
        EXPECT_LT(ticks, 60 * triangles / static_cast<int>(steps)) << cells;
        EXPECT_EQ(ticks_to_read(again, geom, steps), ticks) << "a replay has to be the same";
    }
}

TEST_F(MeshReadingTest, WhatIsReadInPartsIsTheSame)
{
    const OdeMesh mesh(rough_ball(0.05, 20, 0.03, 0.0002, 1));
    const dGeomID geom = mesh.add_to(world_.space);
    MeshStore in_parts, at_once;
    ticks_to_read(in_parts, geom, 100);
    const auto tree = in_parts.tree_of(geom, {}), expected = at_once.tree_of(geom, {});
    RandomNumbers random(1);
    for (int i = 0; i < 200; ++i)
    {
        const Vector3 point = random.in_cube(0.07);
        SurfaceFeatures features, expected_features;
        EXPECT_EQ(tree->collect(point, 0.02, features), expected->collect(point, 0.02, expected_features));
        ASSERT_EQ(features.size(), expected_features.size());
        for (std::size_t feature = 0; feature < features.size(); ++feature)
            EXPECT_EQ(features[feature].triangle, expected_features[feature].triangle);
        EXPECT_EQ(tree->distance(point, 1), expected->distance(point, 1));
        EXPECT_EQ(tree->winding_number(point), expected->winding_number(point));
    }
}

TEST_F(MeshReadingTest, BeginsAgainWhenTheMeshIsAnotherOne)
{
    const OdeMesh mesh(sheet_mesh(1, 40)), other(sheet_mesh(1, 30));
    const dGeomID geom = mesh.add_to(world_.space);
    MeshStore store;
    store.begin(4000);
    ASSERT_EQ(store.tree_of(geom, {}), nullptr);
    dGeomTriMeshSetData(geom, dGeomTriMeshGetData(other.add_to(world_.space)));
    ticks_to_read(store, geom, 4000);
    EXPECT_EQ(store.tree_of(geom, {})->count(), 1800U);
}

TEST_F(MeshReadingTest, AllMeshesOfTheSceneArePreparedInWhateverSpacesTheyAre)
{
    const OdeMesh mesh(sheet_mesh(1, 60));
    const dGeomID geom = mesh.add_to(make_space(SpaceChoice::simple, world_.space));
    TouchSensor sensor(make_space(SpaceChoice::hash, world_.space), radius);
    sensor.prepare_all();
    sensor.clear();
    sensor.pose({});
    EXPECT_TRUE(sensor.touch(geom, sensor.geom()));
    EXPECT_FALSE(sensor.is_reading());
}

class UnpreparedMeshTest : public ContactTest
{};

INSTANTIATE_TEST_SUITE_P(Laws, UnpreparedMeshTest, contact_tests, contact_test_name);

// Once, one tick read the whole mesh: 1.2 s for 1.3 million triangles, without a notice.
TEST_P(UnpreparedMeshTest, IsFeltByOdeUntilItHasBeenReadAndHeldFromThenOn)
{
    const OdeMesh mesh(sheet_mesh(0.6, 150));
    NoticeList notices;
    dGeomID geom = nullptr;
    int reading = 0;
    double deepest = 0; // m; the deepest touch during the reading
    prepare_ = [&](HapticProbe &probe) { probe.renderer().set_notice_sink(notices.sink()); };
    const Vector3 above(0.001, 0.002, 0.04), in(0.001, 0.002, 0.005), below(0.001, 0.002, -0.02);
    const auto samples =
        run([&](double t) { return t < 0.5 ? between(above, in, 0.1, 0.02, t) : between(in, below, 0.8, 0.3, t); }, 1.2,
            [&](double) {
                if (geom == nullptr)
                    geom = mesh.add_to(world_.space); // after all present meshes were prepared
                reading += probe_->sensor()->is_reading() ? 1 : 0;
                for (const Touch &touch : probe_->touches())
                    deepest = probe_->sensor()->is_reading() ? std::max(deepest, touch.depth) : deepest;
            });
    EXPECT_GT(reading, 20);
    EXPECT_LT(reading, 400);
    EXPECT_NEAR(deepest, 0.005, 1e-6);
    EXPECT_EQ(notices.count(NoticeKind::contact), 1) << notices.text(NoticeKind::contact);
    expect_force_at_end(samples, Vector3(0, 0, k * 0.03), 1e-6);
}
} // namespace
} // namespace ode_predictive_space::haptics
