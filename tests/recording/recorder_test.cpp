// What is recorded comes back, to the bit.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <set>

#include <ode/ode.h>

#include <gtest/gtest.h>

#include "ode_predictive_space/history.h"
#include "ode_predictive_space/recording/recorder.h"
#include "ode_predictive_space/recording/recording.h"
#include "ode_predictive_space/recording/check.h"
#include "ode_predictive_space/recording/own_space.h"
#include "ode_predictive_space/recording/replay.h"
#include "ode_predictive_space/recording/stage.h"
#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/ode_test.h"
#include "tests/faults/allocation_faults.h"
#include "tests/recording/recorded.h"
#include "tests/recording/scratch_recording.h"
#include "tests/support/effort.h"

namespace ode_predictive_space::recording
{
namespace
{
using recording::SpaceKind;
using recording::Stage;

using RecorderTest = OdeTest;

void ignore(void * /*data*/, dGeomID /*first*/, dGeomID /*second*/) {}

void count(void *number, dGeomID /*first*/, dGeomID /*second*/)
{
    ++*static_cast<int *>(number);
}

// After all of its records.
std::unique_ptr<Stage> staged(const Recording &recording, SpaceKind kind = SpaceKind::box)
{
    auto stage = std::make_unique<Stage>(recording, kind);
    for (const Record &record : recording.records())
        if (record.kind == RecordKind::collide || record.kind == RecordKind::collide2)
            stage->ask(record, nullptr, ignore);
        else
            stage->apply(record);
    return stage;
}

// All that a space sees of a geom, and all that is recorded of it and of its body.
void expect_same(dGeomID before, dGeomID now)
{
    EXPECT_EQ(difference(state_of(before), state_of(now)), 0);
    EXPECT_EQ(dGeomGetCategoryBits(before), dGeomGetCategoryBits(now));
    EXPECT_EQ(dGeomGetCollideBits(before), dGeomGetCollideBits(now));
    EXPECT_EQ(dGeomIsEnabled(before), dGeomIsEnabled(now));
    ASSERT_EQ(dGeomGetBody(before) != nullptr, dGeomGetBody(now) != nullptr);
    if (const dBodyID body = dGeomGetBody(now))
    {
        EXPECT_EQ(difference(state_of(dGeomGetBody(before)), state_of(body)), 0);
        // By ODE's own functions: what is not recorded is missing in both states.
        for (const auto get : {dBodyGetPosition, dBodyGetRotation, dBodyGetLinearVel, dBodyGetAngularVel})
            EXPECT_EQ(std::memcmp(get(dGeomGetBody(before)), get(body), 3 * sizeof(dReal)), 0);
    }
    dReal box_before[6], box_now[6];
    dGeomGetAABB(before, box_before);
    dGeomGetAABB(now, box_now);
    EXPECT_EQ(std::memcmp(box_before, box_now, sizeof box_now), 0);
}

struct Tetrahedron
{
    dReal planes[16] = {0, 0, -1, 0.5f, 0, -1, 0, 0.5f, -1, 0, 0, 0.5f, 0.577350269f, 0.577350269f, 0.577350269f, 0.5f};
    dReal points[12] = {-0.5f, -0.5f, -0.5f, 1, -0.5f, -0.5f, -0.5f, 1, -0.5f, -0.5f, -0.5f, 1};
    unsigned polygons[16] = {3, 0, 2, 1, 3, 0, 1, 3, 3, 0, 3, 2, 3, 1, 2, 3};
    float vertices[12] = {-0.5f, -0.5f, -0.5f, 1, -0.5f, -0.5f, -0.5f, 1, -0.5f, -0.5f, -0.5f, 1};
    dTriIndex triangles[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
};

TEST_F(RecorderTest, EachClassComesBackToTheBit)
{
    Tetrahedron tetrahedron;
    const dTriMeshDataID mesh = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildSingle(mesh, tetrahedron.vertices, 3 * sizeof(float), 4, tetrahedron.triangles, 12,
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
        dCreateTriMesh(space, mesh, nullptr, nullptr, nullptr)};
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
}

TEST_F(RecorderTest, GeomsOnBodiesComeBackToTheBit)
{
    const dWorldID world = dWorldCreate();
    const dSpaceID space = dHashSpaceCreate(nullptr);
    std::vector<dGeomID> geoms;
    std::vector<dBodyID> bodies;
    for (int i = 0; i < 10; ++i)
    {
        bodies.push_back(dBodyCreate(world));
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
        dWorldQuickStep(world, dReal(0.013));
        recorded.collide(space);
    }
    const Recording recording = recorded.end();
    EXPECT_EQ(recording.body_count(), 10u);
    const auto stage = staged(recording, SpaceKind::sap);
    for (std::uint32_t id = 1; id <= geoms.size(); ++id)
        expect_same(geoms[id - 1], stage->geom(id));
    expect_pairs_agree(recording);
    dSpaceDestroy(space);
    dWorldDestroy(world);
}

// dGeomRaySet() turns the body of its ray. The other geoms stay where they were until the body moves.
TEST_F(RecorderTest, AGeomThatDoesNotFollowItsBodyComesBackWhereItIs)
{
    const dWorldID world = dWorldCreate();
    const dSpaceID space = dHashSpaceCreate(nullptr);
    const dBodyID body = dBodyCreate(world);
    const dGeomID ray = dCreateRay(space, 5), box = dCreateBox(space, 1, 2, 3);
    dGeomSetBody(ray, body);
    dGeomSetBody(box, body);
    dGeomSetOffsetPosition(box, 1, 2, 3);
    Recorded recorded;
    recorded.collide(space);
    dGeomRaySet(ray, 0, 0, 0, 1, 0, 0);
    recorded.collide(space);
    const Recording recording = recorded.end();
    const auto stage = staged(recording);
    expect_same(ray, stage->geom(1));
    expect_same(box, stage->geom(2));
    dSpaceDestroy(space);
    dWorldDestroy(world);
}

TEST_F(RecorderTest, ChangesComeBackToTheBit)
{
    const dWorldID world = dWorldCreate();
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    const dBodyID body = dBodyCreate(world);
    const dGeomID ball = dCreateSphere(space, 1), box = dCreateBox(space, 1, 1, 1), ray = dCreateRay(space, 5);
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
    recorded.collide(space);
    for (const auto &change : changes)
    {
        change();
        recorded.collide(space);
        const Recording recording = recorded.so_far();
        const auto stage = staged(recording);
        expect_same(ball, stage->geom(1));
        expect_same(box, stage->geom(2));
        expect_same(ray, stage->geom(3));
    }
    dSpaceDestroy(space);
    dWorldDestroy(world);
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

TEST_F(RecorderTest, GeomsComeAndGoAndChangeTheirSpace)
{
    const dSpaceID outer = dHashSpaceCreate(nullptr), inner = dSimpleSpaceCreate(outer);
    std::vector<dGeomID> balls;
    for (int i = 0; i < 20; ++i)
    {
        balls.push_back(dCreateSphere(i % 2 ? inner : outer, 1));
        dGeomSetPosition(balls.back(), dReal(0.7) * static_cast<dReal>(i), 0, 0);
    }
    Recorded recorded;
    recorded.collide(outer);
    for (std::size_t i = 0; i < 5; ++i)
    {
        dGeomDestroy(balls[3 * i]);
        dSpaceRemove(dGeomGetSpace(balls[3 * i + 1]), balls[3 * i + 1]);
        dSpaceAdd(inner, balls[3 * i + 1]);
        recorded.collide(outer);
        recorded.ask(reinterpret_cast<dGeomID>(inner), balls[3 * i + 1]);
        balls[3 * i] = dCreateCapsule(i % 2 ? outer : inner, 1, 1);
        recorded.collide(outer);
    }
    expect_pairs_agree(recorded.end());
    dSpaceDestroy(outer);
}

TEST_F(RecorderTest, ProbesOutsideOfSpacesAreRecorded)
{
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    for (int i = 0; i < 30; ++i)
        dGeomSetPosition(dCreateBox(space, 1, 1, 1), dReal(0.9) * static_cast<dReal>(i), 0, 0);
    const dGeomID probe = dCreateSphere(nullptr, 2);
    Recorded recorded;
    int pairs = 0;
    for (int i = 0; i < 10; ++i)
    {
        dGeomSetPosition(probe, dReal(2 * i), 0, 0);
        pairs += recorded.ask(probe, reinterpret_cast<dGeomID>(space));
    }
    EXPECT_GT(pairs, 10);
    expect_pairs_agree(recorded.end());
    dGeomDestroy(probe);
    dSpaceDestroy(space);
}

TEST_F(RecorderTest, AMeshIsRecordedOnceAndAgainWhenItsVerticesChange)
{
    Tetrahedron tetrahedron;
    const dTriMeshDataID mesh = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildSingle(mesh, tetrahedron.vertices, 3 * sizeof(float), 4, tetrahedron.triangles, 12,
                                3 * sizeof(dTriIndex));
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    for (int i = 0; i < 5; ++i)
        dGeomSetPosition(dCreateTriMesh(space, mesh, nullptr, nullptr, nullptr), dReal(i), 0, 0);
    Recorded recorded;
    const auto meshes = [&] {
        const Recording recording = recorded.so_far();
        return std::count_if(recording.records().begin(), recording.records().end(),
                             [](const Record &record) { return record.kind == RecordKind::mesh; });
    };
    recorded.collide(space);
    recorded.collide(space);
    EXPECT_EQ(meshes(), 1);
    tetrahedron.vertices[3] = 2;
    dGeomTriMeshDataUpdate(mesh);
    recorded.collide(space);
    EXPECT_EQ(meshes(), 2);
    const Recording recording = recorded.so_far();
    const auto stage = staged(recording);
    for (std::uint32_t id = 1; id <= 5; ++id)
    {
        dVector3 corner;
        dGeomTriMeshGetTriangle(stage->geom(id), 0, nullptr, nullptr, &corner);
        EXPECT_EQ(corner[0], dReal(id + 1)) << "the geom has the new vertices";
    }
    dSpaceDestroy(space);
    dGeomTriMeshDataDestroy(mesh);
}

TEST_F(RecorderTest, MeshesOfTheSameArraysReadWithOtherStridesAreOthers)
{
    const float vertices[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 0, 9, 0, 0, 0, 0, 0};
    const dTriIndex triangle[] = {0, 1, 2};
    const dSpaceID space = dHashSpaceCreate(nullptr);
    dTriMeshDataID data[2];
    for (int i = 0; i < 2; ++i)
    {
        data[i] = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildSingle(data[i], vertices, (i + 1) * 3 * static_cast<int>(sizeof(float)), 3, triangle, 3,
                                    3 * sizeof(dTriIndex));
        dGeomSetPosition(dCreateTriMesh(space, data[i], nullptr, nullptr, nullptr), REAL(100.0) * dReal(i), 0, 0);
    }
    dGeomSetPosition(dCreateSphere(space, 1), 108, 0, 0);
    Recorded recorded;
    EXPECT_EQ(recorded.collide(space), 1) << "the second mesh reaches as far";
    expect_pairs_agree(recorded.end());
    dSpaceDestroy(space);
    for (const dTriMeshDataID each : data)
        dGeomTriMeshDataDestroy(each);
}

// What dCollide() finds, to the bit.
std::vector<dReal> contacts_of(dGeomID first, dGeomID second)
{
    dContactGeom contacts[20];
    const int count = dCollide(first, second, 20, contacts, sizeof contacts[0]);
    std::vector<dReal> numbers;
    for (int i = 0; i < count; ++i)
    {
        numbers.insert(numbers.end(), contacts[i].pos, contacts[i].pos + 3);
        numbers.insert(numbers.end(), contacts[i].normal, contacts[i].normal + 3);
        numbers.push_back(contacts[i].depth);
    }
    return numbers;
}

dReal callback_height(void *scale, int column, int row)
{
    return *static_cast<const dReal *>(scale) * static_cast<dReal>((column * 7 + row * 5) % 4);
}

struct Fields
{
    const unsigned char bytes[9] = {0, 3, 0, 1, 2, 1, 0, 1, 0};
    const float floats[9] = {0, 0.1f, 0, 0.3f, 0.7f, 0.2f, 0, 0.1f, 0};
    dReal scale = REAL(0.3);
    dHeightfieldDataID data[3] = {dGeomHeightfieldDataCreate(), dGeomHeightfieldDataCreate(),
                                  dGeomHeightfieldDataCreate()};

    Fields()
    {
        dGeomHeightfieldDataBuildByte(data[0], bytes, 1, 10, 14, 3, 3, REAL(0.1), REAL(-0.2), REAL(0.3), 0);
        dGeomHeightfieldDataBuildSingle(data[1], floats, 0, 12, 10, 3, 3, REAL(1.1), REAL(0.7), 1, 1);
        dGeomHeightfieldDataBuildCallback(data[2], &scale, callback_height, 20, 20, 9, 5, REAL(0.5), REAL(0.1), 1, 0);
        dGeomHeightfieldDataSetBounds(data[2], -1, 2);
    }
    ~Fields()
    {
        for (const dHeightfieldDataID each : data)
            dGeomHeightfieldDataDestroy(each);
    }
};

TEST_F(RecorderTest, HeightfieldsComeBackToTheBit)
{
    Fields fields;
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    std::vector<dGeomID> grounds;
    for (int i = 0; i < 6; ++i)
        grounds.push_back(dCreateHeightfield(space, fields.data[i / 2], i % 2)); // fixed and placeable
    for (int i = 1; i < 6; i += 2)
    {
        dMatrix3 rotation;
        dRFromEulerAngles(rotation, REAL(0.1) * dReal(i), REAL(0.2), REAL(0.1));
        dGeomSetRotation(grounds[std::size_t(i)], rotation);
        dGeomSetPosition(grounds[std::size_t(i)], 0, REAL(-0.1) * dReal(i), 0);
    }
    const dGeomID ball = dCreateSphere(space, 1);
    Recorded recorded;
    for (int i = 0; i < 5; ++i)
    {
        dGeomSetPosition(ball, dReal(i) - 2, REAL(0.6), REAL(0.5) * dReal(i));
        recorded.collide(space);
    }
    const Recording recording = recorded.end();
    EXPECT_EQ(recording.stand_ins(), 0u);
    const auto stage = staged(recording);
    const dGeomID ball_now = stage->geom(7);
    expect_same(ball, ball_now);
    std::size_t with_contacts = 0;
    for (std::size_t i = 0; i < grounds.size(); ++i)
    {
        const dGeomID now = stage->geom(std::uint32_t(i) + 1);
        expect_same(grounds[i], now);
        const std::vector<dReal> contacts = contacts_of(grounds[i], ball);
        EXPECT_EQ(contacts, contacts_of(now, ball_now)) << i;
        with_contacts += !contacts.empty();
    }
    EXPECT_GT(with_contacts, 3u);
    expect_pairs_agree(recording);
    dSpaceDestroy(space);
}

TEST_F(RecorderTest, AHeightfieldIsRecordedAgainWhenItsSamplesChange)
{
    float heights[4] = {0, 1, 2, 3};
    const dHeightfieldDataID field = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildSingle(field, heights, 0, 10, 10, 2, 2, 1, 0, 1, 0);
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    const dGeomID ground = dCreateHeightfield(space, field, 1), ball = dCreateSphere(space, 1);
    Recorded recorded;
    recorded.collide(space);
    recorded.collide(space);
    heights[0] = 2;
    recorded.collide(space);
    const Recording recording = recorded.end();
    const auto &records = recording.records();
    EXPECT_EQ(
        std::count_if(records.begin(), records.end(), [](const Record &r) { return r.kind == RecordKind::heights; }),
        2);
    const auto stage = staged(recording);
    EXPECT_EQ(contacts_of(ground, ball), contacts_of(stage->geom(1), stage->geom(2)));
    dSpaceDestroy(space);
    dGeomHeightfieldDataDestroy(field);
}

TEST_F(RecorderTest, TheCallbackOfAHeightfieldIsCalledOnceForEachSample)
{
    int calls = 0;
    const dHeightfieldDataID field = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildCallback(
        field, &calls,
        [](void *count, int, int) {
            ++*static_cast<int *>(count);
            return dReal(0);
        },
        10, 10, 4, 5, 1, 0, 1, 0);
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    dCreateHeightfield(space, field, 1);
    Recorded recorded;
    for (int i = 0; i < 3; ++i)
        recorded.collide(space);
    EXPECT_EQ(calls, 4 * 5);
    dSpaceDestroy(space);
    dGeomHeightfieldDataDestroy(field);
}

// ODE's own header calls transforms deprecated; programs have them.
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
TEST_F(RecorderTest, WhatATransformHoldsComesBackAndAUserClassIsItsBox)
{
    const dWorldID world = dWorldCreate();
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    std::vector<dGeomID> transforms, held = {dCreateBox(nullptr, 1, 2, 3), dCreateCapsule(nullptr, REAL(0.5), 2)};
    dMatrix3 rotation;
    dRFromEulerAngles(rotation, REAL(0.3), REAL(0.7), REAL(0.1));
    for (const dGeomID each : held)
    {
        dGeomSetPosition(each, REAL(0.3), REAL(0.1), REAL(-0.2));
        dGeomSetRotation(each, rotation);
        transforms.push_back(dCreateGeomTransform(space));
        dGeomTransformSetGeom(transforms.back(), each);
        dGeomTransformSetCleanup(transforms.back(), 1);
    }
    const dBodyID body = dBodyCreate(world);
    dGeomSetBody(transforms[1], body);
    const dGeomID ball = dCreateSphere(space, 2), other = create_geom(GeomKind::user, 1, space);
    Recorded recorded;
    for (int i = 0; i < 5; ++i)
    {
        dGeomSetPosition(transforms[0], 0, REAL(0.1) * dReal(i), 0);
        dGeomSetRotation(transforms[0], rotation);
        dBodySetPosition(body, REAL(0.2) * dReal(i), 0, 0);
        dBodySetRotation(body, rotation);
        dGeomSetPosition(other, dReal(i), 0, 0);
        recorded.collide(space);
    }
    const Recording recording = recorded.end();
    EXPECT_EQ(recording.stand_ins(), 1u);
    const auto stage = staged(recording);
    EXPECT_EQ(dGeomGetClass(stage->geom(1)), dBoxClass);
    EXPECT_EQ(dGeomGetClass(stage->geom(2)), dCapsuleClass);
    for (std::uint32_t i = 0; i < 2; ++i)
    {
        expect_same(transforms[i], stage->geom(i + 1));
        const std::vector<dReal> contacts = contacts_of(transforms[i], ball);
        EXPECT_FALSE(contacts.empty());
        EXPECT_EQ(contacts, contacts_of(stage->geom(i + 1), stage->geom(3)));
    }
    expect_same(other, stage->geom(4));
    expect_pairs_agree(recording);
    dSpaceDestroy(space);
    dWorldDestroy(world);
}

// By the numbers of geoms, what a space is told between two collides.
class Notices final : public NoticeListener
{
public:
    explicit Notices(dSpaceID space) { ode_predictive_space_listen(space, this); }
    ~Notices() { ode_predictive_space_stop_listening(this); }
    void notify_moved(dGeomID geom) override { ++numbers_[geom]; }

    // Of the geoms, in this order.
    std::vector<int> take(const std::vector<dGeomID> &geoms)
    {
        std::vector<int> numbers;
        for (const dGeomID geom : geoms)
            numbers.push_back(numbers_[geom]);
        numbers_.clear();
        return numbers;
    }

private:
    std::map<dGeomID, int> numbers_;
};

// Enough for the space to predict, which leaves no moved geom marked.
std::vector<dGeomID> balls_in(dSpaceID space)
{
    std::vector<dGeomID> balls;
    for (int i = 0; i < 30; ++i)
    {
        balls.push_back(dCreateSphere(space, REAL(0.1)));
        dGeomSetPosition(balls.back(), dReal(i), 0, 0);
    }
    return balls;
}

// Before each event but the first, of the geoms in the first space, from the last to the first as they were recorded.
std::vector<std::vector<int>> notices_in_replay(const Recording &recording)
{
    Stage stage(recording, SpaceKind::box);
    std::unique_ptr<Notices> notices;
    std::vector<dGeomID> geoms;
    std::vector<std::vector<int>> numbers;
    for (const Record &record : recording.records())
    {
        if (record.kind != RecordKind::collide)
        {
            stage.apply(record);
            continue;
        }
        if (notices)
            numbers.push_back(notices->take(geoms));
        stage.ask(record, nullptr, ignore);
        if (notices)
            continue;
        for (std::uint32_t id = 1; id < recording.geom_count(); ++id)
            geoms.push_back(stage.geom(id));
        notices = std::make_unique<Notices>(reinterpret_cast<dSpaceID>(stage.geom(0)));
    }
    return numbers;
}

// As an engine of its own does that sets all poses in each tick, though few change.
TEST_F(RecorderTest, NoticesComeBackAlsoOfPosesThatAreSetToWhatTheyAre)
{
    const dWorldID world = dWorldCreate();
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    std::vector<dGeomID> geoms = balls_in(space);
    const dBodyID body = dBodyCreate(world);
    for (const std::size_t i : {20u, 21u})
        dGeomSetBody(geoms[i], body);
    dGeomSetOffsetPosition(geoms[21], 0, 1, 0);
    Recorded recorded;
    recorded.collide(space);
    std::vector<std::vector<int>> live;
    {
        Notices notices(space);
        for (int tick = 0; tick < 6; ++tick)
        {
            for (std::size_t i = 0; i < 10; ++i) // two notices each
            {
                const dReal *position = dGeomGetPosition(geoms[i]);
                dGeomSetPosition(geoms[i], position[0], position[1] + (i == 0 ? REAL(0.1) : 0), position[2]);
                dGeomSetRotation(geoms[i], dGeomGetRotation(geoms[i]));
            }
            dGeomSetPosition(geoms[15], 15, dReal(tick), 0);
            dBodySetPosition(body, 0, 0, dReal(tick / 2));
            live.push_back(notices.take(geoms));
            recorded.collide(space);
        }
    }
    EXPECT_EQ(live[3][0], 2);
    EXPECT_EQ(live[3][9], 2);
    EXPECT_EQ(live[3][10], 0);
    EXPECT_EQ(live[3][15], 1);
    EXPECT_EQ(live[3][21], 1) << "its body was set to where it was";
    const Recording recording = recorded.end();
    EXPECT_EQ(notices_in_replay(recording), live);
    expect_pairs_agree(recording);
    dSpaceDestroy(space);
    dWorldDestroy(world);
}

TEST_F(RecorderTest, NoticesOfNestedPredictiveSpacesAreRecordedAndThoseOfOdesSpacesAreNot)
{
    const dSpaceID space = dPredictiveSpaceCreate(nullptr), inner = dPredictiveSpaceCreate(space),
                   simple = dSimpleSpaceCreate(space);
    dPredictiveSpaceSetProximity(inner, dPredictiveProximityShape);
    const std::vector<dGeomID> in_predictive = balls_in(inner), in_simple = balls_in(simple);
    Recorded recorded;
    for (int tick = 0; tick < 4; ++tick)
    {
        recorded.collide(space);
        for (const dGeomID each : {in_predictive[3], in_simple[3]})
            for (int times = 0; times < 3; ++times)
                dGeomSetPosition(each, 3, 0, 0);
    }
    const Recording recording = recorded.end();
    std::map<std::uint32_t, std::uint32_t> number_of;
    std::vector<SpaceService> services;
    for (const Record &record : recording.records())
        if (record.kind == RecordKind::notices)
            for (const NoticeCount &count : recording.notices(record))
                number_of[count.id] = count.number;
        else if (record.kind == RecordKind::geom && is_space_class(recording.geom(record).state.geom_class))
            services.push_back(recording.geom(record).state.service);
    ASSERT_EQ(services.size(), 3u);
    EXPECT_EQ(services[0].predictive, 1 + dPredictiveProximityBox);
    EXPECT_EQ(services[1].predictive, 1 + dPredictiveProximityShape);
    EXPECT_EQ(services[2].predictive, 0);
    EXPECT_FALSE(services[0].is_substitute);
    EXPECT_EQ(number_of.size(), 3u) << "one ball, and both spaces";
    EXPECT_EQ(number_of[5], 3u) << "the fourth ball";
    expect_pairs_agree(recording);
    dSpaceDestroy(space);
}

// What stands in the place of one of ODE's is of that class to the program; what the program made itself is predictive.
TEST_F(RecorderTest, ASubstituteIsRecordedAsTheSpaceThatTheProgramMade)
{
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    balls_in(space);
    for (const bool is_substitute : {false, true})
    {
        const ScratchRecording file;
        Recorder recorder(HistoryFile(file.path(), false), 1 << 24, "a test", [=](dSpaceID) { return is_substitute; });
        recorder.begin_collide(space).end();
        recorder.close();
        EXPECT_EQ(recording::name_of_own_space(Recording::read(file.path())),
                  is_substitute ? "hash" : "predictive, by box");
    }
    dSpaceDestroy(space);
}

TEST_F(RecorderTest, ASpaceThatIsNotRecordedAnyMoreIsNotWatchedEither)
{
    const ScratchRecording file;
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    const std::vector<dGeomID> balls = balls_in(space);
    const auto functions = [&] { return *reinterpret_cast<void **>(space); };
    void *const before = functions();
    {
        Recorded recorded;
        recorded.collide(space);
        EXPECT_NE(functions(), before);
        EXPECT_EQ(dPredictiveSpaceRecord(space, file.path().c_str(), 0), 1);
        recorded.end();
        EXPECT_NE(functions(), before) << "it records itself";
    }
    EXPECT_EQ(dPredictiveSpaceRecord(space, nullptr, 0), 1);
    EXPECT_EQ(functions(), before);
    Recorded other;
    other.collide(space);
    dSpaceDestroy(space); // while it is listened to
    EXPECT_TRUE(other.recorder().close());
}

TEST_F(RecorderTest, TheRecordingEndsAtItsLimitWithAWholeTick)
{
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    const dGeomID ball = dCreateSphere(space, 1);
    dCreateSphere(space, 1);
    Recorded recorded(3000);
    for (int i = 0; i < 100; ++i)
    {
        dGeomSetPosition(ball, dReal(0.1) * static_cast<dReal>(i), 0, 0);
        recorded.collide(space);
    }
    EXPECT_TRUE(recorded.recorder().is_over());
    const Recording recording = recorded.end();
    EXPECT_TRUE(recording.reached_limit());
    EXPECT_LE(recording.bytes(), 3000u);
    EXPECT_GT(recording.events().size(), 5u);
    EXPECT_LT(recording.events().size(), 100u);
    dSpaceDestroy(space);
}

// Every limit within the size of a tick: there is always room for the end, and for the pairs of a collide that has begun.
TEST_F(RecorderTest, NoLimitIsExceeded)
{
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    const dGeomID ball = dCreateSphere(space, 1);
    dCreateSphere(space, 1);
    for (std::uint64_t limit = 2000; limit < 2150; ++limit)
    {
        Recorded recorded(limit);
        for (int i = 0; i < 20 && !recorded.recorder().is_over(); ++i)
        {
            dGeomSetPosition(ball, dReal(0.1) * static_cast<dReal>(i), 0, 0);
            recorded.collide(space);
        }
        const Recording recording = recorded.end();
        EXPECT_LE(recording.bytes(), limit);
        EXPECT_TRUE(recording.reached_limit());
        EXPECT_TRUE(recording.events().back().has_pairs);
    }
    dSpaceDestroy(space);
}

TEST_F(RecorderTest, WithoutAnEndTheLastCollideIsThere)
{
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    dCreateSphere(space, 1);
    Recorded recorded;
    recorded.recorder().begin_collide(space);
    const Recording recording = recorded.so_far();
    ASSERT_EQ(recording.events().size(), 1u);
    EXPECT_FALSE(recording.events()[0].has_pairs) << "the program did not survive it";
    EXPECT_FALSE(recording.has_end());
    dSpaceDestroy(space);
}

// It was closed as whole and then refused: half of an event was in it.
TEST_F(RecorderTest, WithoutMemoryItIsCutAfterItsLastWholeRecord)
{
    Tetrahedron tetrahedron;
    const dTriMeshDataID mesh = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildSingle(mesh, tetrahedron.vertices, 3 * sizeof(float), 4, tetrahedron.triangles, 12,
                                3 * sizeof(dTriIndex));
    bool struck = true;
    for (long spared = 0; struck; ++spared)
    {
        SCOPED_TRACE(spared);
        const dSpaceID space = dSimpleSpaceCreate(nullptr);
        dCreateSphere(space, 1);
        Recorded recorded;
        recorded.collide(space);
        dCreateTriMesh(space, mesh, nullptr, nullptr, nullptr);
        for (int i = 0; i < 30; ++i)
            dGeomSetPosition(dCreateBox(space, 1, 1, 1), dReal(i), 0, 0);
        {
            const AllocationFault fault(spared);
            EXPECT_GT(recorded.collide(space), 0) << "the program goes on";
            struck = fault.struck();
        }
        recorded.collide(space);
        const bool is_whole = recorded.recorder().close();
        EXPECT_EQ(is_whole, !struck);
        const Recording recording = recorded.so_far();
        EXPECT_EQ(recording.has_end(), is_whole);
        EXPECT_EQ(recording.whole_bytes(), recording.bytes()) << "nothing of a record that is not whole";
        EXPECT_TRUE(recording.events()[0].has_pairs) << "what was recorded before is there";
        EXPECT_EQ(find_pairs(recording, SpaceKind::box).events.size(), recording.events().size());
        dSpaceDestroy(space);
    }
    dGeomTriMeshDataDestroy(mesh);
}

// --- dPredictiveSpaceRecord() -----------------------------------------------------------------------------------------

TEST_F(RecorderTest, ASpaceRecordsItselfAndFindsTheSamePairs)
{
    const ScratchRecording file;
    const dSpaceID space = dPredictiveSpaceCreate(nullptr), twin = dPredictiveSpaceCreate(nullptr);
    std::vector<std::array<dGeomID, 2>> geoms;
    for (int i = 0; i < 40; ++i)
        geoms.push_back({dCreateSphere(space, 1), dCreateSphere(twin, 1)});
    ASSERT_EQ(dPredictiveSpaceRecord(space, file.path().c_str(), 0), 1);
    EXPECT_TRUE(dSpaceIsPredictive(space));
    for (int tick = 0; tick < 30; ++tick)
    {
        for (std::size_t i = 0; i < geoms.size(); ++i)
            for (const dGeomID geom : geoms[i])
                dGeomSetPosition(geom, dReal(i % 7) * dReal(1.3), dReal(i) * dReal(0.4), dReal(tick * (i % 3)) / 10);
        int pairs = 0, expected = 0;
        dSpaceCollide(space, &pairs, count);
        dSpaceCollide(twin, &expected, count);
        EXPECT_EQ(pairs, expected);
    }
    EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
    EXPECT_EQ(dPredictiveSpaceRecord(space, nullptr, 0), 1);
    int pairs = 0;
    dSpaceCollide(space, &pairs, count);
    const Recording recording = Recording::read(file.path());
    EXPECT_EQ(recording.events().size(), 30u) << "what came afterwards is not in it";
    EXPECT_TRUE(recording.has_end());
    expect_pairs_agree(recording);
    dSpaceDestroy(space);
    dSpaceDestroy(twin);
}

TEST_F(RecorderTest, ADestroyedSpaceEndsItsRecording)
{
    const ScratchRecording file;
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    dCreateSphere(space, 1);
    ASSERT_EQ(dPredictiveSpaceRecord(space, file.path().c_str(), 0), 1);
    dSpaceCollide(space, nullptr, ignore);
    dSpaceDestroy(space);
    EXPECT_TRUE(Recording::read(file.path()).has_end());
}

// The next collide ended the program.
TEST_F(RecorderTest, ASecondRecordingEndsTheFirstAlsoWhenItsFileCannotBeMade)
{
    const ScratchRecording file;
    const dSpaceID space = dPredictiveSpaceCreate(nullptr), other = dPredictiveSpaceCreate(nullptr);
    dCreateSphere(space, 1);
    ASSERT_EQ(dPredictiveSpaceRecord(space, file.path().c_str(), 0), 1);
    dSpaceCollide(space, nullptr, ignore);
    int result = 1;
    ode_complaint([&] { result = dPredictiveSpaceRecord(space, "/nonexistent/file", 0); });
    EXPECT_EQ(result, 0);
    dSpaceCollide(space, nullptr, ignore);
    EXPECT_TRUE(Recording::read(file.path()).has_end());
    EXPECT_EQ(Recording::read(file.path()).events().size(), 1u) << "the first recording has ended with the second call";

    EXPECT_EQ(dPredictiveSpaceRecord(space, file.path().c_str(), 0), 1);
    EXPECT_EQ(dPredictiveSpaceRecord(space, file.path().c_str(), 0), 1) << "its own file again";
    EXPECT_NE(ode_complaint([&] {
                  result = dPredictiveSpaceRecord(other, file.path().c_str(), 0);
              }).find("another recording is being written to it"),
              std::string::npos);
    EXPECT_EQ(result, 0);
    dSpaceDestroy(space);
    EXPECT_TRUE(Recording::read(file.path()).has_end());
    dSpaceDestroy(other);
}

TEST_F(RecorderTest, WhatCannotBeRecordedIsRefused)
{
    const dSpaceID space = dPredictiveSpaceCreate(nullptr), hash = dHashSpaceCreate(nullptr);
    int result = 1;
    EXPECT_NE(ode_complaint([&] { result = dPredictiveSpaceRecord(hash, "/dev/null", 0); }).find("not a predictive"),
              std::string::npos);
    EXPECT_EQ(result, 0);
    EXPECT_NE(ode_complaint([&] { result = dPredictiveSpaceRecord(nullptr, "/dev/null", 0); }).find("null"),
              std::string::npos);
    EXPECT_NE(ode_complaint([&] {
                  result = dPredictiveSpaceRecord(space, "/nonexistent/file", 0);
              }).find("/nonexistent/file"),
              std::string::npos);
    EXPECT_EQ(result, 0);
    EXPECT_EQ(dPredictiveSpaceRecord(space, nullptr, 0), 1) << "there was none";
    dSpaceCollide(space, nullptr, ignore);
    ASSERT_EQ(dPredictiveSpaceRecord(space, "/dev/full", 0), 1);
    dSpaceCollide(space, nullptr, ignore);
    EXPECT_NE(ode_complaint([&] { result = dPredictiveSpaceRecord(space, nullptr, 0); }).find("to its end"),
              std::string::npos);
    EXPECT_EQ(result, 0);
    dSpaceDestroy(space);
    dSpaceDestroy(hash);
}

// ODE does not tell when a geom outside of all spaces is destroyed. An object of another class may get its address.
TEST_F(RecorderTest, ASpaceMayStandWhereAProbeWas)
{
    // All are of one size, so that memory is used again at once.
    dSetAllocHandler([](dsizeint size) { return std::malloc(std::max<dsizeint>(size, 1000)); });
    const dSpaceID outer = dSimpleSpaceCreate(nullptr);
    dCreateSphere(outer, 1);
    const dGeomID probe = dCreateSphere(nullptr, 1);
    Recorded recorded;
    recorded.ask(probe, reinterpret_cast<dGeomID>(outer));
    dGeomDestroy(probe);
    const dSpaceID inner = dSimpleSpaceCreate(nullptr);
    EXPECT_TRUE(is_sanitized || reinterpret_cast<dGeomID>(inner) == probe);
    const dGeomID ball = dCreateSphere(inner, 1);
    EXPECT_EQ(recorded.ask(ball, reinterpret_cast<dGeomID>(outer)), 1);
    expect_pairs_agree(recorded.end());
    dSpaceDestroy(inner);
    dSpaceDestroy(outer);
    dSetAllocHandler(nullptr);
}
} // namespace
} // namespace ode_predictive_space::recording
