#include <array>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include <ode_predictive_space/predictive_space.hpp>

#include "tests/contract/support/scenario.h"
#include "tests/shape/polyhedron_geom.h"

namespace ode_predictive_space
{
namespace
{
// A sphere of some 40,000 triangles seen from inside: more than one query reads.
Polyhedron dome(double radius)
{
    return Polyhedron::sheet(200, 100, [radius](double u, double v) {
        const double up = M_PI * (0.005 + 0.99 * v), around = 2 * M_PI * u;
        const double across = radius * std::sin(up);
        return Eigen::Vector3d(across * std::cos(around), across * std::sin(around), radius * std::cos(up));
    });
}

class ShapeQuery : public OdeTest
{
protected:
    ShapeQuery() { dPredictiveSpaceSetProximity(space, dPredictiveProximityShape); }
    ~ShapeQuery() override { dSpaceDestroy(space); }

    dGeomID mesh(dSpaceID of, const Polyhedron &polyhedron)
    {
        meshes_.push_back(std::make_unique<MeshArrays>(polyhedron));
        return dCreateTriMesh(of, meshes_.back()->id(), nullptr, nullptr, nullptr);
    }
    MeshArrays &last_mesh() { return *meshes_.back(); }

    std::size_t answers(dGeomID probe) const { return collide2(probe, as_geom(space)).size(); }
    std::size_t answers_at(dGeomID probe, dReal x, dReal y, dReal z) const
    {
        dGeomSetPosition(probe, x, y, z);
        return answers(probe);
    }

    const dSpaceID space = dPredictiveSpaceCreate(nullptr);

private:
    std::vector<std::unique_ptr<MeshArrays>> meshes_;
};

class Probe
{
public:
    explicit Probe(dGeomID geom) : geom_(geom) {}
    ~Probe() { dGeomDestroy(geom_); }
    Probe(const Probe &) = delete;
    Probe &operator=(const Probe &) = delete;
    operator dGeomID() const { return geom_; }

private:
    dGeomID geom_;
};

TEST_F(ShapeQuery, IsToldOfARoomWhereItsWallsAre)
{
    mesh(space, Polyhedron::cube().changed(Eigen::Vector3d::Constant(5), {0, 0, 0}));
    const Probe ball(dCreateSphere(nullptr, 1)), box(dCreateBox(nullptr, 1, 1, 1));
    for (dGeomID probe : {dGeomID(ball), dGeomID(box)})
    {
        EXPECT_EQ(answers_at(probe, 0, 0, 0), 0u) << "in the middle";
        EXPECT_EQ(answers_at(probe, 0, REAL(4.5), 0), 1u) << "at a wall";
        EXPECT_EQ(answers_at(probe, 0, 2, 0), 0u);
        dPredictiveSpaceSetShapeMargin(space, 3);
        EXPECT_EQ(answers(probe), 1u) << "within the margin";
        dPredictiveSpaceSetShapeMargin(space, 0);
    }
}

TEST_F(ShapeQuery, ALargeRoomIsReadBySeveralQuestionsBesideAHand)
{
    const dGeomID hand = dCreateSphere(space, 1);
    dGeomSetPosition(hand, 20, 0, 0);
    dPredictiveSpaceSetGeomRole(space, hand, dPredictiveRoleInteractive);
    mesh(space, dome(5));
    const Probe ball(dCreateSphere(nullptr, 1));
    int in_vain = 0;
    while (in_vain < 100 && answers(ball) == 1)
        ++in_vain;
    EXPECT_GT(in_vain, 0) << "it is large";
    EXPECT_LT(in_vain, 100) << "it is ready at some time";
    EXPECT_EQ(answers_at(ball, 0, REAL(4.5), 0), 1u);
    for (int tick = 0; tick < 3; ++tick)
        collide(space); // nothing is near the room, so its shape is not needed
    EXPECT_EQ(answers_at(ball, 0, 0, 0), 0u) << "it is kept";
}

TEST_F(ShapeQuery, AMemberThatIsAMeshAsksByItsShape)
{
    const dGeomID octahedron = mesh(space, Polyhedron::octahedron());
    const dGeomID ball = dCreateSphere(space, REAL(0.3));
    dGeomSetBody(octahedron, dBodyCreate(dWorldCreate())); // keeps it from meeting itself
    dGeomSetPosition(ball, REAL(0.9), REAL(0.9), REAL(0.9));
    EXPECT_EQ(answers(octahedron), 0u) << "the boxes alone overlap";
    dGeomSetPosition(ball, REAL(0.4), REAL(0.4), REAL(0.4));
    EXPECT_EQ(answers(octahedron), 1u);
    dWorldDestroy(dBodyGetWorld(dGeomGetBody(octahedron)));
}

// A mesh outside the space may get other data in the same place without a notice.
TEST_F(ShapeQuery, AMeshOfAnotherSpaceAsksByItsBox)
{
    const dGeomID ball = dCreateSphere(space, REAL(0.3));
    dGeomSetPosition(ball, REAL(0.9), REAL(0.9), REAL(0.9));
    const Probe octahedron(mesh(nullptr, Polyhedron::octahedron()));
    EXPECT_EQ(answers(octahedron), 1u);
}

TEST_F(ShapeQuery, ARayIsFollowedAlongItsLine)
{
    for (int i = 0; i < 40; ++i) // more than are tested one by one
        dGeomSetPosition(dCreateBox(space, REAL(0.1), REAL(0.1), REAL(0.1)), i % 7, i / 7, 0);
    const Probe ray(dCreateRay(nullptr, 10));
    dGeomRaySet(ray, REAL(-0.5), REAL(-0.5), 0, 1, 1, 0);
    EXPECT_EQ(answers(ray), 5u) << "those on the diagonal";
    dGeomRaySet(ray, REAL(-0.5), 0, 0, 1, 1, 0);
    EXPECT_EQ(answers(ray), 0u) << "between them";
}

// The matrix makes the box narrow: ODE finds the ray's contact with it, although the ray passes beside its bounding box.
TEST_F(ShapeQuery, ARayIsNotFollowedAlongItsLineBesideWhatItTouchesOffTheLineAlsoAfterAnotherTest)
{
    for (const int proximity : {dPredictiveProximitySphere, dPredictiveProximityShape})
    {
        dPredictiveSpaceSetProximity(space, dPredictiveProximityBox);
        const dGeomID narrow = dCreateBox(space, 2, 2, 2);
        const dMatrix3 matrix = {REAL(0.5), 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
        dGeomSetRotation(narrow, matrix);
        for (int i = 0; i < 40; ++i) // more than are tested one by one
            dGeomSetPosition(dCreateBox(space, REAL(0.1), REAL(0.1), REAL(0.1)), 10 + i, 0, 0);
        collide(space);
        const Probe ray(dCreateRay(nullptr, REAL(4.8)));
        dGeomRaySet(ray, REAL(-0.4), 3, 0, 1, -1, 0);
        dContactGeom contact;
        ASSERT_EQ(dCollide(ray, narrow, 1, &contact, sizeof contact), 1);
        EXPECT_EQ(answers(ray), 1u);
        dPredictiveSpaceSetProximity(space, proximity);
        EXPECT_EQ(answers(ray), 1u) << "proximity " << proximity;
        dGeomDestroy(narrow);
    }
}

// An envelope shows where an object will be, not where it is.
TEST_F(ShapeQuery, ARayThatMeetsAnEnvelopeAloneIsNotAnswered)
{
    const dWorldID world = dWorldCreate();
    const dBodyID body = dBodyCreate(world);
    dGeomSetBody(dCreateBox(space, REAL(0.1), REAL(0.1), REAL(0.1)), body);
    dBodySetGravityMode(body, 0);
    dBodySetPosition(body, REAL(0.5), REAL(0.2), 0);
    dBodySetLinearVel(body, 0, REAL(0.2), 0);
    for (int i = 0; i < 40; ++i)
        dGeomSetPosition(dCreateBox(space, REAL(0.1), REAL(0.1), REAL(0.1)), 10 + i, 0, 0);
    for (int tick = 0; tick < 80; ++tick)
    {
        dWorldQuickStep(world, REAL(0.01));
        collide(space);
    }
    const Probe ray(dCreateRay(nullptr, 10));
    dGeomRaySet(ray, -1, -1, 0, 1, 1, 0);
    EXPECT_EQ(answers(ray), 0u) << "it goes by ahead of the box";
    dWorldDestroy(world);
}

TEST_F(ShapeQuery, NoticesDataThatWereChangedInPlace)
{
    const dGeomID room = mesh(space, Polyhedron::cube().changed(Eigen::Vector3d::Constant(5), {0, 0, 0}));
    const Probe ball(dCreateSphere(nullptr, 1));
    EXPECT_EQ(answers(ball), 0u);
    last_mesh().move_corners({0, REAL(4.5), 0});
    dPredictiveSpaceGeomChanged(space, room);
    EXPECT_EQ(answers(ball), 1u) << "a wall has come";
    last_mesh().move_corners({0, REAL(-4.5), 0});
    dGeomTriMeshSetData(room, last_mesh().id()); // without a notice
    EXPECT_EQ(answers(ball), 0u) << "it has gone";
    dGeomDestroy(room);
    EXPECT_EQ(answers(ball), 0u);
    mesh(space, Polyhedron::octahedron());
    EXPECT_EQ(answers(ball), 1u);
}

TEST_F(ShapeQuery, NoticesHeightsThatWereChangedInPlace)
{
    std::array<double, 9> heights{};
    const dHeightfieldDataID data = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildDouble(data, heights.data(), 0, 8, 8, 3, 3, 1, 0, 1, 0);
    dGeomHeightfieldDataSetBounds(data, -1, 3);
    const dGeomID ground = dCreateHeightfield(space, data, 1);
    const Probe ball(dCreateSphere(nullptr, REAL(0.5)));
    EXPECT_EQ(answers_at(ball, 1, 2, 1), 0u);
    heights.fill(2);
    dPredictiveSpaceGeomChanged(space, ground);
    EXPECT_EQ(answers(ball), 1u) << "the ground has come";
    heights.fill(0);
    dPredictiveSpaceGeomChanged(space, ground);
    EXPECT_EQ(answers(ball), 0u) << "it has gone";
    const dGeomID other = dCreateHeightfield(space, data, 1);
    dGeomSetPosition(other, 30, 0, 0);
    dGeomSetPosition(dCreateSphere(space, REAL(0.5)), 31, 2, 1);
    for (int tick = 0; tick < 10; ++tick)
        EXPECT_EQ(collide(space).size(), 0u);
    heights.fill(2);
    dPredictiveSpaceGeomChanged(space, ground);
    EXPECT_EQ(collide(space).size(), 1u) << "the other is made of the same data";
    dGeomDestroy(other);
    dGeomDestroy(ground);
    dGeomHeightfieldDataDestroy(data);
}

// With the box test, as in a simple space, the next collide sees other data of a geom that was neither added nor moved last.
TEST_F(ShapeQuery, NoticesOtherDataOfAnyMesh)
{
    const Polyhedron small = Polyhedron::cube().changed(Eigen::Vector3d::Constant(0.1), {0, 0, 0});
    for (const int proximity : {dPredictiveProximitySphere, dPredictiveProximityShape})
    {
        dPredictiveSpaceSetProximity(space, proximity);
        const dGeomID changed = mesh(space, small), moved = mesh(space, small);
        dGeomSetPosition(moved, 50, 0, 0);
        for (int i = 0; i < 20; ++i)
            dGeomSetPosition(dCreateSphere(space, 0.1), 10 + i, 0, 0);
        collide(space);
        dGeomSetPosition(moved, 51, 0, 0);
        const Probe ball(dCreateSphere(nullptr, 0.2)), ray(dCreateRay(nullptr, 2));
        dGeomRaySet(ray, 1, 2, 1, 0, -1, 0);
        EXPECT_EQ(answers_at(ball, 1, 1, 1), 0u);
        EXPECT_EQ(answers(ray), 0u);
        MeshArrays large(Polyhedron::cube());
        dGeomTriMeshSetData(changed, large.id());
        EXPECT_EQ(answers(ray), 1u);
        EXPECT_EQ(answers_at(ball, 1, 1, 1), 1u);
        dGeomDestroy(changed);
    }
}

// While the room is being read, it is reported.
TEST_F(ShapeQuery, SeveralThreadsMayAsk)
{
    mesh(space, dome(5));
    for (int i = 0; i < 50; ++i)
        dGeomSetPosition(dCreateSphere(space, REAL(0.1)), 100, i, 0);
    std::atomic<int> wrong{0};
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i)
        threads.emplace_back([&] {
            const OdeThread ode;
            const Probe ball(dCreateSphere(nullptr, 1));
            for (int round = 0; round < 200; ++round)
                wrong += answers_at(ball, 0, REAL(4.5), REAL(0.001) * round) != 1 ||
                         (answers_at(ball, 0, 0, 0) != 0 && round > 20);
        });
    for (std::thread &thread : threads)
        thread.join();
    EXPECT_EQ(wrong, 0);
}
} // namespace
} // namespace ode_predictive_space
