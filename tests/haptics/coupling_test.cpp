// Bodies with joints and contacts, pushed in two threads as in one. In simulated time, where both threads are one: the same in each run.
//
// Such motions are knife-edges: a hand moved by a micrometre may change a peak by a factor of two. So ensembles of hands are compared,
// not traces.

#include "ode_predictive_space/haptics/loop.h"

#include "tests/haptics/constants.h"
#include "tests/haptics/coupling_scene.h"
#include "tests/haptics/scripted_device.h"

#include <cmath>
#include <gtest/gtest.h>
#include <ostream>
#include <string>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double stiffness = 500; // N/m
constexpr int hands = 8;
constexpr double one_thread = 0; // Hz; the rate of the scene in two threads, otherwise

/// What came of one hand.
struct Outcome
{
    double peak_force = 0;  ///< N
    double peak_speed = 0;  ///< m/s; of any body
    double impulse = 0;     ///< N s; the sum of magnitudes
    double made_energy = 0; ///< J; at most: given to the hand and to the scene
    double hand_work = 0;   ///< J; what the hand put in
    double unmatched = 0;   ///< in parts of the impulse on the hand: what the bodies did not get
    int notices = 0;
};

/// Means, but for made_energy and unmatched, of which it is the worst.
Outcome mean_of(const std::vector<Outcome> &outcomes)
{
    Outcome mean;
    const double part = 1.0 / static_cast<double>(outcomes.size());
    for (const Outcome &outcome : outcomes)
    {
        mean.peak_force += part * outcome.peak_force;
        mean.peak_speed += part * outcome.peak_speed;
        mean.impulse += part * outcome.impulse;
        mean.hand_work += part * outcome.hand_work;
        mean.made_energy = std::max(mean.made_energy, outcome.made_energy);
        mean.unmatched = std::max(mean.unmatched, outcome.unmatched);
        mean.notices = std::max(mean.notices, outcome.notices);
    }
    return mean;
}

/// A run, and what is measured in it.
class CoupledRun
{
public:
    CoupledRun(const CouplingCase &scenario, const Vector3 &offset, Stepper stepper, double physics_rate, double late)
        : scene_(stepper), hand_(scenario.hand), decoupled_(physics_rate != one_thread)
    {
        dRandSetSeed(1);
        scenario.build(scene_);
        hand_.from += offset;
        energy_before_ = scene_.energy();
        ScriptedDevice device([this](double seconds) { return hand_.at(seconds); });
        WriteLog log(device, clock_);
        HapticProbe probe(log, scene_.space, radius, with_stiffness(stiffness));
        probe.set_recorder([this](const RenderedTick &tick) { note(tick); });
        LoopSettings settings;
        settings.decoupled = decoupled_;
        settings.physics_rate = physics_rate;
        settings.duration = HandWay::rests + hand_.duration;
        settings.clock = &clock_;
        settings.ask_for_priority = false;
        settings.notice = [this](const Notice &notice) {
            outcome_.notices += notice.kind == NoticeKind::coupling ? 1 : 0;
        };
        HapticLoop loop(probe, settings);
        loop.run({[&] { scene_.collide(probe); },
                  [&](double step) {
                      pushed_ += step * scene_.force_of_hand();
                      scene_.step(step);
                      clock_.advance(late);
                      note_step();
                  }});
        pushed_ += scene_.force_of_hand() / (decoupled_ ? physics_rate : 1000.0);
        if (outcome_.impulse > 0)
        {
            const Vector3 given = given_by(log);
            outcome_.unmatched = decoupled_ ? (pushed_ + given).norm() / given.norm() : 0;
        }
    }

    const Outcome &outcome() const { return outcome_; }
    const CouplingScene &scene() const { return scene_; }

private:
    /// N s; on the hand.
    Vector3 given_by(const WriteLog &log) const
    {
        Vector3 sum = Vector3::Zero();
        for (std::size_t i = 0; i < log.writes().size(); ++i)
        {
            const double until = i + 1 < log.writes().size() ? log.writes()[i + 1].time : clock_.now();
            sum += (until - log.writes()[i].time) * log.writes()[i].wrench.force;
        }
        return sum;
    }

    void note(const RenderedTick &tick)
    {
        const double force = tick.force.norm();
        outcome_.peak_force = std::max(outcome_.peak_force, force);
        outcome_.impulse += force * dt;
        if (has_tick_)
        {
            work_ += last_force_.dot(tick.tool.position - last_place_);
        }
        outcome_.hand_work = -work_;
        last_force_ = tick.force;
        last_place_ = tick.tool.position;
        has_tick_ = true;
    }

    void note_step()
    {
        const double speed = scene_.speed();
        outcome_.peak_speed = std::max(outcome_.peak_speed, speed);
        outcome_.made_energy = std::max(outcome_.made_energy, work_ + scene_.energy() - energy_before_);
    }

    const OdeUse ode_;
    SimulatedClock clock_;
    CouplingScene scene_;
    HandWay hand_;
    bool decoupled_;
    Outcome outcome_;
    double energy_before_;
    double work_ = 0; ///< J; on the hand
    Vector3 pushed_ = Vector3::Zero();
    Vector3 last_force_ = Vector3::Zero();
    Vector3 last_place_ = Vector3::Zero();
    bool has_tick_ = false;
};

Outcome ensemble(const CouplingCase &scenario, Stepper stepper, double physics_rate, double late = 0)
{
    std::vector<Outcome> outcomes;
    for (int i = 0; i < hands; ++i)
    {
        const double y = scenario.spread_along * (-1 + 2 * (i + 0.5) / hands);
        const double z = scenario.spread_across * std::sin(7.0 * i + 1);
        outcomes.push_back(CoupledRun(scenario, {0, y, z}, stepper, physics_rate, late).outcome());
    }
    return mean_of(outcomes);
}

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

class CouplingTest : public testing::TestWithParam<NamedCase>
{};

TEST_P(CouplingTest, TwoThreadsAreAsOne)
{
    const CouplingCase &scenario = GetParam().scenario;
    const Outcome truth = ensemble(scenario, GetParam().stepper, one_thread);
    ASSERT_GT(truth.peak_force, 0.1);
    for (const double rate : GetParam().rates)
    {
        SCOPED_TRACE(std::to_string(rate) + " Hz");
        const Outcome found = ensemble(scenario, GetParam().stepper, rate);
        EXPECT_GE(found.peak_force, 0.8 * truth.peak_force);
        EXPECT_LE(found.peak_force, 1.15 * truth.peak_force);
        EXPECT_LE(found.peak_speed, 1.2 * std::max(truth.peak_speed, scenario.hand.speed));
        EXPECT_LE(found.unmatched, 1e-9);
        EXPECT_LE(found.made_energy, truth.made_energy + (rate < 100 ? 0.1 : 0.05) * std::abs(found.hand_work));
    }
}

const std::vector<double> all_rates = {60, 100, 200, 500};
const std::vector<double> fast_rates = {200, 500};

INSTANTIATE_TEST_SUITE_P(
    Scenes, CouplingTest,
    testing::Values(NamedCase{"RopeOfThreeLightBalls", rope(3, 0.002), Stepper::exact, all_rates},
                    NamedCase{"RopeOfThreeLightBallsByQuickStep", rope(3, 0.002), Stepper::quick, all_rates},
                    NamedCase{"RopeOfThreeBalls", rope(3, 0.02), Stepper::exact, all_rates},
                    NamedCase{"RopeOfThreeBallsByQuickStep", rope(3, 0.02), Stepper::quick, all_rates},
                    NamedCase{"RopeOfTwentyLightBalls", rope(20, 0.002), Stepper::exact, {100, 200, 500}},
                    NamedCase{"RopeOfTwentyLightBallsByQuickStep", rope(20, 0.002), Stepper::quick, fast_rates},
                    NamedCase{"FreeBall", free_ball(0.01), Stepper::exact, all_rates},
                    NamedCase{"Door", door(), Stepper::exact, all_rates},
                    NamedCase{"DoorByQuickStep", door(), Stepper::quick, all_rates},
                    NamedCase{"Slider", slider(), Stepper::exact, all_rates},
                    NamedCase{"SliderByQuickStep", slider(), Stepper::quick, all_rates},
                    NamedCase{"Ragdoll", ragdoll(), Stepper::exact, all_rates},
                    NamedCase{"RagdollByQuickStep", ragdoll(), Stepper::quick, all_rates},
                    NamedCase{"StackByQuickStep", stack(), Stepper::quick, fast_rates},
                    NamedCase{"HeldBall", held_ball(), Stepper::exact, all_rates},
                    NamedCase{"HeldBallByQuickStep", held_ball(), Stepper::quick, all_rates},
                    NamedCase{"TwoBallsAtOnce", two_balls(), Stepper::exact, all_rates},
                    NamedCase{"Leaning", leaning(5), Stepper::exact, all_rates}),
    [](const testing::TestParamInfo<NamedCase> &info) { return std::string(info.param.name); });

// It needs its time: a step of the scene takes 4 ms.
TEST(Coupling, ARopeHoldsWhenTheSceneComesLate)
{
    const CouplingCase scenario = rope(3, 0.002);
    const Outcome truth = ensemble(scenario, Stepper::exact, one_thread);
    const Outcome found = ensemble(scenario, Stepper::exact, 100, 0.002);
    EXPECT_GE(found.peak_force, 0.8 * truth.peak_force);
    EXPECT_LE(found.peak_force, 1.15 * truth.peak_force);
    EXPECT_LE(found.peak_speed, 1.2 * truth.peak_speed);
    EXPECT_LE(found.unmatched, 1e-9);
}

TEST(Coupling, AFreeBallLeavesTheHandAtTwiceItsSpeed)
{
    for (const double rate : all_rates)
    {
        const CoupledRun run(free_ball(0.01), Vector3::Zero(), Stepper::exact, rate, 0);
        EXPECT_NEAR(run.scene().speed(), 2 * 0.1, 1e-3) << rate << " Hz";
    }
}

// QuickStep lifts the box by up to 2 mm now and then: the hand must not feel it.
TEST(Coupling, LeaningOnABoxIsSteadyByQuickStep)
{
    for (const double rate : {100.0, 200.0, 500.0})
    {
        const Outcome truth = ensemble(leaning(5), Stepper::quick, one_thread);
        const Outcome found = ensemble(leaning(5), Stepper::quick, rate);
        EXPECT_NEAR(found.peak_force, truth.peak_force, 0.05 * truth.peak_force);
        EXPECT_NEAR(found.impulse, truth.impulse, 0.05 * truth.impulse) << rate << " Hz";
    }
}

TEST(Coupling, ItIsToldWhenTheSceneIsSteppedMoreOften)
{
    EXPECT_GE(CoupledRun(rope(20, 0.002), Vector3::Zero(), Stepper::exact, 60, 0).outcome().notices, 1);
    EXPECT_EQ(CoupledRun(door(), Vector3::Zero(), Stepper::exact, 60, 0).outcome().notices, 0);
}

TEST(Coupling, AProgramWhoseStepIsNotOdesIsFeltByItsVelocitiesAndItIsTold)
{
    const OdeUse ode;
    CouplingScene scene(Stepper::exact);
    const CouplingCase scenario = rope(1, 1);
    scenario.build(scene);
    SimulatedClock clock;
    NoticeList notices;
    ScriptedDevice device([&](double) { return Vector3(-0.015, 0, 0); });
    device.open();
    HapticProbe probe(device, scene.space, 0.005, with_stiffness(stiffness));
    LoopSettings settings;
    settings.decoupled = true;
    settings.physics_rate = 100;
    settings.duration = 2;
    settings.clock = &clock;
    settings.ask_for_priority = false;
    settings.notice = notices.sink();
    dJointDestroy(dBodyGetJoint(scene.bodies[0], 0)); // ODE would let it fall, the program does not
    HapticLoop loop(probe, settings);
    loop.run({[&] { scene.collide(probe); }, [](double) {}});
    EXPECT_EQ(notices.count(NoticeKind::coupling), 1) << notices.text(NoticeKind::coupling);
}

/// What a program does meanwhile to a rope that is being pushed.
class ChangedRopeTest : public testing::Test
{
protected:
    void expect_end_without_force(const std::function<void(CouplingScene &)> &change)
    {
        const OdeUse ode;
        CouplingScene scene(Stepper::exact);
        const CouplingCase scenario = rope(3, 0.02);
        scenario.build(scene);
        SimulatedClock clock;
        ScriptedDevice device([&](double seconds) { return scenario.hand.at(seconds); });
        HapticProbe probe(device, scene.space, radius, with_stiffness(stiffness));
        LoopSettings settings;
        settings.decoupled = true;
        settings.physics_rate = 100;
        settings.duration = 3;
        settings.clock = &clock;
        settings.ask_for_priority = false;
        HapticLoop loop(probe, settings);
        bool changed = false;
        loop.run({[&] { scene.collide(probe); },
                  [&](double step) {
                      scene.step(step);
                      if (!changed && loop.latest().force.norm() > 0.1)
                      {
                          changed = true;
                          change(scene);
                      }
                  }});
        EXPECT_TRUE(changed);
        EXPECT_TRUE(probe.last_tick().force.allFinite());
        EXPECT_LT(scene.speed(), 3 * CouplingScene::gravity) << "no faster than by its fall";
    }
};

TEST_F(ChangedRopeTest, ABodyIsDestroyed)
{
    expect_end_without_force([](CouplingScene &scene) {
        const dBodyID middle = scene.bodies[1];
        dGeomDestroy(dBodyGetFirstGeom(middle));
        dBodyDestroy(middle);
        scene.bodies.erase(scene.bodies.begin() + 1);
    });
}

TEST_F(ChangedRopeTest, AJointIsDestroyed)
{
    expect_end_without_force(
        [](CouplingScene &scene) { dJointDestroy(dConnectingJoint(scene.bodies[1], scene.bodies[2])); });
}

TEST_F(ChangedRopeTest, BodiesAreDisabled)
{
    expect_end_without_force([](CouplingScene &scene) {
        for (const dBodyID body : scene.bodies)
        {
            dBodyDisable(body);
        }
    });
}
} // namespace
} // namespace ode_predictive_space::haptics
