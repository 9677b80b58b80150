// Bodies with joints and contacts respond to a push in two threads as in one.

#include "tests/haptics/forecast/coupling_run.h"
#include "tests/haptics/forecast/leaning.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

namespace ode_predictive_space::haptics
{
namespace
{
struct NamedCase
{
    const char *name;
    CouplingCase scenario;
    Stepper stepper;
    std::vector<double> rates; ///< Hz; of the scene
};

std::ostream &operator<<(std::ostream &stream, const NamedCase &named)
{
    return stream << named.name;
}

void add_both(std::vector<NamedCase> &cases, const char *name, const CouplingCase &scenario,
              const std::vector<double> &exact_rates, const std::vector<double> &quick_rates)
{
    for (const Stepper stepper : {Stepper::exact, Stepper::quick})
    {
        const std::vector<double> &rates = stepper == Stepper::exact ? exact_rates : quick_rates;
        if (!rates.empty())
            cases.push_back({name, scenario, stepper, rates});
    }
}

class CouplingTest : public testing::TestWithParam<NamedCase>
{};

TEST_P(CouplingTest, TwoThreadsAreAsOne)
{
    expect_as_one_at(GetParam().rates, GetParam().scenario, GetParam().stepper);
}

std::vector<NamedCase> coupled_scenes()
{
    std::vector<NamedCase> cases;
    add_both(cases, "RopeOfThreeLightBalls", rope(3, 0.002), all_rates, all_rates);
    add_both(cases, "RopeOfThreeBalls", rope(3, 0.02), all_rates, all_rates);
    add_both(cases, "RopeOfTwentyLightBalls", rope_of_twenty(), {60}, {60}); // at other rates: one of the long tests
    add_both(cases, "FreeBall", free_balls({0.01}), all_rates, {});
    add_both(cases, "Door", door(), all_rates, all_rates);
    add_both(cases, "Slider", slider(), all_rates, all_rates);
    add_both(cases, "Ragdoll", ragdoll(), all_rates, all_rates);
    add_both(cases, "Box", stack(1), all_rates, all_rates);
    add_both(cases, "Stack", stack(5), {}, all_rates); // by dWorldStep(): one of the long tests
    add_both(cases, "HeldBall", held_ball(), all_rates, all_rates);
    add_both(cases, "TwoBallsAtOnce", free_balls({0.01, 0.03}), all_rates, {});
    add_both(cases, "Leaning", leaning(5), all_rates, {});
    return cases;
}

std::vector<NamedCase> several_touches()
{
    std::vector<NamedCase> cases;
    add_both(cases, "Corner", corner(), all_rates, {});
    add_both(cases, "CornerByProxyLaw", by_proxy_law(corner()), all_rates, {});
    add_both(cases, "DraggedCart", dragged_cart(), all_rates, all_rates);
    add_both(cases, "DraggedCartByProxyLaw", by_proxy_law(dragged_cart()), all_rates, all_rates);
    add_both(cases, "RopeWithFriction", with_friction(rope(3, 0.02), 0.5), all_rates, all_rates);
    add_both(cases, "DoorWithFriction", with_friction(door(), 0.5), all_rates, all_rates);
    return cases;
}

std::vector<NamedCase> changed_scenes()
{
    std::vector<NamedCase> cases;
    const auto add_change = [&](const char *name, const CouplingCase &scenario,
                                const std::function<void(CouplingScene &)> &change) {
        add_both(cases, name, with_change(scenario, change), all_rates, all_rates);
    };
    CouplingCase destroyed = rope(3, 0.02);
    destroyed.most_unmatched = 0.03; // the hand's last impulse has no body
    add_change("ABodyIsDestroyed", destroyed, [](CouplingScene &scene) { scene.destroy(1); });
    add_change("AJointIsDestroyed", rope(3, 0.02),
               [](CouplingScene &scene) { dJointDestroy(dConnectingJoint(scene.bodies[1], scene.bodies[2])); });
    add_change("AJointGroupIsEmptied", rope(3, 0.02, true),
               [](CouplingScene &scene) { dJointGroupEmpty(scene.joints); });
    add_change("BodiesAreDisabled", rope(3, 0.02),
               [](CouplingScene &scene) { std::for_each(scene.bodies.begin(), scene.bodies.end(), &dBodyDisable); });
    return cases;
}

std::string name_of_case(const testing::TestParamInfo<NamedCase> &info)
{
    return std::string(info.param.name) + (info.param.stepper == Stepper::quick ? "ByQuickStep" : "");
}

INSTANTIATE_TEST_SUITE_P(Scenes, CouplingTest, testing::ValuesIn(coupled_scenes()), name_of_case);
INSTANTIATE_TEST_SUITE_P(Touches, CouplingTest, testing::ValuesIn(several_touches()), name_of_case);
INSTANTIATE_TEST_SUITE_P(Changes, CouplingTest, testing::ValuesIn(changed_scenes()), name_of_case);

TEST(Coupling, ACornerIsTouchedByBothItsWalls)
{
    EXPECT_EQ(CoupledRun(corner(), Vector3::Zero(), Stepper::exact, 100).outcome().most_touches, 2);
}

// Each step of the scene takes 2 ms of simulated time.
TEST(Coupling, ARopeHoldsWhenTheSceneComesLate)
{
    const CouplingCase scenario = rope(3, 0.002);
    const Outcome truth = ensemble(scenario, Stepper::exact, one_thread);
    expect_as_one(ensemble(scenario, Stepper::exact, 100, 0.002), truth, scenario, 100);
}

TEST_P(LeaningTest, HalfAMinuteIsAsOneThread)
{
    expect_steady(30);
}

TEST_P(LeaningTest, TenSecondsOfScrubbingAreAsOneThread)
{
    expect_even(10);
}

INSTANTIATE_TEST_SUITE_P(Loops, LeaningTest, leaning_loops, leaning_name);

TEST(Coupling, ItIsToldWhenTheSceneIsSteppedMoreOften)
{
    EXPECT_GE(CoupledRun(rope_of_twenty(), Vector3::Zero(), Stepper::exact, 60).outcome().notices, 1);
    EXPECT_EQ(CoupledRun(door(), Vector3::Zero(), Stepper::exact, 60).outcome().notices, 0);
}

TEST(Coupling, AProgramWhoseStepIsNotOdesIsFeltByItsVelocitiesAndItIsTold)
{
    const OdeUse ode;
    CouplingScene scene(Stepper::exact);
    const CouplingCase scenario = rope(1, 1);
    scenario.build(scene);
    SimulatedClock clock;
    NoticeList notices;
    ScriptedDevice device([](double t) { return Vector3(0.015 - 0.003 * std::clamp(2 * t - 2, 0.0, 1.0), 0, 0); });
    device.open();
    HapticProbe probe(device, scene.space, 0.005, with_stiffness(CouplingCase::stiffness));
    LoopSettings settings = simulated(clock, 2, true, 100);
    settings.notice = notices.sink();
    dJointDestroy(dBodyGetJoint(scene.bodies[0], 0)); // ODE would let it fall, the program does not
    int pressed = 0;
    probe.set_recorder([&](const RenderedTick &tick) {
        pressed += tick.time > 1.8 ? 1 : 0;
        EXPECT_TRUE(tick.time <= 1.8 || std::abs(tick.requested.x() - 1) < 0.2) << tick.requested.x() << " N";
        EXPECT_NEAR(tick.requested.z(), 0, 1e-6) << "the hand does not feel a fall that does not happen";
    });
    HapticLoop loop(probe, settings);
    loop.run({[&] { scene.collide(probe); }, [&](double) { dBodySetForce(scene.bodies[0], 0, 0, 0); }});
    EXPECT_EQ(notices.count(NoticeKind::coupling), 1) << notices.text(NoticeKind::coupling);
    EXPECT_GT(pressed, 100);
}

// A row of balls that moves as one is pushed at its far end, which the trial steps leave out.
TEST(Coupling, AProgramIsNotBlamedForWhatTheTrialStepsLeaveOut)
{
    const OdeUse ode;
    CouplingScene scene(Stepper::exact);
    dBodyID last = scene.add_ball(0.05, 0.01, Vector3::Zero());
    for (int i = 1; i < 40; ++i)
    {
        const dBodyID next = scene.add_ball(0.05, 0.01, Vector3(0.03 * i, 0, 0));
        const dJointID joint = dJointCreateFixed(scene.world, scene.joints);
        dJointAttach(joint, last, next);
        dJointSetFixed(joint);
        last = next;
    }
    SimulatedClock clock;
    NoticeList notices;
    ScriptedDevice device([](double) { return Vector3(-0.0155, 0, 0); });
    device.open();
    HapticProbe probe(device, scene.space, 0.005, with_stiffness(CouplingCase::stiffness));
    LoopSettings settings = simulated(clock, 1, true, 100);
    settings.notice = notices.sink();
    double push = 10; // N
    HapticLoop loop(probe, settings);
    loop.run({[&] {
                  scene.collide(probe);
                  dBodyAddForce(last, push, 0, 0);
                  push = -push;
              },
              [&](double dt) { scene.step(dt); }});
    EXPECT_EQ(notices.count(NoticeKind::coupling), 0) << notices.text(NoticeKind::coupling);
}
} // namespace
} // namespace ode_predictive_space::haptics
