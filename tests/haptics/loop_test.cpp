#include "ode_predictive_space/haptics/loop.h"

#include "ode_predictive_space/haptics/penalty_law.h"
#include "ode_predictive_space/haptics/stop_request.h"
#include "tests/haptics/faulty_device.h"
#include "tests/haptics/probe_world.h"
#include "tests/haptics/scripted_device.h"

#include <cmath>
#include <csignal>
#include <gtest/gtest.h>
#include <memory>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double radius = 0.01;       // m; of the probe
constexpr double spring = 800;        // N/m
constexpr double depth = 0.004;       // m; how deep it goes into the plane
constexpr double grace = 0.010;       // s; after that there must be no force
constexpr double pressed_after = 1.8; // s; from then on the force is there in full

RenderSettings usual_rendering()
{
    SurfaceProperties properties;
    properties.stiffness = spring;
    RenderSettings settings;
    settings.law = std::make_shared<PenaltyLaw>(properties);
    return settings;
}

/// Rests for a second while the forces ramp in, then goes down into the plane z = 0.
Vector3 press_down(double seconds)
{
    const double u = std::clamp((seconds - 1) / 0.5, 0.0, 1.0);
    return {0, 0, 0.05 + u * u * u * (10 + u * (-15 + 6 * u)) * (radius - depth - 0.05)};
}

/// A loop in simulated time over a plane, with a hand that presses on it. Of the two kinds.
class HapticLoopTest : public testing::TestWithParam<bool>
{
protected:
    HapticLoopTest() : scripted_(&press_down), device_(scripted_), log_(device_, clock_)
    {
        dCreatePlane(world_.space, 0, 0, 1, 0);
    }

    LoopSettings settings()
    {
        LoopSettings settings;
        settings.decoupled = GetParam();
        settings.clock = &clock_;
        settings.duration = 3;
        settings.ask_for_priority = false;
        settings.notice = notices_.sink();
        return settings;
    }

    void make(RenderSettings rendering = usual_rendering())
    {
        probe_ = std::make_unique<HapticProbe>(log_, world_.space, radius, std::move(rendering));
        loop_ = std::make_unique<HapticLoop>(*probe_, settings());
    }

    /// Collides and steps; `also` is called in each step, with the clock's time.
    SceneWork work(std::function<void(double)> also = {})
    {
        return {[this] { world_.collide(*probe_); },
                [this, also](double dt) {
                    world_.step(dt);
                    if (also)
                    {
                        also(clock_.now());
                    }
                }};
    }

    /// The fault came at this time, when the force was there: it was gone soon after, and never came back until then.
    void expect_zero_force_after(double fault, double until)
    {
        EXPECT_NEAR(log_.force_at(fault - 0.001).z(), spring * depth, 1e-9) << "it was there before";
        EXPECT_TRUE(log_.was_quiet(fault + grace, until)) << log_.force_at(fault + grace).transpose();
    }

    const OdeUse ode_;
    SimulatedClock clock_;
    ProbeWorld world_;
    NoticeList notices_;
    ScriptedDevice scripted_;
    FaultyDevice device_;
    WriteLog log_;
    std::unique_ptr<HapticProbe> probe_;
    std::unique_ptr<HapticLoop> loop_;
};

INSTANTIATE_TEST_SUITE_P(Kinds, HapticLoopTest, testing::Bool(),
                         [](const auto &info) { return info.param ? "Decoupled" : "SingleThreaded"; });

TEST_P(HapticLoopTest, RendersAtItsRateForItsDuration)
{
    make();
    const LoopReport report = loop_->run(work());
    EXPECT_NEAR(static_cast<double>(report.ticks), 3000, 1);
    EXPECT_NEAR(static_cast<double>(report.steps), 3000, 1);
    EXPECT_NEAR(report.rate, 1000, 1);
    EXPECT_NEAR(report.real_time_factor, 1, 1e-3);
    EXPECT_NEAR(report.period.p50, 0.001, 2e-5);
    EXPECT_NEAR(report.period.max, 0.001, 1e-9);
    EXPECT_EQ(report.overruns, 0U);
    EXPECT_EQ(report.dropped_steps, 0U);
    EXPECT_EQ(report.notices, 0U);
    EXPECT_NEAR(log_.force_at(2.9).z(), spring * depth, 1e-9);
    EXPECT_TRUE(log_.writes().back().wrench.force.isZero(0)) << "at the end";
}

TEST_P(HapticLoopTest, TheSameRunTwiceIsTheSame)
{
    std::vector<Vector3> forces[2];
    for (auto &run : forces)
    {
        SimulatedClock clock;
        ProbeWorld world;
        world.add_moving_box({0.2, 0.2, 0.1}, {0.03, 0, -0.05}, 2);
        ScriptedDevice device(&press_down);
        HapticProbe probe(device, world.space, radius, usual_rendering());
        probe.set_recorder([&](const RenderedTick &tick) { run.push_back(tick.wrench.force); });
        LoopSettings settings = this->settings();
        settings.clock = &clock;
        HapticLoop loop(probe, settings);
        loop.run({[&] { world.collide(probe); }, [&](double dt) { world.step(dt); }});
    }
    EXPECT_GT(forces[0].size(), 2900U);
    EXPECT_TRUE(forces[0] == forces[1]);
}

// --- Ends -----------------------------------------------------------------------------------------------------------------

TEST_P(HapticLoopTest, EndsWhenItIsToldTo)
{
    make();
    loop_->run(work([this](double time) {
        if (time >= pressed_after)
        {
            loop_->stop();
        }
    }));
    EXPECT_NEAR(clock_.now(), pressed_after, 0.002);
    expect_zero_force_after(pressed_after, clock_.now() + 1);
    EXPECT_EQ(notices_.count(NoticeKind::stop), 1);
}

TEST_P(HapticLoopTest, ASignalEndsItWithZeroForceAndANotice)
{
    const StopRequest request;
    make();
    loop_->run(work([](double time) {
        if (time >= pressed_after && !StopRequest::requested())
        {
            std::raise(SIGINT);
        }
    }));
    EXPECT_NEAR(clock_.now(), pressed_after, 0.002);
    expect_zero_force_after(pressed_after, clock_.now() + 1);
    EXPECT_EQ(notices_.count(NoticeKind::stop), 1);
}

TEST_P(HapticLoopTest, AnExceptionOfTheProgramComesOutAfterZeroForceAndANotice)
{
    for (const bool in_collide : {true, false})
    {
        notices_ = NoticeList();
        make();
        const double begin = clock_.now();
        double thrown_at = 0;
        const auto fail = [&] {
            if (clock_.now() - begin >= pressed_after)
            {
                thrown_at = clock_.now();
                throw std::runtime_error("the program has a bug");
            }
        };
        const SceneWork ordinary = work();
        EXPECT_THROW(loop_->run({[&] {
                                     ordinary.collide();
                                     if (in_collide)
                                     {
                                         fail();
                                     }
                                 },
                                 [&](double dt) {
                                     ordinary.advance(dt);
                                     if (!in_collide)
                                     {
                                         fail();
                                     }
                                 }}),
                     std::runtime_error);
        expect_zero_force_after(thrown_at, clock_.now() + 1);
        EXPECT_NE(notices_.text(NoticeKind::exception).find("the program has a bug"), std::string::npos);
        loop_.reset();
        probe_.reset();
    }
}

/// A law that does something besides.
class TroubledLaw : public ForceLaw
{
public:
    explicit TroubledLaw(std::function<void()> trouble) : trouble_(std::move(trouble)) {}

    void forces(const ToolState &tool, const std::vector<Touch> &touches, double dt, TouchForces &forces) override
    {
        law_.forces(tool, touches, dt, forces);
        trouble_();
    }

    void reset() override { law_.reset(); }
    double stiffness() const override { return law_.stiffness(); }
    double damping() const override { return law_.damping(); }
    void set_stiffness(double value) override { law_.set_stiffness(value); }

private:
    PenaltyLaw law_{SurfaceProperties{spring, 0, 0}};
    std::function<void()> trouble_;
};

TEST_P(HapticLoopTest, AnExceptionOfTheLawComesOutAfterZeroForceAndANotice)
{
    double thrown_at = 0;
    RenderSettings rendering;
    rendering.law = std::make_shared<TroubledLaw>([&] {
        if (clock_.now() >= pressed_after)
        {
            thrown_at = clock_.now();
            throw std::runtime_error("the law has a bug");
        }
    });
    make(std::move(rendering));
    EXPECT_THROW(loop_->run(work()), std::runtime_error);
    expect_zero_force_after(thrown_at, clock_.now() + 1);
    EXPECT_NE(notices_.text(NoticeKind::exception).find("the law has a bug"), std::string::npos);
}

// --- Faults ---------------------------------------------------------------------------------------------------------------

TEST_P(HapticLoopTest, AStalledStepEndsWithZeroForceAndANoticeWhileItLasts)
{
    make();
    double stalled_at = 0;
    int notices_during_stall = 0;
    loop_->run(work([&](double time) {
        if (time >= pressed_after && stalled_at == 0)
        {
            stalled_at = time;
            clock_.advance(0.5);
            notices_during_stall = notices_.count(NoticeKind::guard) + notices_.count(NoticeKind::watchdog);
        }
    }));
    expect_zero_force_after(stalled_at, stalled_at + 0.5);
    EXPECT_GE(notices_during_stall, 1);
}

TEST_P(HapticLoopTest, AStalledCollisionEndsWithZeroForceAndItsStaleForceIsNotRendered)
{
    make();
    double stalled_at = 0;
    const SceneWork ordinary = work();
    loop_->run({[&] {
                    ordinary.collide();
                    if (clock_.now() >= pressed_after && stalled_at == 0)
                    {
                        stalled_at = clock_.now();
                        clock_.advance(0.5);
                    }
                },
                ordinary.advance});
    expect_zero_force_after(stalled_at, stalled_at + 0.5);
    EXPECT_GE(notices_.count(NoticeKind::guard) + notices_.count(NoticeKind::watchdog), 1);
}

TEST_P(HapticLoopTest, ALawThatHangsEndsWithZeroForceAndANotice)
{
    double stalled_at = 0;
    RenderSettings rendering;
    rendering.law = std::make_shared<TroubledLaw>([&] {
        if (clock_.now() >= pressed_after && stalled_at == 0)
        {
            stalled_at = clock_.now();
            clock_.advance(0.5);
        }
    });
    make(std::move(rendering));
    loop_->run(work());
    expect_zero_force_after(stalled_at, stalled_at + 0.501);
    EXPECT_EQ(notices_.count(NoticeKind::guard), 1);
}

TEST_P(HapticLoopTest, EveryWayForADeviceToBreakEndsWithZeroForceAndANotice)
{
    for (const Breakage breakage : {Breakage::lost, Breakage::unreadable, Breakage::unwritable, Breakage::not_a_number,
                                    Breakage::endless_velocity, Breakage::stalled})
    {
        notices_ = NoticeList();
        device_.break_now(Breakage::none);
        make();
        const double begin = clock_.now();
        double broken_at = 0;
        loop_->run(work([&](double time) {
            if (time >= begin + pressed_after && broken_at == 0)
            {
                broken_at = time;
                device_.break_now(breakage);
            }
        }));
        SCOPED_TRACE(static_cast<int>(breakage));
        expect_zero_force_after(broken_at, begin + 3);
        EXPECT_EQ(notices_.count(NoticeKind::device), 1);
        EXPECT_NEAR(clock_.now(), begin + 3, 0.002) << "the program goes on";
        loop_.reset();
        probe_.reset();
    }
}

TEST_P(HapticLoopTest, AContactThatIsNotANumberEndsWithZeroForceAndANotice)
{
    make();
    dGeomID broken = nullptr;
    double broken_at = 0;
    loop_->run(work([&](double time) {
        if (time >= pressed_after && broken == nullptr)
        {
            broken = add_broken_geom(world_.space);
            broken_at = time;
        }
    }));
    expect_zero_force_after(broken_at, 3);
    EXPECT_GE(notices_.count(NoticeKind::contact), 1);
    dGeomDestroy(broken);
}

TEST_P(HapticLoopTest, ADriverThatHangsIsToldOf)
{
    make();
    bool stalled = false;
    scripted_.before_read = [&] {
        if (clock_.now() >= pressed_after && !stalled)
        {
            stalled = true;
            clock_.advance(0.5);
        }
    };
    loop_->run(work());
    EXPECT_TRUE(stalled);
    EXPECT_NE(notices_.text(NoticeKind::guard).find("driver"), std::string::npos);
    EXPECT_TRUE(log_.was_quiet(pressed_after + 0.51, pressed_after + 0.51 + grace))
        << "and the force does not come at once";
}

// --- Punctuality ----------------------------------------------------------------------------------------------------------

TEST_P(HapticLoopTest, ALittleDelayIsMadeUpFor)
{
    make();
    bool late = false;
    const LoopReport report = loop_->run(work([&](double time) {
        if (time >= 1 && !late)
        {
            late = true;
            clock_.advance(0.0032);
        }
    }));
    EXPECT_EQ(report.dropped_steps, 0U);
    EXPECT_NEAR(static_cast<double>(report.steps), 3000, 1);
    EXPECT_NEAR(clock_.now(), 3, 0.002);
    EXPECT_NEAR(report.real_time_factor, 1, 1e-3);
}

TEST_P(HapticLoopTest, ALongDelayIsNot)
{
    make();
    bool late = false;
    const LoopReport report = loop_->run(work([&](double time) {
        if (time >= 1 && !late)
        {
            late = true;
            clock_.advance(1);
        }
    }));
    EXPECT_GT(report.dropped_steps, 990U);
    EXPECT_NEAR(static_cast<double>(report.steps), 3000, 1);
    EXPECT_NEAR(clock_.now(), 4, 0.01);
    EXPECT_NEAR(report.real_time_factor, 0.75, 0.01);
}

TEST_P(HapticLoopTest, ASceneThatIsTooSlowIsToldOf)
{
    make();
    const LoopReport report = loop_->run(work([&](double) { clock_.advance(0.02); }));
    EXPECT_LT(report.real_time_factor, 0.1);
    EXPECT_GE(notices_.count(NoticeKind::watchdog) + notices_.count(NoticeKind::guard), 1);
    for (const LoggedWrite &write : log_.writes())
    {
        ASSERT_LT(write.wrench.force.norm(), 0.1) << "it begins to come back with each step, and goes again";
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
