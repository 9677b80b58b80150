// ODE would end the program for a body whose state is not finite. The loop ends before that.

#include "ode_predictive_space/haptics/loop/scene_bodies.h"
#include "tests/haptics/loop/loop_fixture.h"
#include "tests/haptics/support/constants.h"
#include "tests/support/error_of.h"

#include <cstdio>
#include <gtest/gtest.h>
#include <string>
#include <tuple>

namespace ode_predictive_space::haptics
{
namespace
{
/// A part of a body's state, and a way to break it without an assertion of ODE's.
struct Part
{
    const char *name;
    void (*spoil)(dBodyID body, double number);
};

const Part all_parts[] = {
    {"position", [](dBodyID body, double number) { dBodySetPosition(body, 0, number, 0); }},
    {"rotation", [](dBodyID body, double number) { const_cast<dReal *>(dBodyGetQuaternion(body))[1] = number; }},
    {"velocity", [](dBodyID body, double number) { dBodySetLinearVel(body, 0, number, 0); }},
    {"spin", [](dBodyID body, double number) { dBodySetAngularVel(body, 0, 0, number); }},
    {"force", [](dBodyID body, double number) { dBodyAddForce(body, number, 0, 0); }},
    {"torque", [](dBodyID body, double number) { dBodyAddTorque(body, 0, 0, number); }},
};

std::string address(const void *object)
{
    char text[32];
    std::snprintf(text, sizeof text, "%p", object);
    return text;
}

TEST(BrokenState, NamesTheBodyAndWhatIsBroken)
{
    const OdeUse ode;
    for (const Part &part : all_parts)
    {
        for (const double number : {nan, infinity})
        {
            ProbeWorld world;
            const dBodyID body = world.add_body({0, 0, 0}, 1);
            EXPECT_EQ(broken_state_of(body), "");
            dBodySetData(body, &world);
            part.spoil(body, number);
            const std::string sentence = broken_state_of(body);
            EXPECT_NE(sentence.find("The " + std::string(part.name) + " of body " + address(body)), std::string::npos)
                << sentence;
            EXPECT_NE(sentence.find(address(&world)), std::string::npos) << sentence;
        }
    }
    EXPECT_EQ(broken_state_of(nullptr), "");
}

TEST(SceneBodies, AreInSpacesAroundAndWithin)
{
    const OdeUse ode;
    ProbeWorld world;
    const dSpaceID inner = dHashSpaceCreate(world.space);
    const dSpaceID innermost = dSimpleSpaceCreate(inner);
    const dGeomID probe = dCreateSphere(inner, 1);
    const dBodyID body = world.add_body({0, 0, 0}, 1);
    const dGeomID geom = dCreateSphere(innermost, 1);
    dGeomSetBody(geom, body);
    SceneBodies bodies(probe);
    EXPECT_EQ(bodies.broken_state(nullptr, probe), "");
    dBodySetLinearVel(body, nan, 0, 0);
    EXPECT_EQ(bodies.broken_state(nullptr, probe), broken_state_of(body));
    EXPECT_NE(broken_state_of(body).find(address(geom)), std::string::npos);
}

TEST(SceneBodies, OfAKnownWorldNeedNoGeom)
{
    const OdeUse ode;
    ProbeWorld world;
    const dGeomID probe = dCreateSphere(world.space, 1);
    const dBodyID body = world.add_body({0, 0, 0}, 1);
    dBodySetAngularVel(body, nan, 0, 0);
    EXPECT_EQ(SceneBodies(probe).broken_state(nullptr, probe), "");
    EXPECT_EQ(SceneBodies(nullptr).broken_state(body, nullptr), broken_state_of(body)) << "it is the tool";
    world.add_moving_box({1, 1, 1}, {3, 0, 0}, 1);
    EXPECT_EQ(SceneBodies(probe).broken_state(nullptr, probe), broken_state_of(body));
}

TEST(SceneBodies, AreThoseOfAllWorldsInTheSpace)
{
    const OdeUse ode;
    ProbeWorld one, other;
    const dGeomID probe = dCreateSphere(one.space, 1);
    const dBodyID bodies[] = {one.add_body({0, 0, 0}, 1), other.add_body({0, 0, 0}, 1)};
    for (const dBodyID body : bodies)
        dGeomSetBody(dCreateSphere(one.space, 1), body);
    SceneBodies scene(probe);
    for (const dBodyID body : bodies)
    {
        dBodySetLinearVel(body, nan, 0, 0);
        EXPECT_EQ(scene.broken_state(nullptr, probe), broken_state_of(body));
        dBodySetLinearVel(body, 0, 0, 0);
    }
}

TEST(SceneBodies, AreNotLookedForInAQuadtree)
{
    const OdeUse ode;
    const dVector3 centre = {};
    const dVector3 extents = {1, 1, 1};
    const dSpaceID tree = dQuadTreeSpaceCreate(nullptr, centre, extents, 1);
    const dGeomID probe = dCreateSphere(tree, 1);
    EXPECT_EQ(SceneBodies(probe).broken_state(nullptr, probe), "") << "which cannot list its geoms";
    dSpaceDestroy(tree);
}

TEST(SceneBodies, MayComeLater)
{
    const OdeUse ode;
    ProbeWorld world;
    const dGeomID probe = dCreateSphere(world.space, 1);
    SceneBodies bodies(probe);
    EXPECT_EQ(bodies.broken_state(nullptr, probe), "");
    const dBodyID late = world.add_moving_box({1, 1, 1}, {3, 0, 0}, 1);
    dBodySetLinearVel(late, nan, 0, 0);
    EXPECT_EQ(bodies.broken_state(nullptr, probe), broken_state_of(late));
    dBodySetLinearVel(late, 0, 0, 0);
    EXPECT_EQ(bodies.broken_state(nullptr, probe), "");
    const dBodyID later = world.add_body({3, 0, 0}, 1);
    dBodySetLinearVel(later, nan, 0, 0);
    EXPECT_EQ(bodies.broken_state(nullptr, probe), broken_state_of(later));
}

TEST(SceneBodies, GoWithTheirWorldAndThoseOfTheNextOneAreFound)
{
    const OdeUse ode;
    const dSpaceID space = dSimpleSpaceCreate(nullptr);
    const dGeomID probe = dCreateSphere(space, 1);
    dWorldID world = dWorldCreate();
    dGeomSetBody(probe, dBodyCreate(world));
    SceneBodies bodies(probe);
    for (int i = 0; i < 3; ++i)
    {
        EXPECT_EQ(bodies.broken_state(nullptr, probe), "");
        dWorldDestroy(world);
        world = dWorldCreate();
        const dBodyID body = dBodyCreate(world);
        dGeomSetBody(probe, body);
        dBodySetLinearVel(body, nan, 0, 0);
        EXPECT_EQ(bodies.broken_state(nullptr, probe), broken_state_of(body));
        dBodySetLinearVel(body, 0, 0, 0);
    }
    dWorldDestroy(world);
    EXPECT_EQ(bodies.broken_state(nullptr, probe), "");
    dSpaceDestroy(space);
}

TEST(SceneBodies, LeaveAWorldAsItWas)
{
    const OdeUse ode;
    ProbeWorld world;
    const dBodyID body = world.add_moving_box({1, 1, 1}, {3, 0, 0}, 1);
    {
        SceneBodies bodies(dBodyGetFirstGeom(body));
        EXPECT_EQ(bodies.broken_state(nullptr, dBodyGetFirstGeom(body)), "");
        EXPECT_EQ(dBodyGetNumJoints(body), 0);
        EXPECT_EQ(dBodyGetNextGeom(dBodyGetFirstGeom(body)), nullptr);
    }
    EXPECT_EQ(first_body_of(dBodyGetWorld(body)), body);
    EXPECT_EQ(next_body_of_world(body), nullptr);
}

using LoopBodyTest = HapticLoopTest;

INSTANTIATE_TEST_SUITE_P(Kinds, LoopBodyTest, testing::Bool(), name_of_loop);

enum class In
{
    collide,
    advance
};

class BrokenBodyRun
{
public:
    BrokenBodyRun(bool decoupled, SpaceChoice space, const Part &part, In in)
        : world_(space), scripted_(&press_down), log_(scripted_, clock_), part_(part), in_(in)
    {
        dCreatePlane(world_.space, 0, 0, 1, 0);
        body_ = world_.add_moving_box({0.1, 0.1, 0.1}, {2, 0, 1}, 1);
        other_ = world_.add_moving_box({0.1, 0.1, 0.1}, {4, 0, 1}, 1);
        dBodySetLinearVel(other_, 0, 0, 1);
        settings_ = simulated(clock_, 3, decoupled);
        settings_.notice = notices_.sink();
    }

    void run()
    {
        HapticProbe probe(log_, world_.space, radius, usual_rendering());
        HapticLoop loop(probe, settings_);
        thrown_ = error_of<std::runtime_error>([&] {
                      loop.run({[&] {
                                    world_.collide(probe);
                                    spoil(In::collide);
                                },
                                [&](double dt) {
                                    steps_after_ += broken_at_ > 0 ? 1 : 0;
                                    world_.step(dt);
                                    spoil(In::advance);
                                }});
                  }).what();
        force_at_end_ = log_.force_at(clock_.now()); // the probe still has the device
    }

    void expect_named_and_left_alone() const
    {
        EXPECT_NE(thrown_.find("The " + std::string(part_.name) + " of body " + address(body_)), std::string::npos)
            << thrown_;
        EXPECT_NE(notices_.text(NoticeKind::exception).find(thrown_), std::string::npos);
        EXPECT_EQ(steps_after_, 0);
        EXPECT_EQ(dBodyGetPosition(other_)[2], place_of_other_);
        EXPECT_TRUE(Vector3::Map(dBodyGetForce(other_)).isZero(0));
        EXPECT_GT(force_before_, 0.1);
        EXPECT_TRUE(force_at_end_.isZero(0));
    }

private:
    void spoil(In in)
    {
        if (in == in_ && broken_at_ == 0 && clock_.now() >= pressed_after)
        {
            broken_at_ = clock_.now();
            force_before_ = log_.force_at(broken_at_).z();
            place_of_other_ = dBodyGetPosition(other_)[2];
            part_.spoil(body_, nan);
        }
    }

    SimulatedClock clock_;
    ProbeWorld world_;
    NoticeList notices_;
    ScriptedDevice scripted_;
    WriteLog log_;
    LoopSettings settings_;
    const Part &part_;
    In in_;
    dBodyID body_ = nullptr;
    dBodyID other_ = nullptr;
    double broken_at_ = 0;    ///< s
    double force_before_ = 0; ///< N
    dReal place_of_other_ = 0;
    int steps_after_ = 0;
    std::string thrown_;
    Vector3 force_at_end_ = Vector3::Ones();
};

TEST_P(LoopBodyTest, EndsTheLoopWithItsNameAndTheWorldIsLeftAsItIs)
{
    for (const SpaceChoice space : all_space_choices)
    {
        for (const Part &part : all_parts)
        {
            for (const In in : {In::collide, In::advance})
            {
                SCOPED_TRACE(part.name + std::string(in == In::collide ? " in collide" : " in advance"));
                BrokenBodyRun run(GetParam(), space, part, in);
                run.run();
                run.expect_named_and_left_alone();
            }
        }
    }
}

TEST_P(LoopBodyTest, ThatIsTouchedEndsTheLoopToo)
{
    make();
    const dBodyID body = world_.add_moving_box({0.1, 0.1, 0.1}, {0, 0, -0.05}, 100);
    const auto error = error_of<std::runtime_error>(
        [&] { loop_->run(work(Once(clock_, pressed_after, [&] { dBodySetAngularVel(body, nan, 0, 0); }))); });
    EXPECT_NE(std::string(error.what()).find(address(body)), std::string::npos);
    EXPECT_TRUE(log_.force_at(clock_.now()).isZero(0));
}

TEST(LoopBody, OfTheToolEndsTheLoopWithOrWithoutAGeom)
{
    const OdeUse ode;
    for (const bool has_geom : {true, false})
    {
        ProbeWorld world;
        SimulatedClock clock;
        ScriptedDevice device(&press_down);
        const dBodyID tool =
            has_geom ? world.add_moving_box({0.1, 0.1, 0.1}, {0, 0, 0}, 1) : world.add_body({0, 0, 0}, 1);
        HapticProbe probe(device, tool, {});
        HapticLoop loop(probe, simulated(clock, 1));
        EXPECT_THROW(loop.run(world.work(probe, [&](double) { dBodySetAngularVel(tool, nan, 0, 0); })),
                     std::runtime_error);
        EXPECT_TRUE(device.last_wrench().force.isZero(0));
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
