#include <cmath>

#include <gtest/gtest.h>

#include "ode_predictive_space/space/geom_shape.h"
#include "tests/contract/support/ode_test.h"
#include "tests/shape/polyhedron_geom.h"

namespace ode_predictive_space
{
namespace
{
Polyhedron row_of_triangles(unsigned count)
{
    Polyhedron row;
    for (unsigned i = 0; i < count; ++i)
    {
        for (const Vector3 &corner : {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0.1 * (i % 3))})
            row.corners.push_back(corner + Vector3(i, 0, 0));
        row.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return row;
}

class SlicedHull : public OdeTest
{
protected:
    ~SlicedHull() override { dGeomDestroy(geom_); }

    void follow(dGeomID geom, std::size_t steps) { follow_geom(0, geom, hulls_, steps, shape_); }

    bool has_hull(dGeomID geom, std::size_t steps) { return !hulls_.hull_of(0, geom, steps).is_being_made; }

    static constexpr unsigned triangles = 2000;
    static constexpr std::size_t slice = 500;

    HullStore hulls_;
    ConvexShape shape_;
    MeshArrays mesh_{row_of_triangles(triangles)};
    const dGeomID geom_ = dCreateTriMesh(nullptr, mesh_.id(), nullptr, nullptr, nullptr);
};

TEST_F(SlicedHull, BeginsAgainWithOtherData)
{
    for (int i = 0; i < 10; ++i)
        EXPECT_FALSE(has_hull(geom_, slice));
    mesh_.rebuild(Polyhedron::cube());
    EXPECT_TRUE(has_hull(geom_, slice));
    follow(geom_, 0);
    EXPECT_EQ(shape_.half_sides, Vector3(1, 1, 1));
}

TEST_F(SlicedHull, BeginsAgainWhenItsDataAreChanged)
{
    for (int i = 0; i < 30; ++i)
        EXPECT_FALSE(has_hull(geom_, slice));
    mesh_.move_corners(Vector3(0, 0, 5));
    hulls_.outdate(geom_);
    while (!has_hull(geom_, slice))
    {}
    follow(geom_, 0);
    EXPECT_GT(shape_.centre.z(), 4.9) << "no point is as it was";
    EXPECT_LT(shape_.half_sides.z(), 0.2);
}

TEST_F(SlicedHull, OfDataThatCannotBeReadIsNotReadAgain)
{
    Polyhedron wrong = row_of_triangles(triangles);
    wrong.corners[1].x() = 1e200;
    const MeshArrays too_far(wrong);
    const dGeomID geom = dCreateTriMesh(nullptr, too_far.id(), nullptr, nullptr, nullptr);
    follow(geom, HullMaker::all_steps);
    EXPECT_FALSE(shape_.known());
    EXPECT_FALSE(shape_.awaits_hull);
    std::size_t steps = slice;
    hulls_.hull_of(0, geom, steps);
    EXPECT_EQ(steps, slice);
    EXPECT_TRUE(has_hull(geom, 0)) << "nothing is awaited, also when no step is left";
    dGeomDestroy(geom);
}
} // namespace
} // namespace ode_predictive_space
