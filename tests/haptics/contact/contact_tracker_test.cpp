// The tracker keeps the sides of entry: the tool moves at random, and plates move, turn and close in on it.

#include "ode_predictive_space/haptics/contact/contact_tracker.h"

#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/probe_world.h"
#include "tests/haptics/support/random_numbers.h"
#include "tests/haptics/support/ridges.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double width = 2;     // m; side of a plate, which the tool never leaves
constexpr double thick = 0.001; // m

/// A plate whose top is its frame's plane z = 0.
class Plate
{
public:
    Plate(ProbeWorld &world, bool as_mesh)
        : body(world.add_body({0, 0, 0}, 1)),
          mesh_(box_mesh({-width / 2, -width / 2, -thick}, {width / 2, width / 2, 0}))
    {
        dBodySetKinematic(body);
        geom = as_mesh ? mesh_.add_to(world.space) : dCreateBox(world.space, width, width, thick);
        dGeomSetBody(geom, body);
        if (!as_mesh)
            dGeomSetOffsetPosition(geom, 0, 0, -thick / 2);
    }
    ~Plate() { dGeomDestroy(geom); }
    Plate(const Plate &) = delete;
    Plate &operator=(const Plate &) = delete;

    Vector3 to_local(const Vector3 &point) const
    {
        dVector3 local;
        dBodyGetPosRelPoint(body, point.x(), point.y(), point.z(), local);
        return {local[0], local[1], local[2]};
    }

    Vector3 direction_to_local(const Vector3 &direction) const
    {
        dVector3 local;
        dBodyVectorFromWorld(body, direction.x(), direction.y(), direction.z(), local);
        return {local[0], local[1], local[2]};
    }

    const dBodyID body;
    dGeomID geom = nullptr;

private:
    OdeMesh mesh_;
};

class ContactTrackerTest : public testing::TestWithParam<bool>
{
protected:
    const std::vector<Touch> &look(const Vector3 &tool, const std::vector<const Plate *> &plates)
    {
        tracker_.begin();
        tracker_.aim(tool);
        for (const Plate *plate : plates)
            tracker_.add(*NearbyGeom::read(plate->geom, meshes_, {}));
        tracker_.follow();
        touches_.clear();
        tracker_.touches(TouchView::all_together, touches_);
        return touches_;
    }

    const OdeUse ode_;
    ProbeWorld world_;
    MeshStore meshes_;
    ContactTracker tracker_{radius};
    std::vector<Touch> touches_;
};

INSTANTIATE_TEST_SUITE_P(Plates, ContactTrackerTest, testing::Bool(),
                         [](const auto &info) { return info.param ? "Meshes" : "Boxes"; });

TEST_P(ContactTrackerTest, AThinPlateThatMovesAndTurnsIsNeverPassed)
{
    const Plate plate(world_, GetParam());
    RandomNumbers random(1);
    Vector3 tool(0, 0, 0.05);
    int behind = 0;
    for (int tick = 0; tick < 20000; ++tick)
    {
        if (tick % 100 == 0)
        {
            const dReal *place = dBodyGetPosition(plate.body);
            const Vector3 velocity = random.in_cube(1) - 2 * Vector3(place[0], place[1], place[2]);
            const Vector3 spin = random.in_cube(3);
            dBodySetLinearVel(plate.body, velocity.x(), velocity.y(), velocity.z());
            dBodySetAngularVel(plate.body, spin.x(), spin.y(), spin.z());
        }
        tool += random.in_cube(tick % 50 == 0 ? 0.03 : 0.001) - 0.001 * tool;
        const auto &touches = look(tool, {&plate});
        ASSERT_GE(plate.to_local(tracker_.proxy()).z(), 0.999 * radius) << tick;
        for (const Touch &touch : touches)
            ASSERT_GT(plate.direction_to_local(touch.normal).z(), 0.999) << tick;
        behind += plate.to_local(tool).z() < -radius ? 1 : 0;
        world_.step(dt);
    }
    EXPECT_GT(behind, 1000);
}

TEST_P(ContactTrackerTest, WhatIsSqueezedBetweenPlatesKeepsItsSideOfEach)
{
    const Plate below(world_, GetParam());
    const Plate above(world_, GetParam());
    const dQuaternion turned = {0, 1, 0, 0}; // its top faces down
    dBodySetQuaternion(above.body, turned);
    for (int tick = 0; tick < 2000; ++tick)
    {
        // The gap closes from 10 cm to 4 mm, which is less than the probe, and opens again.
        const double gap = 0.052 + 0.048 * std::cos(tick * 2 * M_PI / 2000);
        dBodySetPosition(below.body, 0, 0, -gap / 2);
        dBodySetPosition(above.body, 0, 0, gap / 2);
        const Vector3 tool(0.0002 * tick, 0, 0.03 * std::sin(0.05 * tick));
        for (const Touch &touch : look(tool, {&below, &above}))
        {
            const Plate &plate = touch.object == object_of(below.geom) ? below : above;
            ASSERT_GT(plate.direction_to_local(touch.normal).z(), 0.999) << tick;
        }
        if (gap > 2.1 * radius)
        {
            ASSERT_GE(below.to_local(tracker_.proxy()).z(), 0.999 * radius) << tick;
            ASSERT_GE(above.to_local(tracker_.proxy()).z(), 0.999 * radius) << tick;
        }
    }
}

TEST(ContactTracker, LooksWhereverTheServoHoldsSomething)
{
    ContactMemory memory;
    memory.has_proxy = true;
    memory.proxy = {1, 0, 0};
    memory.places.emplace_back().at = {1.05, 0, 0}; // squeezed
    ContactTracker tracker(radius);
    tracker.begin();
    tracker.aim({1, 0, 0});
    tracker.begin();
    tracker.adopt(memory);
    tracker.aim({1.01, 0, 0});
    const ContactTracker::Region region = tracker.region();
    for (const double x : {1.0, 1.05, 1.03}) // the proxy, the squeezed place, the tool two steps ahead
        EXPECT_LE((Vector3(x, 0, 0) - region.centre).norm() + radius, region.radius) << x;
}

/// m; the largest radius of the region while the tool moves 1.4 m away. @param before called with the progress, 0 to 1.
double largest_region(const std::vector<dGeomID> &geoms, const std::function<void(double)> &before)
{
    MeshStore meshes;
    ContactTracker tracker(radius);
    double largest = 0;
    constexpr int ticks = 1000;
    for (int tick = 0; tick < ticks; ++tick)
    {
        const double part = static_cast<double>(tick) / ticks;
        before(part);
        tracker.begin();
        tracker.aim({part, 0, part});
        largest = std::max(largest, tracker.region().radius);
        for (const dGeomID geom : geoms)
            tracker.add(*NearbyGeom::read(geom, meshes, {}));
        tracker.follow();
    }
    return largest;
}

// Once, the places of geoms that did not hold the sphere moved to the tool: the region grew to 1.4 m.
TEST(ContactTracker, WhatHoldsTheSphereKeepsTheRegionSmallWhereverTheToolIs)
{
    const OdeUse ode;
    ProbeWorld world;
    const OdeMesh mesh(
        box_mesh(Vector3::Constant(-0.75 * radius), Vector3::Constant(0.75 * radius))); // smaller than the probe
    const dGeomID cage = mesh.add_to(world.space);
    const dGeomID other = world.add_box({0.01, 0.01, 0.01}, {0.03, 0, -0.01});
    EXPECT_LT(largest_region({cage, other}, [](double) {}), 5.1 * radius);
}

// Once, the region included the places on both plates: 0.53 m.
TEST(ContactTracker, PlatesThatPassEachOtherKeepTheRegionSmall)
{
    const OdeUse ode;
    for (const bool as_mesh : {false, true})
    {
        ProbeWorld world;
        const Plate below(world, as_mesh), above(world, as_mesh);
        const dQuaternion turned = {0, 1, 0, 0}; // its top faces down
        dBodySetQuaternion(above.body, turned);
        const auto move = [&](double part) {
            dBodySetPosition(below.body, 0, 0, 0.25 * part - 0.75 * radius);
            dBodySetPosition(above.body, 0, 0, 0.75 * radius - 0.25 * part);
        };
        EXPECT_LT(largest_region({below.geom, above.geom}, move), 5.5 * radius) << as_mesh;
    }
}

TEST(ContactTracker, OfTooManyGeomsTheNearestStayInWhateverOrderTheyCome)
{
    ContactTracker tracker(radius);
    tracker.begin();
    tracker.aim({0, 0, 0});
    constexpr std::size_t count = touch_capacity + 2;
    std::array<char, count> names{};
    ProbeTool ball;
    ball.radius = 1e-6;
    for (std::size_t i = 0; i < count; ++i)
    {
        ball.region = reinterpret_cast<dGeomID>(&names[i]);
        ball.centre.x() = 1e-5 * static_cast<double>(count - i);
        tracker.add_if_near(NearbyGeom::of(ball));
    }
    EXPECT_TRUE(tracker.exceeds_capacity());
    ASSERT_EQ(tracker.near().size(), touch_capacity);
    EXPECT_EQ(tracker.near().front().geom.id(), ball.region);
    EXPECT_NEAR(tracker.near().back().distance, 1e-5 * touch_capacity - ball.radius, 1e-12);
    tracker.begin();
    EXPECT_FALSE(tracker.exceeds_capacity());
}

TEST(ContactTracker, OfTooManyTouchesThoseThatHoldTheProxyStay)
{
    Touch touch;
    touch.depth = 0.001;
    touch.is_solved = true;
    std::vector<Touch> touches(touch_capacity + 1, touch);
    touches.back().depth = touches.back().carry.share = 0.0005;
    EXPECT_TRUE(keep_within_capacity(touches));
    const auto holds = [](const Touch &kept) { return kept.carry.carries(); };
    EXPECT_EQ(std::count_if(touches.begin(), touches.end(), holds), 1);
}

TEST(ContactTracker, KeepsAMeshAliveUntilAnotherTakesItsPlace)
{
    const OdeUse ode;
    ProbeWorld world;
    MeshStore meshes;
    const OdeMesh mesh(sheet_mesh(0.1, 2));
    const dGeomID geom = mesh.add_to(world.space);
    std::weak_ptr<const MeshTree> tree = meshes.tree_of(geom, {});
    ContactTracker tracker(radius);
    tracker.begin();
    tracker.aim({0, 0, 0});
    tracker.add(*NearbyGeom::read(geom, meshes, {}));
    std::vector<HeldGeom> handed_over = tracker.near();
    tracker.begin();
    meshes.forget(mesh.data());
    const NearbyGeom borrowed = handed_over[0].geom.later(0.01);
    EXPECT_EQ(tree.use_count(), 1) << "what is borrowed owns nothing";
    handed_over = tracker.near();
    EXPECT_TRUE(handed_over.empty());
    EXPECT_TRUE(tree.expired());
}
} // namespace
} // namespace ode_predictive_space::haptics
