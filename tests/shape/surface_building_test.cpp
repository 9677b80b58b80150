// The surface of a mesh is built at once if no hand is in the scene, otherwise in slices, or by dPredictiveSpacePrepare().

#include <memory>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/scenario.h"
#include "tests/shape/polyhedron_geom.h"

namespace ode_predictive_space
{
namespace
{
// A bowl of about 10,000 triangles, open above, from -1 to 1 in x and y.
Polyhedron bowl()
{
    return Polyhedron::sheet(71, 71, [](double u, double v) {
        const double x = 2 * u - 1, y = 2 * v - 1;
        return Eigen::Vector3d(x, y, x * x + y * y);
    });
}

class SurfaceBuilding : public OdeTest
{
protected:
    SurfaceBuilding() { dPredictiveSpaceSetProximity(space, dPredictiveProximityShape); }
    ~SurfaceBuilding() override { dSpaceDestroy(space); }

    // Within the hull of the bowl and within its box, but above the triangles.
    dGeomID ball_above()
    {
        const dGeomID ball = dCreateSphere(space, REAL(0.1));
        dGeomSetPosition(ball, 0, 0, REAL(0.5));
        return ball;
    }

    dGeomID hand() const
    {
        const dGeomID hand = dCreateSphere(space, REAL(0.1));
        dGeomSetPosition(hand, 50, 0, 0);
        dPredictiveSpaceSetGeomRole(space, hand, dPredictiveRoleInteractive);
        return hand;
    }

    // The ball is in another place each time, so that no pair rests.
    std::size_t pairs(dGeomID ball)
    {
        const dReal *place = dGeomGetPosition(ball);
        side_ = -side_;
        dGeomSetPosition(ball, place[0] + side_, place[1], place[2]);
        const std::size_t count = collide(space).size();
        EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
        return count;
    }

    int ticks_by_box(dGeomID ball, int ticks = 200)
    {
        int by_box = 0;
        for (int tick = 0; tick < ticks; ++tick)
            by_box += pairs(ball) == 1;
        return by_box;
    }

    MeshArrays mesh{bowl()};
    dSpaceID space = dPredictiveSpaceCreate(nullptr);

private:
    dReal side_ = REAL(1e-4);
};

TEST_F(SurfaceBuilding, GoesInSlicesBesideAHand)
{
    hand();
    dCreateTriMesh(space, mesh.id(), nullptr, nullptr, nullptr);
    const int by_box = ticks_by_box(ball_above());
    EXPECT_GE(by_box, 5);
    EXPECT_LE(by_box, 50);
}

TEST_F(SurfaceBuilding, IsDoneAtOnceWhenTheHandIsGone)
{
    dGeomDestroy(hand());
    dCreateTriMesh(space, mesh.id(), nullptr, nullptr, nullptr);
    EXPECT_EQ(ticks_by_box(ball_above()), 0);
}

// ODE sends no notice of other data, and the first tick must not take them for new ones.
TEST_F(SurfaceBuilding, OfDataThatWereSetBeforeThePreparationIsKept)
{
    hand();
    const MeshArrays before(Polyhedron::cube());
    const dGeomID geom = dCreateTriMesh(space, before.id(), nullptr, nullptr, nullptr);
    collide(space);
    dGeomTriMeshSetData(geom, mesh.id());
    dPredictiveSpacePrepare(space);
    EXPECT_EQ(ticks_by_box(ball_above()), 0);
}

TEST_F(SurfaceBuilding, LastsWhileNothingIsNear)
{
    hand();
    dCreateTriMesh(space, mesh.id(), nullptr, nullptr, nullptr);
    const dGeomID ball = ball_above();
    ticks_by_box(ball);
    dGeomSetPosition(ball, 20, 0, 0);
    EXPECT_EQ(ticks_by_box(ball), 0);
    dGeomSetPosition(ball, 0, 0, REAL(0.5));
    EXPECT_LE(ticks_by_box(ball), 1) << "the surface is not built again";
}

TEST_F(SurfaceBuilding, CanBePreparedWithinSpaces)
{
    const dSpaceID top = dPredictiveSpaceCreate(nullptr);
    hand();
    dCreateTriMesh(space, mesh.id(), nullptr, nullptr, nullptr);
    dSpaceAdd(top, reinterpret_cast<dGeomID>(space));
    dPredictiveSpacePrepare(top);
    EXPECT_EQ(ticks_by_box(ball_above()), 0);
    dSpaceRemove(top, reinterpret_cast<dGeomID>(space));
    dSpaceDestroy(top);
}

// The slices of a destroyed mesh must not be read.
TEST_F(SurfaceBuilding, EndsWithTheGeomAndItsData)
{
    hand();
    const dGeomID ball = ball_above();
    for (int destroyed_at = 1; destroyed_at < 12; ++destroyed_at)
    {
        const auto other = std::make_unique<MeshArrays>(bowl());
        const dGeomID geom = dCreateTriMesh(space, other->id(), nullptr, nullptr, nullptr);
        for (int tick = 0; tick < destroyed_at; ++tick)
            pairs(ball);
        dGeomDestroy(geom);
    }
    EXPECT_EQ(pairs(ball), 0u);
}
} // namespace
} // namespace ode_predictive_space
