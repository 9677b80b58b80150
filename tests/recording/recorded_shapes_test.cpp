#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <ode/ode.h>

#include <gtest/gtest.h>

#include "ode_predictive_space/recording/check.h"
#include "ode_predictive_space/recording/replay.h"
#include "tests/contract/support/geom_zoo.h"
#include "tests/recording/recorded.h"
#include "tests/recording/recorder_fixture.h"

namespace ode_predictive_space::recording
{
namespace
{
TEST_F(RecorderTest, AMeshIsRecordedOnceAndAgainWhenItsVerticesChange)
{
    Tetrahedron tetrahedron;
    const dTriMeshDataID mesh = tetrahedron.make_mesh();
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

TEST_F(RecorderTest, AMeshThatCannotBeReadIsItsBoxAlsoAtAnOffset)
{
    Tetrahedron tetrahedron;
    const dTriMeshDataID mesh = tetrahedron.make_mesh();
    tetrahedron.vertices[0] = NAN;
    const dBodyID body = dBodyCreate(world_);
    const dSpaceID space = dHashSpaceCreate(nullptr);
    const dGeomID geom = dCreateTriMesh(space, mesh, nullptr, nullptr, nullptr);
    dGeomSetBody(geom, body);
    dGeomSetOffsetPosition(geom, 1, 0, 0);
    Recorded recorded;
    recorded.collide(space);
    dBodySetPosition(body, 5, 0, 0);
    recorded.collide(space);
    const Recording recording = recorded.end();
    EXPECT_EQ(recording.stand_ins(), 1u);
    std::array<dReal, 6> box, replayed;
    dGeomGetAABB(geom, box.data());
    const auto stage = staged(recording);
    dGeomGetAABB(stage->geom(1), replayed.data());
    EXPECT_EQ(replayed, box);
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

TEST_F(RecorderTest, AHeightfieldWithASampleThatIsNoNumberIsItsBoxAlsoOnABody)
{
    const float heights[4] = {0, 1, 2, std::numeric_limits<float>::quiet_NaN()};
    const dHeightfieldDataID field = dGeomHeightfieldDataCreate();
    dGeomHeightfieldDataBuildSingle(field, heights, 0, 4, 4, 2, 2, 1, 0, 1, 0);
    const dBodyID body = dBodyCreate(world_);
    const dSpaceID space = dHashSpaceCreate(nullptr);
    for (const dGeomID each : {dCreateHeightfield(space, field, 1), dCreateSphere(space, 1)})
    {
        dGeomSetBody(each, body);
        dGeomSetOffsetPosition(each, 10, 0, 0);
    }
    dGeomSetPosition(dCreateSphere(space, 1), REAL(12.5), 0, 0);
    Recorded recorded;
    EXPECT_EQ(recorded.collide(space), 1) << "none of two geoms on one body";
    dBodySetPosition(body, 0, 20, 0);
    EXPECT_EQ(recorded.collide(space), 0);
    const Recording recording = recorded.end();
    EXPECT_EQ(recording.stand_ins(), 1u);
    expect_pairs_agree(recording);
    dSpaceDestroy(space);
    dGeomHeightfieldDataDestroy(field);
}

TEST_F(RecorderTest, TheCallbackOfAHeightfieldIsCalledOnceForEachSampleOfEachBuild)
{
    int calls = 0;
    const dHeightfieldDataID field = dGeomHeightfieldDataCreate();
    const auto build = [&](dReal scale) {
        const auto count = [](void *number, int, int) { return dReal(0 * ++*static_cast<int *>(number)); };
        dGeomHeightfieldDataBuildCallback(field, &calls, count, 10, 10, 4, 5, scale, 0, 1, 0);
    };
    build(1);
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    dCreateHeightfield(space, field, 1);
    Recorded recorded;
    for (int i = 0; i < 3; ++i)
        recorded.collide(space);
    EXPECT_EQ(calls, 4 * 5);
    build(2);
    recorded.collide(space);
    EXPECT_EQ(calls, 2 * 4 * 5);
    dSpaceDestroy(space);
    dGeomHeightfieldDataDestroy(field);
}

// ODE's own header calls transforms deprecated; programs use them.
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
TEST_F(RecorderTest, WhatATransformHoldsComesBackAndAUserClassIsItsBox)
{
    const dSpaceID space = dPredictiveSpaceCreate(nullptr);
    Tetrahedron tetrahedron;
    std::vector<dGeomID> transforms,
        held = {dCreateBox(nullptr, 1, 2, 3), dCreateCapsule(nullptr, REAL(0.5), 2),
                dCreateConvex(nullptr, tetrahedron.planes, 4, tetrahedron.points, 4, tetrahedron.polygons)};
    dMatrix3 rotation;
    dRFromEulerAngles(rotation, REAL(0.3), REAL(0.7), REAL(0.1));
    for (const dGeomID each : held)
    {
        dGeomSetPosition(each, REAL(0.3), REAL(0.1), REAL(-0.2));
        dGeomSetRotation(each, rotation);
        transforms.push_back(dCreateGeomTransform(space));
        dGeomTransformSetGeom(transforms.back(), each);
        dGeomTransformSetCleanup(transforms.back(), 1);
        dGeomSetCategoryBits(transforms.back(), 3);
        dGeomSetCollideBits(transforms.back(), 6);
    }
    dGeomDisable(transforms[2]);
    const dBodyID body = dBodyCreate(world_);
    dGeomSetBody(transforms[1], body);
    dGeomSetOffsetPosition(transforms[1], 0, REAL(0.1), 0);
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
    dCreateGeomTransform(space); // it holds nothing
    recorded.collide(space);
    const Recording recording = recorded.end();
    EXPECT_EQ(recording.stand_ins(), 2u);
    const auto stage = staged(recording);
    EXPECT_EQ(dGeomGetClass(stage->geom(1)), dBoxClass);
    EXPECT_EQ(dGeomGetClass(stage->geom(2)), dCapsuleClass);
    EXPECT_EQ(dGeomGetClass(stage->geom(3)), dConvexClass);
    for (std::uint32_t i = 0; i < 3; ++i)
    {
        expect_same(transforms[i], stage->geom(i + 1));
        const std::vector<dReal> contacts = contacts_of(transforms[i], ball);
        EXPECT_FALSE(contacts.empty());
        EXPECT_EQ(contacts, contacts_of(stage->geom(i + 1), stage->geom(4)));
    }
    expect_same(other, stage->geom(5));
    expect_pairs_agree(recording);
    dSpaceDestroy(space);
}
} // namespace
} // namespace ode_predictive_space::recording
