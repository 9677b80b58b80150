// Contract 16: operations that cannot run beside others are refused with a message.

#include <thread>

#include <ode_predictive_space/predictive_space.h>

#include "ode_predictive_space/ode/internals.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Contract = OdeTest;

TEST_F(Contract, 16_ATickBesideThatOfAnotherThreadIsRefused)
{
    Scenario scene(SpaceKind::predictive);
    for (int i = 0; i < 3; ++i)
        scene.sphere(1, 0.1 * i, 0, 0);
    struct Visit
    {
        dSpaceID space;
        int calls;
        std::string complaints;
    } visit{scene.space(), 0, ""};
    dSpaceCollide(scene.space(), &visit, [](void *data, dGeomID, dGeomID) {
        Visit &visit = *static_cast<Visit *>(data);
        ++visit.calls;
        EXPECT_EQ(collide(visit.space).size(), 3u) << "the same thread may";
        std::thread([&visit] {
            const OdeThread ode;
            dSpaceID space = visit.space;
            visit.complaints += ode_complaint([&] { EXPECT_TRUE(collide(space).empty()); });
            visit.complaints += ode_complaint([&] { EXPECT_TRUE(collide2(as_geom(space), as_geom(space)).empty()); });
            EXPECT_EQ(collide2(dSpaceGetGeom(space, 0), as_geom(space)).size(), 3u);
        }).join();
    });
    EXPECT_EQ(visit.calls, 3);
    EXPECT_NE(visit.complaints.find("another thread is colliding the space"), std::string::npos);
    EXPECT_EQ(collide(scene.space()).size(), 3u);
}

class AskingClass
{
public:
    static dGeomID create(dSpaceID space)
    {
        static dGeomClass asking = {0, [](int) -> dColliderFn * { return nullptr; }, bounds, nullptr, nullptr};
        static const int number = dCreateGeomClass(&asking);
        dGeomID geom = dCreateGeom(number);
        dSpaceAdd(space, geom);
        return geom;
    }

    static inline dSpaceID asked = nullptr;
    static inline int calls = 0;

private:
    static void bounds(dGeomID geom, dReal aabb[6])
    {
        const dReal *position = dGeomGetPosition(geom);
        for (int axis = 0; axis < 3; ++axis)
        {
            aabb[2 * axis] = position[axis] - 1;
            aabb[2 * axis + 1] = position[axis] + 1;
        }
        if (!asked)
            return;
        dSpaceID space = std::exchange(asked, nullptr);
        ++calls;
        EXPECT_TRUE(collide(space).empty());
        EXPECT_TRUE(collide2(geom, as_geom(space)).empty());
        EXPECT_EQ(dPredictiveSpaceGetEncounters(space, geom, nullptr, 0), 0);
        EXPECT_EQ(dPredictiveSpaceGetTimeOfProximity(space, geom, geom, nullptr), 0);
        EXPECT_EQ(dPredictiveSpaceValidate(space), 0);
    }
};

TEST_F(Contract, 16_QueriesOfACallbackForBoundingBoxesAreRefused)
{
    dSpaceID space = dPredictiveSpaceCreate(nullptr);
    dGeomID geoms[3];
    for (dGeomID &geom : geoms)
        geom = AskingClass::create(space);
    AskingClass::calls = 0;
    for (int tick = 0; tick < 6; ++tick)
    {
        dGeomSetPosition(geoms[tick % 3], 0.1 * tick, 0, 0);
        const std::string complaint = ode_complaint([&] {
            AskingClass::asked = space;
            if (tick % 2)
                EXPECT_EQ(collide2(geoms[0], as_geom(space)).size(), 3u);
            else
                EXPECT_EQ(collide(space).size(), 3u);
        });
        EXPECT_NE(complaint.find("space is being updated"), std::string::npos) << complaint;
        EXPECT_EQ(collide(space).size(), 3u);
        EXPECT_EQ(dPredictiveSpaceValidate(space), 1);
    }
    EXPECT_EQ(AskingClass::calls, 6);
    EXPECT_EQ(space->lock_count, 0);
    dSpaceDestroy(space);
}
} // namespace
} // namespace ode_predictive_space
