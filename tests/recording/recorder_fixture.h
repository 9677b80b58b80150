#ifndef ODE_PREDICTIVE_SPACE_TESTS_RECORDING_RECORDER_FIXTURE_H
#define ODE_PREDICTIVE_SPACE_TESTS_RECORDING_RECORDER_FIXTURE_H

#include <cstring>
#include <memory>

#include <ode/ode.h>

#include <gtest/gtest.h>

#include "ode_predictive_space/recording/recording.h"
#include "ode_predictive_space/recording/stage.h"
#include "tests/contract/support/ode_test.h"

namespace ode_predictive_space::recording
{
class RecorderTest : public OdeTest
{
protected:
    ~RecorderTest() override
    {
        dSpaceDestroy(space_);
        dWorldDestroy(world_);
    }

    const dWorldID world_ = dWorldCreate();
    const dSpaceID space_ = dPredictiveSpaceCreate(nullptr);
};

inline void ignore(void * /*data*/, dGeomID /*first*/, dGeomID /*second*/) {}

inline void count(void *number, dGeomID /*first*/, dGeomID /*second*/)
{
    ++*static_cast<int *>(number);
}

inline std::unique_ptr<Stage> staged(const Recording &recording, SpaceKind kind = SpaceKind::box)
{
    auto stage = std::make_unique<Stage>(recording, kind);
    for (const Record &record : recording.records())
        if (record.kind == RecordKind::collide || record.kind == RecordKind::collide2)
            stage->ask(record, nullptr, ignore);
        else
            stage->apply(record);
    return stage;
}

inline void expect_same(dGeomID before, dGeomID now)
{
    EXPECT_EQ(difference(state_of(before), state_of(now)), 0);
    EXPECT_EQ(dGeomGetCategoryBits(before), dGeomGetCategoryBits(now));
    EXPECT_EQ(dGeomGetCollideBits(before), dGeomGetCollideBits(now));
    EXPECT_EQ(dGeomIsEnabled(before), dGeomIsEnabled(now));
    ASSERT_EQ(dGeomGetBody(before) != nullptr, dGeomGetBody(now) != nullptr);
    if (const dBodyID body = dGeomGetBody(now))
    {
        EXPECT_EQ(difference(state_of(dGeomGetBody(before)), state_of(body)), 0);
        // Values of ODE's own functions are compared, as unrecorded data are missing in both states.
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

    /// Data that read the vertices of this object.
    dTriMeshDataID make_mesh() const
    {
        const dTriMeshDataID mesh = dGeomTriMeshDataCreate();
        dGeomTriMeshDataBuildSingle(mesh, vertices, 3 * sizeof(float), 4, triangles, 12, 3 * sizeof(dTriIndex));
        return mesh;
    }
};
} // namespace ode_predictive_space::recording

#endif
