#include "ode_predictive_space/haptics/loop.h"

#include "ode_predictive_space/haptics/safety.h"
#include "tests/haptics/loop/loop_fixture.h"
#include "tests/haptics/support/mesh_maker.h"
#include "tests/haptics/support/signal_disposition.h"

#include <csignal>
#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
INSTANTIATE_TEST_SUITE_P(Kinds, HapticLoopTest, testing::Bool(), name_of_loop);

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
    clock_.advance(1);
    EXPECT_EQ(loop_->report().rate, report.rate) << "of the run alone";
}

TEST_P(HapticLoopTest, OneThatIsStoppedBeforeItRunsDoesNothing)
{
    make();
    loop_->stop();
    const LoopReport report = loop_->run({[] { ADD_FAILURE(); }, [](double) { ADD_FAILURE(); }});
    EXPECT_EQ(report.ticks, 0U);
    EXPECT_EQ(report.rate, 0);
    EXPECT_EQ(report.compute.mean, 0);
    EXPECT_EQ(notices_.count(NoticeKind::stop), 1);
}

// A space that tests shapes would read a mesh in parts while the probe runs, and report its pairs meanwhile.
TEST_P(HapticLoopTest, NoTickWaitsForTheMeshesOfTheSpace)
{
    dPredictiveSpaceSetProximity(world_.space, dPredictiveProximityShape);
    const OdeMesh mesh(sheet_mesh(1, 96));
    const dGeomID sheet = mesh.add_to(world_.space);
    dGeomSetPosition(sheet, 5, 0, 2);
    dMatrix3 slanting;
    dRFromAxisAndAngle(slanting, 0, 1, 0, std::acos(-1.0) / 4);
    dGeomSetRotation(sheet, slanting);
    dGeomSetPosition(dCreateSphere(world_.space, 0.1), 5.2, 0, 2.2); // within its box
    make();
    int pairs = 0; // of the mesh
    SceneWork work = this->work();
    work.collide = [&] {
        dSpaceCollide(world_.space, &pairs, [](void *count, dGeomID one, dGeomID other) {
            for (const dGeomID geom : {one, other})
                *static_cast<int *>(count) += dGeomGetClass(geom) == dTriMeshClass;
        });
    };
    loop_->run(work);
    EXPECT_EQ(pairs, 0);
}

TEST_P(HapticLoopTest, AnotherRunGoesOnInTheTimeOfTheDevice)
{
    const dGeomID broken = add_broken_geom(world_.space); // reported once a second
    NoticeList later;
    RenderSettings rendering = usual_rendering();
    rendering.notice = later.sink();
    make(std::move(rendering));
    double last = -1;
    probe_->set_recorder([&](const RenderedTick &tick) {
        ASSERT_GE(tick.time, last);
        last = tick.time;
    });
    loop_->run(work());
    EXPECT_NEAR(last, 3, 0.002);
    const int told = notices_.count(NoticeKind::contact);
    loop_ = std::make_unique<HapticLoop>(*probe_, settings());
    const LoopReport report = loop_->run(work());
    EXPECT_NEAR(last, 6, 0.003);
    EXPECT_GE(notices_.count(NoticeKind::contact), 2 * told - 1);
    EXPECT_NEAR(report.real_time_factor, 1, 1e-3);
    dGeomDestroy(broken);
    EXPECT_TRUE(later.all().empty());
    device_.break_now(Breakage::lost);
    probe_->begin(7);
    EXPECT_EQ(later.count(NoticeKind::device), 1) << "it is told where the program had it told before";
}

TEST_P(HapticLoopTest, ASignalEndsItWithZeroForceAndANotice)
{
    const SignalDisposition ending(SIGTERM);
    const StopRequest request;
    make();
    loop_->run(work(Once(clock_, pressed_after, [] { std::raise(SIGTERM); })));
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
                                         fail();
                                 },
                                 [&](double dt) {
                                     ordinary.advance(dt);
                                     if (!in_collide)
                                         fail();
                                 }}),
                     std::runtime_error);
        expect_zero_force_after(thrown_at, clock_.now() + 1);
        EXPECT_NE(notices_.text(NoticeKind::exception).find("the program has a bug"), std::string::npos);
        loop_.reset();
        probe_.reset();
    }
}

TEST_P(HapticLoopTest, AnExceptionOfTheLawComesOutAfterZeroForceAndANotice)
{
    double thrown_at = 0;
    make(with_law(std::make_shared<TroubledLaw>([&] {
        if (clock_.now() >= pressed_after)
        {
            thrown_at = clock_.now();
            throw std::runtime_error("the law has a bug");
        }
    })));
    EXPECT_THROW(loop_->run(work()), std::runtime_error);
    expect_zero_force_after(thrown_at, clock_.now() + 1);
    EXPECT_NE(notices_.text(NoticeKind::exception).find("the law has a bug"), std::string::npos);
}

TEST_P(HapticLoopTest, ALawThatCannotBeResetDoesNotKeepTheForce)
{
    const auto law = std::make_shared<TroubledLaw>([] {});
    make(with_law(law));
    loop_->run(work(Once(clock_, pressed_after, [&] {
        law->at_reset = [] { throw std::runtime_error("the law has a bug"); };
        loop_->stop();
    })));
    expect_zero_force_after(pressed_after, clock_.now() + 1);
    EXPECT_EQ(notices_.count(NoticeKind::stop), 1);
}

TEST_P(HapticLoopTest, AStopTakesTheForceWhileTheLoopWaitsForItsNextTick)
{
    LoopSettings slow = settings();
    slow.rate = 100;
    if (GetParam())
        slow.physics_rate = 100;
    make(usual_rendering(), slow);
    Once stop(clock_, 2.5, [&] { loop_->stop(); });
    const auto stopper = clock_.start({0.0025, {}, std::ref(stop)});
    loop_->run(work());
    EXPECT_GT(log_.force_at(stop.at - 0.001).z(), 0.1);
    EXPECT_TRUE(log_.was_quiet(stop.at + 0.0015, clock_.now() + 1));
    EXPECT_EQ(notices_.count(NoticeKind::stop), 1);
}

TEST_P(HapticLoopTest, ADriverThatHangsInTheLastTickLeavesNoForce)
{
    make();
    Once stall(clock_, 2.9985, [&] { clock_.advance(0.0072); }); // the guard finds the device busy
    scripted_.before_read = std::ref(stall);
    loop_->run(work());
    EXPECT_GT(stall.at, 0);
    EXPECT_GT(log_.force_at(2.99).z(), 1);
    EXPECT_TRUE(log_.was_quiet(clock_.now(), clock_.now() + 1));
}

TEST_P(HapticLoopTest, ALittleDelayIsMadeUpFor)
{
    make();
    Once delay(clock_, 1, [&] { clock_.advance(0.0052); }); // four steps are behind, the most that are made up for
    const LoopReport report = loop_->run(work(std::ref(delay)));
    EXPECT_EQ(report.dropped_steps, 0U);
    EXPECT_EQ(report.overruns, GetParam() ? 0U : 5U);
    EXPECT_NEAR(report.step_compute.max, 0.0052, 1e-9);
    EXPECT_NEAR(report.compute.max, GetParam() ? 0 : 0.0052, 1e-8);
    EXPECT_NEAR(static_cast<double>(report.steps), 3000, 1);
    EXPECT_NEAR(clock_.now(), 3, 0.002);
    EXPECT_NEAR(report.real_time_factor, 1, 1e-3);
}

TEST_P(HapticLoopTest, ALongDelayIsNot)
{
    make();
    Once delay(clock_, 1, [&] { clock_.advance(1); });
    const LoopReport report = loop_->run(work(std::ref(delay)));
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
        ASSERT_LT(write.wrench.force.norm(), 0.1) << "it begins to come back with each step, and goes again";
}
} // namespace
} // namespace ode_predictive_space::haptics
