#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>
#include <vector>

#include <ode/ode.h>

#include <gtest/gtest.h>

#include "ode_predictive_space/recording/recorder.h"
#include "tests/contract/support/geom_zoo.h"
#include "tests/recording/recorded.h"
#include "tests/recording/recorder_fixture.h"

namespace ode_predictive_space::recording
{
namespace
{
TEST_F(RecorderTest, EachClassComesBackToTheBit)
{
    Tetrahedron tetrahedron;
    const dTriMeshDataID mesh = tetrahedron.make_mesh();
    const double corners[12] = {-0.5, -0.5, -0.5, 0.1, -0.5, -0.5, -0.5, 0.7, -0.5, -0.5, -0.5, 0.3};
    const dTriMeshDataID of_doubles = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(of_doubles, corners, 3 * sizeof(double), 4, tetrahedron.triangles, 12,
                                3 * sizeof(dTriIndex));
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    const std::vector<dGeomID> geoms = {
        dCreateSphere(space, dReal(0.1)),
        dCreateBox(space, dReal(0.1), dReal(0.2), dReal(0.3)),
        dCreateCapsule(space, dReal(0.3), dReal(0.7)),
        dCreateCylinder(space, dReal(0.3), dReal(0.7)),
        dCreateRay(space, dReal(1.1)),
        dCreatePlane(space, dReal(0.1), dReal(0.2), dReal(0.3), dReal(-0.7)),
        dCreateConvex(space, tetrahedron.planes, 4, tetrahedron.points, 4, tetrahedron.polygons),
        dCreateTriMesh(space, mesh, nullptr, nullptr, nullptr),
        dCreateTriMesh(space, of_doubles, nullptr, nullptr, nullptr)};
    for (std::size_t i = 0; i < geoms.size(); ++i)
    {
        dGeomSetCategoryBits(geoms[i], 3ul << i);
        dGeomSetCollideBits(geoms[i], ~(1ul << i));
        if (dGeomGetClass(geoms[i]) == dPlaneClass)
            continue;
        dMatrix3 rotation;
        dRFromEulerAngles(rotation, dReal(0.1) * static_cast<dReal>(i), dReal(0.3), dReal(0.7));
        dGeomSetRotation(geoms[i], rotation);
        dGeomSetPosition(geoms[i], dReal(0.1) * static_cast<dReal>(i), dReal(0.3), dReal(1) / 3);
    }
    dGeomDisable(geoms[3]);
    Recorded recorded;
    recorded.collide(space);
    const Recording recording = recorded.end();
    ASSERT_EQ(recording.geom_count(), geoms.size() + 1);
    EXPECT_EQ(recording.stand_ins(), 0u);
    const auto stage = staged(recording);
    for (std::size_t i = 0; i < geoms.size(); ++i)
        expect_same(geoms[geoms.size() - 1 - i], stage->geom(static_cast<std::uint32_t>(geoms.size() - i)));
    expect_pairs_agree(recording);
    dSpaceDestroy(space);
    dGeomTriMeshDataDestroy(mesh);
    dGeomTriMeshDataDestroy(of_doubles);
}

TEST_F(RecorderTest, GeomsOnBodiesComeBackToTheBit)
{
    const dSpaceID space = dHashSpaceCreate(nullptr);
    std::vector<dGeomID> geoms;
    std::vector<dBodyID> bodies;
    for (int i = 0; i < 10; ++i)
    {
        bodies.push_back(dBodyCreate(world_));
        for (int part = 0; part < 2; ++part)
        {
            geoms.push_back(dCreateBox(space, 1, dReal(0.3), dReal(0.4)));
            dGeomSetBody(geoms.back(), bodies.back());
        }
        dGeomSetOffsetPosition(geoms.back(), dReal(0.1), dReal(0.3), dReal(0.7));
        dMatrix3 rotation;
        dRFromEulerAngles(rotation, dReal(0.1), dReal(0.2), dReal(0.3));
        dGeomSetOffsetRotation(geoms.back(), rotation);
        dBodySetPosition(bodies.back(), dReal(0.9) * static_cast<dReal>(i), 0, dReal(i % 3));
        dBodySetAngularVel(bodies.back(), 1, 2, dReal(i));
        dBodySetLinearVel(bodies.back(), dReal(-0.3) * static_cast<dReal>(i), 0, 0);
    }
    Recorded recorded;
    for (int tick = 0; tick < 50; ++tick)
    {
        dWorldQuickStep(world_, dReal(0.013));
        recorded.collide(space);
    }
    const Recording recording = recorded.end();
    EXPECT_EQ(recording.body_count(), 10u);
    const auto stage = staged(recording, SpaceKind::sap);
    for (std::uint32_t id = 1; id <= geoms.size(); ++id)
        expect_same(geoms[id - 1], stage->geom(id));
    expect_pairs_agree(recording);
    dSpaceDestroy(space);
}

TEST_F(RecorderTest, ChangesComeBackToTheBit)
{
    const dBodyID body = dBodyCreate(world_);
    const dGeomID ball = dCreateSphere(space_, 1), box = dCreateBox(space_, 1, 1, 1), ray = dCreateRay(space_, 5);
    Recorded recorded;
    const std::vector<std::function<void()>> changes = {
        [&] { dGeomSetPosition(box, dReal(0.7), 0, 0); },
        [&] { dGeomSphereSetRadius(ball, dReal(0.1)); },
        [&] { dGeomSetBody(ball, body); },
        [&] { dBodySetPosition(body, dReal(0.1), dReal(0.7), 0); },
        [&] { dBodySetKinematic(body); },
        [&] { dBodyDisable(body); },
        [&] { dBodySetDynamic(body); },
        [&] { dGeomSetOffsetPosition(ball, 0, dReal(0.3), 0); },
        [&] { dGeomSetBody(box, body); }, // no pair with the ball any more
        [&] { dGeomClearOffset(ball); },
        [&] { dGeomDisable(ray); },
        [&] { dGeomEnable(ray); },
        [&] { dGeomRaySetFirstContact(ray, 1); },
        [&] { dGeomRaySetBackfaceCull(ray, 1); },
        [&] { dGeomRaySetClosestHit(ray, 1); },
        [&] { dGeomSetCollideBits(ball, 6); },
        [&] { dGeomSetCategoryBits(ball, 5); },
        [&] { dGeomSetBody(box, nullptr); },
        [&] { dGeomBoxSetLengths(box, 9, dReal(0.1), 2); },
        [&] {
            dGeomSetCollideBits(box, 0);
            dGeomSetCategoryBits(box, 0);
        },
        [&] { dGeomRaySetLength(ray, dReal(0.1)); },
        [&] { dGeomSetPosition(ray, std::numeric_limits<dReal>::infinity(), 0, 0); },
        [&] { dGeomSetPosition(ray, 0, 0, 0); },
        [&] { dGeomSetBody(ball, nullptr); },
    };
    recorded.collide(space_);
    for (const auto &change : changes)
    {
        change();
        recorded.collide(space_);
        const Recording recording = recorded.so_far();
        const auto stage = staged(recording);
        expect_same(ball, stage->geom(1));
        expect_same(box, stage->geom(2));
        expect_same(ray, stage->geom(3));
    }
}

TEST_F(RecorderTest, SpacesComeBackWithTheirLevels)
{
    const dSpaceID outer = dHashSpaceCreate(nullptr);
    const dVector3 centre{}, half{10, 10, 10};
    const std::vector<dSpaceID> spaces = {outer, dHashSpaceCreate(outer), dSimpleSpaceCreate(outer),
                                          dQuadTreeSpaceCreate(outer, centre, half, 2),
                                          dSweepAndPruneSpaceCreate(outer, dSAP_AXES_XYZ)};
    dHashSpaceSetLevels(spaces[1], -7, 5);
    dSpaceSetSublevel(spaces[2], 3);
    Recorded recorded;
    recorded.collide(outer);
    dHashSpaceSetLevels(spaces[1], -6, 4);
    dSpaceSetSublevel(spaces[3], 2);
    recorded.collide(outer);
    const Recording recording = recorded.end();
    const auto own = staged(recording, SpaceKind::own), boxes = staged(recording);
    for (std::uint32_t id = 0; id < spaces.size(); ++id)
    {
        EXPECT_EQ(difference(state_of(dGeomID(spaces[id])), state_of(own->geom(id))), 0) << id;
        const auto space = reinterpret_cast<dSpaceID>(boxes->geom(id));
        EXPECT_EQ(dSpaceIsPredictive(space), dSpaceGetClass(spaces[id]) != dSimpleSpaceClass)
            << "as with the launcher, a simple space within another one stays";
        EXPECT_EQ(dSpaceGetSublevel(space), dSpaceGetSublevel(spaces[id]));
    }
    dSpaceDestroy(outer);
}

TEST_F(RecorderTest, AGeomOfASpaceThatIsNotAskedStaysKnownWhenAnotherSpaceLosesAGeom)
{
    const dSpaceID other = dSimpleSpaceCreate(nullptr), asked = dSimpleSpaceCreate(nullptr);
    const dGeomID probe = dCreateSphere(other, 1), ball = dCreateSphere(asked, 1);
    dCreateSphere(asked, 1);
    Recorded recorded;
    recorded.collide(other);
    recorded.collide(asked);
    dGeomDestroy(ball);
    EXPECT_EQ(recorded.ask(probe, reinterpret_cast<dGeomID>(asked)), 1);
    expect_pairs_agree(recorded.end());
    dSpaceDestroy(other);
    dSpaceDestroy(asked);
}

// The next allocation gets the memory that was freed last.
class ReusedMemory
{
public:
    ReusedMemory()
    {
        dSetAllocHandler([](dsizeint size) {
            return size <= least && freed ? std::exchange(freed, nullptr) : std::malloc(std::max(size, least));
        });
        dSetFreeHandler([](void *memory, dsizeint) { std::free(std::exchange(freed, memory)); });
    }
    ~ReusedMemory()
    {
        dSetAllocHandler(nullptr);
        dSetFreeHandler(nullptr);
        std::free(std::exchange(freed, nullptr));
    }
    ReusedMemory(const ReusedMemory &) = delete;
    ReusedMemory &operator=(const ReusedMemory &) = delete;

private:
    static constexpr dsizeint least = 1000;
    static inline void *freed = nullptr;
};

// ODE sends no notice when a geom outside of all spaces is destroyed. An object of another class may get its address.
TEST_F(RecorderTest, ASpaceMayStandWhereAProbeWas)
{
    const ReusedMemory memory;
    const dSpaceID outer = dSimpleSpaceCreate(nullptr);
    dCreateSphere(outer, 1);
    const dGeomID probe = dCreateSphere(nullptr, 1);
    Recorded recorded;
    recorded.ask(probe, reinterpret_cast<dGeomID>(outer));
    dGeomDestroy(probe);
    const dSpaceID inner = dSimpleSpaceCreate(nullptr);
    ASSERT_EQ(reinterpret_cast<dGeomID>(inner), probe);
    const dGeomID ball = dCreateSphere(inner, 1);
    EXPECT_EQ(recorded.ask(ball, reinterpret_cast<dGeomID>(outer)), 1);
    expect_pairs_agree(recorded.end());
    dSpaceDestroy(inner);
    dSpaceDestroy(outer);
}
} // namespace
} // namespace ode_predictive_space::recording
