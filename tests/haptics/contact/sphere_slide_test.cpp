// The parts of contact: triangles, their trees, solids, and a sphere that slides around them.

#include "ode_predictive_space/haptics/contact/sphere_slide.h"

#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/mesh_maker.h"
#include "tests/haptics/support/probe_world.h"
#include "tests/haptics/support/random_numbers.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <set>

namespace ode_predictive_space::haptics
{
namespace
{
TriangleCorners random_triangle(RandomNumbers &random, double size)
{
    const Vector3 place = random.in_cube(0.05);
    return {place + random.in_cube(size), place + random.in_cube(size), place + random.in_cube(size)};
}

TEST(NearestOnTriangle, IsNearerThanAllOtherPointsOfIt)
{
    RandomNumbers random(1);
    for (int i = 0; i < 2000; ++i)
    {
        TriangleCorners corners = random_triangle(random, 0.02);
        if (i % 4 == 0)
            corners[2] = i % 8 == 0 ? corners[1] : Vector3(0.3 * corners[0] + 0.7 * corners[1]); // no area
        const Vector3 point = random.in_cube(0.08);
        const NearestOnTriangle nearest = nearest_on_triangle(point, corners);
        EXPECT_NEAR((point - nearest.point).squaredNorm(), nearest.squared_distance, 1e-12);
        for (int j = 0; j < 50; ++j)
        {
            const double u = random.between(0, 1);
            const double v = random.between(0, 1 - u);
            const Vector3 other = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
            ASSERT_LE(nearest.squared_distance, (point - other).squaredNorm() + 1e-12);
        }
    }
}

TEST(MeshTree, FindsTheDistanceThatAllTrianglesGive)
{
    RandomNumbers random(2);
    for (const int count : {0, 1, 5, 300})
    {
        std::vector<TriangleCorners> triangles;
        for (int i = 0; i < count; ++i)
            triangles.push_back(random_triangle(random, 0.01));
        const MeshTree tree(triangles);
        for (int i = 0; i < 300; ++i)
        {
            const Vector3 point = random.in_cube(0.08);
            double distance = 0.03;
            for (const TriangleCorners &corners : triangles)
                distance = std::min(distance, std::sqrt(nearest_on_triangle(point, corners).squared_distance));
            SurfaceFeatures features;
            ASSERT_NEAR(tree.collect(point, 0.03, features), distance, 1e-12);
            ASSERT_NEAR(tree.distance(point, 0.03), distance, 1e-12);
            const bool has_it = std::any_of(features.begin(), features.end(), [&](const SurfaceFeature &feature) {
                return std::abs(feature.distance - distance) < 1e-12;
            });
            ASSERT_EQ(has_it, distance < 0.03);
        }
    }
}

TEST(MeshTree, AFlatFloorIsOneFeatureHoweverManyTrianglesItHas)
{
    const MeshShape sheet = sheet_mesh(0.1, 50);
    std::vector<TriangleCorners> triangles;
    for (const auto &indices : sheet.triangles)
    {
        triangles.push_back({sheet.vertices[indices[0]], sheet.vertices[indices[1]], sheet.vertices[indices[2]]});
        for (Vector3 &corner : triangles.back())
            corner.z() = triangles.size() % 2 == 0 ? 0.0 : -0.0; // the same place
    }
    const MeshTree tree(triangles);
    RandomNumbers random(3);
    for (int i = 0; i < 200; ++i)
    {
        const Vector3 point(random.between(-0.03, 0.03), random.between(-0.03, 0.03), 0.01);
        SurfaceFeatures features;
        EXPECT_NEAR(tree.collect(point, 0.015, features), 0.01, 1e-12);
        ASSERT_EQ(features.size(), 1U) << point.transpose();
        EXPECT_NEAR(features[0].normal.z(), 1, 1e-12);
    }
}

TEST(MeshTree, TrianglesThatAreNotNumbersAreNowhere)
{
    std::vector<TriangleCorners> triangles(20, {Vector3(nan, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)});
    triangles.push_back({Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)});
    const MeshTree tree(triangles);
    SurfaceFeatures features;
    EXPECT_NEAR(tree.collect({0.1, 0.1, 0.5}, 1, features), 0.5, 1e-12);
    ASSERT_EQ(features.size(), 1U);
    EXPECT_EQ(features[0].triangle, 20);
    EXPECT_EQ(tree.count(), 21U);
}

/// The choice of the triangle does not depend on the point, so that it is stable from tick to tick.
TEST(MeshTree, ACornerOfManyTrianglesIsFeltByTheSameOneFromEverywhere)
{
    constexpr int sides = 40;
    const auto rim = [](int i) {
        const double angle = 2 * std::acos(-1.0) * (i % sides) / sides;
        return Vector3(std::cos(angle), std::sin(angle), -1);
    };
    std::vector<TriangleCorners> cone;
    for (int i = 0; i < sides; ++i)
        cone.push_back({Vector3::Zero(), rim(i), rim(i + 1)});
    const MeshTree tree(cone);
    std::set<int> triangles;
    RandomNumbers random(6);
    for (int i = 0; i < 200; ++i)
    {
        SurfaceFeatures features;
        tree.collect({random.between(-0.05, 0.05), random.between(-0.05, 0.05), 0.1}, 0.2, features);
        ASSERT_EQ(features.size(), 1U);
        triangles.insert(features[0].triangle);
    }
    EXPECT_EQ(triangles.size(), 1U);
}

bool crosses(const Vector3 &from, const Vector3 &to, const TriangleCorners &corners)
{
    const Vector3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double start = normal.dot(from - corners[0]);
    const double end = normal.dot(to - corners[0]);
    if (start * end >= 0)
        return false;
    const Vector3 point = from + start / (start - end) * (to - from);
    return nearest_on_triangle(point, corners).squared_distance < 1e-20;
}

/// A goal jumps about in a mesh of loose triangles. The centre's path is unknown, but nearly straight if `longest` is short.
TEST(SphereSlide, NeverPassesAnything)
{
    const OdeUse ode;
    RandomNumbers random(4);
    int held = 0;
    for (int scene = 0; scene < 20; ++scene)
    {
        MeshShape soup;
        std::vector<TriangleCorners> triangles;
        for (int i = 0; i < 60; ++i)
        {
            triangles.push_back(random_triangle(random, 0.03));
            const int first = static_cast<int>(soup.vertices.size());
            soup.vertices.insert(soup.vertices.end(), triangles.back().begin(), triangles.back().end());
            soup.triangles.push_back({first, first + 1, first + 2});
        }
        const OdeMesh mesh(soup);
        const dGeomID geom = mesh.add_to(nullptr);
        MeshStore store;
        const std::optional<NearbyGeom> nearby = NearbyGeom::read(geom, store, {});
        const MeshTree tree(triangles);
        SphereSlide slide;
        std::vector<SlidePlace> places = {{&*nearby, Vector3(0, 0, 0.2), 0}};
        SphereSlide::Task task;
        task.radius = radius;
        for (int run = 0; run < 200; ++run)
        {
            task.goal = run % 20 == 0 ? random.in_cube(0.1) : Vector3(task.goal + random.in_cube(0.01));
            task.look = run % 2 == 0 ? 0.005 : 0.1;
            task.longest = run % 3 == 0 ? 1 : 0.002;
            const Vector3 before = places[0].at;
            slide.run(task, places);
            SurfaceFeatures features;
            ASSERT_GE(tree.collect(places[0].at, radius, features), 0.9 * radius) << scene << ' ' << run;
            if (task.longest < radius)
            {
                for (const TriangleCorners &corners : triangles)
                    ASSERT_FALSE(crosses(before, places[0].at, corners)) << scene << ' ' << run;
            }
            held += (places[0].at - task.goal).norm() > radius ? 1 : 0;
        }
        dGeomDestroy(geom);
    }
    EXPECT_GT(held, 500);
}

TEST(SphereSlide, EndsWhereNoShortStepLeadsNearerToTheGoal)
{
    const OdeUse ode;
    RandomNumbers random(5);
    const OdeMesh mesh(sphere_mesh(0.03, 24));
    const dGeomID geom = mesh.add_to(nullptr);
    MeshStore store;
    const std::optional<NearbyGeom> nearby = NearbyGeom::read(geom, store, {});
    int compared = 0;
    for (int run = 0; run < 200; ++run)
    {
        const Vector3 direction = random.direction();
        std::vector<SlidePlace> places = {{&*nearby, 0.06 * direction, 0}};
        SphereSlide::Task task;
        task.radius = radius;
        task.goal = 0.035 * direction;
        task.longest = 1;
        SphereSlide slide;
        slide.run(task, places);
        for (int i = 0; i < 100; ++i)
        {
            const Vector3 other = places[0].at + 1e-4 * random.direction();
            SurfaceFeatures features;
            if (nearby->collect(other, radius, features) >= radius)
            {
                ASSERT_GE((other - task.goal).norm(), (places[0].at - task.goal).norm() - 1e-7) << run;
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 5000);
    dGeomDestroy(geom);
}

TEST(MeshStore, GeomsOfTheSameDataShareATreeUntilItsTrianglesChange)
{
    const OdeUse ode;
    OdeMesh mesh(sheet_mesh(0.1, 4));
    const OdeMesh other(sheet_mesh(0.1, 4));
    const dGeomID geom = mesh.add_to(nullptr);
    const dGeomID twin = mesh.add_to(nullptr);
    dGeomSetPosition(twin, 100, 20, 3);
    dMatrix3 turned;
    dRFromAxisAndAngle(turned, 1, 2, 3, 1);
    dGeomSetRotation(twin, turned);
    MeshStore store;
    const auto tree = store.tree_of(geom, {});
    for (int i = 0; i < 20; ++i)
        EXPECT_EQ(store.tree_of(twin, {}), tree);
    EXPECT_EQ(store.count(), 1U);
    dGeomTriMeshSetData(twin, other.data());
    EXPECT_NE(store.tree_of(twin, {}), tree);
    EXPECT_EQ(store.tree_of(geom, {}), tree);

    MeshShape moved = sheet_mesh(0.1, 4);
    moved.vertices[0].z() += 0.001; // a corner of the first and second triangles
    mesh.set(moved);
    dGeomTriMeshSetData(geom, mesh.data());
    TriangleList touched;
    touched.add(0);
    EXPECT_NE(store.tree_of(geom, touched), tree) << "at once, if it is touched";
    const auto changed = store.tree_of(geom, {});
    EXPECT_EQ(store.tree_of(geom, touched), changed);
    moved.vertices.back().z() += 0.001; // a corner of the last two triangles
    mesh.set(moved);
    dGeomTriMeshSetData(geom, mesh.data());
    for (int i = 0; i < 3; ++i)
        store.tree_of(geom, {});
    const auto latest = store.tree_of(geom, {});
    EXPECT_NE(latest, changed) << "each look compares eight of the 32 triangles";
    store.forget(mesh.data());
    EXPECT_NE(store.tree_of(geom, {}), latest);
    dGeomDestroy(geom);
    dGeomDestroy(twin);
}

TEST(MeshStore, OfManyMeshesTheNewestTreesAreKept)
{
    const OdeUse ode;
    MeshStore store;
    std::vector<std::unique_ptr<OdeMesh>> meshes;
    std::vector<dGeomID> geoms;
    std::vector<std::shared_ptr<const MeshTree>> trees;
    for (int i = 0; i < 300; ++i)
    {
        meshes.push_back(std::make_unique<OdeMesh>(sheet_mesh(0.1, 1)));
        geoms.push_back(meshes.back()->add_to(nullptr));
        trees.push_back(store.tree_of(geoms.back(), {}));
    }
    EXPECT_EQ(store.count(), 256U);
    EXPECT_EQ(store.tree_of(geoms[44], {}), trees[44]);
    EXPECT_NE(store.tree_of(geoms[43], {}), trees[43]);
    for (const dGeomID geom : geoms)
        dGeomDestroy(geom);
}

TEST(Solid, InsideAndOutsideAreTold)
{
    const OdeUse ode;
    const dGeomID box = dCreateBox(nullptr, 2, 4, 6);
    const Solid solid = Solid::of(box);
    EXPECT_NEAR(solid.nearest({0.9, 0, 0}).distance, -0.1, 1e-12);
    EXPECT_TRUE(solid.nearest({0.9, 0, 0}).normal.isApprox(Vector3::UnitX()));
    EXPECT_TRUE(solid.nearest({-0.9, 0, 0}).normal.isApprox(-Vector3::UnitX()));
    EXPECT_TRUE(solid.nearest({-0.9, 0, 0}).point.isApprox(-Vector3::UnitX()));
    EXPECT_NEAR(solid.nearest({2, 3, 0}).distance, std::sqrt(2), 1e-12);
    const dGeomID cylinder = dCreateCylinder(nullptr, 1, 2);
    const Solid round = Solid::of(cylinder);
    EXPECT_NEAR(round.nearest({1.3, 0, 1.4}).distance, 0.5, 1e-12) << "from the rim";
    EXPECT_NEAR(round.nearest({0, 0.8, 0}).distance, -0.2, 1e-12);
    EXPECT_NEAR(round.nearest({0, 0.1, -0.9}).normal.z(), -1, 1e-12);
    const dGeomID capsule = dCreateCapsule(nullptr, 1, 2), plane = dCreatePlane(nullptr, 0, 0, 1, 2);
    for (const double z : {3, -3})
        EXPECT_NEAR(Solid::of(capsule).nearest({0, 0, z}).distance, 1, 1e-12);
    EXPECT_NEAR(Solid::of(plane).nearest({5, 6, 3}).distance, 1, 1e-12);
    const dGeomID field = dCreateRay(nullptr, 1);
    EXPECT_FALSE(Solid::of(field).is_known());
    for (const dGeomID geom : {box, cylinder, capsule, plane, field})
        dGeomDestroy(geom);
}
} // namespace
} // namespace ode_predictive_space::haptics
