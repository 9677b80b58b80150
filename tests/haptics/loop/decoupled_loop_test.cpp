// The loop of two threads in simulated time, where both run in one, so that all runs are alike.

#include "ode_predictive_space/haptics/loop.h"

#include "ode_predictive_space/haptics/loop/scene_bodies.h"
#include "ode_predictive_space/haptics/penalty_law.h"
#include "ode_predictive_space/haptics/safety.h"
#include "tests/haptics/loop/loop_fixture.h"

#include <cmath>
#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
class DecoupledLoopTest : public testing::Test
{
protected:
    LoopSettings settings(double rate, double physics_rate, double duration)
    {
        LoopSettings settings = simulated(clock_, duration, true, physics_rate);
        settings.rate = rate;
        settings.notice = notices_.sink();
        return settings;
    }

    dBodyID add_box(double kilograms) { return world_.add_moving_box({0.1, 0.1, 0.1}, {0, 0, -0.05}, kilograms); }

    /// Runs a loop in which the hand pushes a body. @return the part of the impulse on the hand that the body does not get.
    double lost_momentum(dBodyID body, const ScriptedDevice::Path &path, RenderSettings rendering,
                         const LoopSettings &settings, const std::function<void(double)> &after_step = {})
    {
        ScriptedDevice device(path);
        WriteLog log(device, clock_);
        HapticProbe probe(log, world_.space, radius, std::move(rendering));
        probe.set_recorder(recorder_);
        HapticLoop loop(probe, settings);
        report_ = loop.run(world_.work(probe, after_step));
        EXPECT_EQ(first_body_of(world_.world), body) << "the loop leaves no body of its own";
        world_.step(1 / settings.physics_rate); // the hand's last impulse is pending
        EXPECT_GT(log.impulse().norm(), 0.5);
        return (log.impulse() + momentum_of(body)).norm() / log.impulse().norm();
    }

    const OdeUse ode_;
    SimulatedClock clock_;
    ProbeWorld world_;
    NoticeList notices_;
    std::function<void(const RenderedTick &)> recorder_; ///< may be empty
    LoopReport report_;                                  ///< of the last run
};

TEST_F(DecoupledLoopTest, WhatTheHandGetsTheBodyLosesAtAnyRates)
{
    const struct
    {
        double servo;
        double physics;
        double stiffness;
    } cases[] = {{1000, 1000, 300}, {4000, 1000, 300}, {4000, 500, 1000}, {3000, 700, 1000}};
    for (const auto &rates : cases)
    {
        SCOPED_TRACE(std::to_string(rates.servo) + " Hz and " + std::to_string(rates.physics) + " Hz");
        clock_.advance(1);
        const dBodyID body = world_.add_moving_box({0.1, 0.1, 0.1}, {0, 0.01, -0.05}, 20);
        const auto path = [](double seconds) -> Vector3 {
            const double t = std::max(0.0, seconds - 1);
            return {0.02 * std::sin(3 * t), 0, 0.03 - 0.035 * std::pow(std::sin(8 * t), 2)};
        };
        EXPECT_LE(lost_momentum(body, path, with_stiffness(rates.stiffness), settings(rates.servo, rates.physics, 3)),
                  1e-9);
        dGeomDestroy(dBodyGetFirstGeom(body));
        dBodyDestroy(body);
    }
}

// Once, impulses came a tick late and were made up for by pulses: steps of 1.25 ms got 0.5 to 1.6 times the force.
TEST_F(DecoupledLoopTest, ASteadyForceReachesABodyEvenly)
{
    for (const double physics : {300.0, 600.0, 800.0, 1000.0})
    {
        SCOPED_TRACE(std::to_string(physics) + " Hz");
        ProbeWorld world;
        const dBodyID body = world.add_moving_box({0.1, 0.1, 0.1}, {0, 0, -0.05}, 1000);
        ScriptedDevice device([](double seconds) -> Vector3 {
            return {0, 0, 0.03 - 0.025 * std::clamp(seconds - 0.5, 0.0, 1.0)};
        });
        HapticProbe probe(device, world.space, radius, with_stiffness(300));
        HapticLoop loop(probe, settings(1000, physics, 2));
        int steps = 0;
        loop.run({[&] { world.collide(probe); },
                  [&](double dt) {
                      const double force = -dBodyGetForce(body)[2], meant = loop.latest().force.z();
                      if (loop.latest().time > 1.6)
                      {
                          ++steps;
                          EXPECT_GT(meant, 1);
                          EXPECT_GE(force, 0.9 * meant);
                          EXPECT_LE(force, 1.15 * meant);
                      }
                      world.step(dt);
                  }});
        EXPECT_GT(steps, 100);
    }
}

/// Each 17th tick takes 0.6 ms, so that the servo misses deadlines.
class SlowLaw : public ForceLaw
{
public:
    explicit SlowLaw(SimulatedClock &clock) : clock_(clock) {}

    void forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces) override
    {
        law_.forces(tool, touches, dt, forces);
        if (++ticks_ % 17 == 0)
            clock_.advance(0.0006);
    }

    void reset() override { law_.reset(); }
    Material material() const override { return law_.material(); }

private:
    SimulatedClock &clock_;
    PenaltyLaw law_;
    int ticks_ = 0;
};

TEST_F(DecoupledLoopTest, MomentumIsKeptWhenTheServoMissesDeadlines)
{
    const auto path = [](double seconds) -> Vector3 {
        return {0, 0, 0.03 - 0.035 * std::pow(std::sin(8 * std::max(0.0, seconds - 1)), 2)};
    };
    const RenderSettings rendering = with_law(std::make_shared<SlowLaw>(clock_));
    EXPECT_LE(lost_momentum(add_box(20), path, rendering, settings(4000, 1000, 3)), 1e-9);
    EXPECT_GT(report_.overruns, 100U);
}

Vector3 press_slowly(double seconds)
{
    return {0, 0, 0.03 - 0.025 * std::clamp(2 * (seconds - 1), 0.0, 1.0)};
}

TEST_F(DecoupledLoopTest, MomentumIsKeptWhenItEndsInContact)
{
    EXPECT_LE(lost_momentum(add_box(1000), &press_slowly, with_stiffness(500), settings(4000, 1000, 2)), 1e-9);
}

TEST_F(DecoupledLoopTest, MomentumIsKeptThroughAStallOfTheScene)
{
    Once stall(clock_, 2, [&] { clock_.advance(0.1); });
    EXPECT_LE(lost_momentum(add_box(100), &press_slowly, with_stiffness(300), settings(4000, 1000, 3), std::ref(stall)),
              1e-9);
    EXPECT_GE(notices_.count(NoticeKind::watchdog), 1);
}

TEST_F(DecoupledLoopTest, MomentumIsKeptWhenTheGuardTakesTheForceFromALawThatHangs)
{
    Once hang(clock_, 1.9, [&] { clock_.advance(0.1); });
    const RenderSettings rendering = with_law(std::make_shared<TroubledLaw>(std::ref(hang)));
    EXPECT_LE(lost_momentum(add_box(100), &press_slowly, rendering, settings(4000, 1000, 3)), 1e-9);
    EXPECT_EQ(notices_.count(NoticeKind::guard), 1);
}

TEST_F(DecoupledLoopTest, MomentumIsKeptWhenAStopEndsIt)
{
    Once stop(clock_, 2.2, [] { StopRequest::request(); });
    const auto stopper = clock_.start({0.0073, {}, std::ref(stop)}); // the servo notices it before the guard
    EXPECT_LE(lost_momentum(add_box(100), &press_slowly, with_stiffness(300), settings(4000, 1000, 3)), 1e-9);
    EXPECT_EQ(notices_.count(NoticeKind::stop), 1);
}

// The force was written just before the recorder hung; its division among objects is approximate for these 5 ms.
TEST_F(DecoupledLoopTest, LittleIsLostWhenTheGuardTakesTheForceFromARecorderThatHangs)
{
    Once hang(clock_, 1.9, [&] { clock_.advance(0.1); });
    recorder_ = [&](const RenderedTick &) { hang(); };
    EXPECT_LE(lost_momentum(add_box(100), &press_slowly, with_stiffness(spring), settings(4000, 1000, 3)), 1e-3);
    EXPECT_EQ(notices_.count(NoticeKind::guard), 1);
}

TEST_F(DecoupledLoopTest, TheServoFeelsAPlaneExactlyWhileTheSceneIsSlow)
{
    dCreatePlane(world_.space, 0, 0, 1, 0);
    ScriptedDevice device([](double seconds) -> Vector3 {
        return {0, 0, seconds < 1 ? 0.02 : 0.008 + 0.002 * std::cos(40 * (seconds - 1))};
    });
    HapticProbe probe(device, world_.space, radius, with_stiffness(500));
    int compared = 0;
    probe.set_recorder([&](const RenderedTick &tick) {
        if (tick.time > 1.1 && tick.allowance == 1)
        {
            const double depth = std::max(0.0, radius - tick.state.position.z());
            ASSERT_NEAR(tick.requested.z(), 500 * depth, 1e-9) << tick.time;
            ++compared;
        }
    });
    HapticLoop loop(probe, settings(4000, 100, 2));
    const LoopReport report = loop.run(world_.work(probe));
    EXPECT_GT(compared, 3000);
    EXPECT_NEAR(static_cast<double>(report.ticks), 8000, 42) << "less the last step";
    EXPECT_NEAR(static_cast<double>(report.steps), 200, 1);
}

TEST_F(DecoupledLoopTest, ABodyMayBeDestroyedWhileItIsPushed)
{
    const dBodyID body = add_box(100);
    ScriptedDevice device([](double seconds) -> Vector3 {
        return {0, 0, std::clamp(0.03 - (seconds - 1), 0.007, 0.03)}; // no jump: it would give no force
    });
    HapticProbe probe(device, world_.space, radius, with_stiffness(500));
    HapticLoop loop(probe, settings(4000, 1000, 2));
    double force_before = 0;
    Once end(clock_, 1.5, [&] {
        force_before = loop.latest().force.z();
        dGeomDestroy(dBodyGetFirstGeom(body));
        dBodyDestroy(body);
    });
    loop.run(world_.work(probe, std::ref(end)));
    EXPECT_GT(force_before, 0.1);
    EXPECT_TRUE(probe.last_tick().force.isZero(0));
}

TEST_F(DecoupledLoopTest, TheMarginIsThereOnlyAsLongAsItRuns)
{
    ScriptedDevice device([](double) -> Vector3 { return {0, 0, 1}; });
    HapticProbe probe(device, world_.space, radius);
    LoopSettings settings = this->settings(1000, 1000, 0.1);
    settings.margin = 0.03;
    HapticLoop loop(probe, settings);
    double during = 0;
    loop.run({[&] { during = dGeomSphereGetRadius(probe.geom()); }, [](double) {}});
    EXPECT_DOUBLE_EQ(during, radius + 0.03);
    EXPECT_DOUBLE_EQ(dGeomSphereGetRadius(probe.geom()), radius);
}

TEST_F(DecoupledLoopTest, WhatCannotBeIsRefused)
{
    ScriptedDevice device([](double) -> Vector3 { return Vector3::Zero(); });
    {
        HapticProbe probe(device, world_.add_body(Vector3::Zero(), 1), CouplingProperties());
        EXPECT_THROW(HapticLoop(probe, settings(1000, 1000, 1)), std::invalid_argument) << "a tool body";
    }
    HapticProbe probe(device, world_.space, radius);
    EXPECT_THROW(HapticLoop(probe, settings(1000, 2000, 1)), std::invalid_argument) << "faster than the servo";
    EXPECT_THROW(HapticLoop(probe, settings(0, 0, 1)), std::invalid_argument);
    LoopSettings wrong = settings(1000, 1000, 1);
    wrong.most_steps_behind = -1;
    EXPECT_THROW(HapticLoop(probe, wrong), std::invalid_argument);
    wrong.most_steps_behind = 0;
    wrong.margin = nan;
    EXPECT_THROW(HapticLoop(probe, wrong), std::invalid_argument);
    HapticLoop loop(probe, settings(1000, 1000, 0.01));
    const SceneWork nothing = {[] {}, [](double) {}};
    loop.run(nothing);
    EXPECT_THROW(loop.run(nothing), std::logic_error) << "twice";
}
} // namespace
} // namespace ode_predictive_space::haptics
