// Destruction during a loop, two loops on one probe, and exceptions that pass through ODE's spaces.

#include "ode_predictive_space/haptics/touch_sensor.h"
#include "tests/haptics/loop/loop_fixture.h"
#include "tests/support/eventually.h"

#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>

namespace ode_predictive_space::haptics
{
namespace
{
using LoopLifeTest = HapticLoopTest;

INSTANTIATE_TEST_SUITE_P(Kinds, LoopLifeTest, testing::Bool(), name_of_loop);

TEST_P(LoopLifeTest, ASecondLoopOnAProbeIsRefusedWhileTheFirstRuns)
{
    make();
    HapticLoop made_before(*probe_, settings());
    int refused = 0;
    loop_->run(work([&](double) {
        if (refused > 0 || clock_.now() < pressed_after)
            return;
        EXPECT_THROW(HapticLoop(*probe_, settings()), std::logic_error);
        EXPECT_THROW(made_before.run(work()), std::logic_error);
        ++refused;
    }));
    EXPECT_EQ(refused, 1);
    EXPECT_NEAR(log_.force_at(2.5).z(), spring * depth, 1e-9) << "the first goes on";
    EXPECT_NO_THROW(HapticLoop(*probe_, settings())) << "when it has ended";
}

/// On the machine's clock, another thread destroys the loop or its probe. The loop's duration is unlimited.
class LoopLifeThreadsTest : public testing::TestWithParam<bool>
{
protected:
    LoopLifeThreadsTest() : device_([](double) -> Vector3 { return {0, 0, 0.5}; })
    {
        probe_ = std::make_unique<HapticProbe>(device_, world_.space, radius, RenderSettings());
        LoopSettings settings;
        settings.decoupled = GetParam();
        settings.ask_for_priority = false;
        loop_ = std::make_unique<HapticLoop>(*probe_, settings);
    }

    bool ended_by(const std::function<void()> &destroy)
    {
        HapticLoop &loop = *loop_;
        HapticProbe &probe = *probe_;
        std::atomic<int> steps{0};
        std::thread runner([&] { loop.run(world_.work(probe, [&](double) { ++steps; })); });
        EXPECT_TRUE(eventually([&] { return steps >= 10; }));
        destroy();
        const int last = steps;
        runner.join();
        return steps == last;
    }

    const OdeUse ode_;
    ProbeWorld world_;
    ScriptedDevice device_;
    std::unique_ptr<HapticProbe> probe_;
    std::unique_ptr<HapticLoop> loop_;
};

INSTANTIATE_TEST_SUITE_P(Kinds, LoopLifeThreadsTest, testing::Bool(), name_of_loop);

TEST_P(LoopLifeThreadsTest, ALoopThatIsDestroyedEndsFirst)
{
    EXPECT_TRUE(ended_by([&] { loop_.reset(); }));
    EXPECT_TRUE(device_.last_wrench().force.isZero(0));
}

TEST_P(LoopLifeThreadsTest, AProbeThatIsDestroyedEndsItsLoopFirst)
{
    EXPECT_TRUE(ended_by([&] { probe_.reset(); }));
    EXPECT_TRUE(device_.last_wrench().force.isZero(0));
}

using LoopLifeDeathTest = HapticLoopTest;

INSTANTIATE_TEST_SUITE_P(Kinds, LoopLifeDeathTest, testing::Bool(), name_of_loop);

TEST_P(LoopLifeDeathTest, WhatIsDestroyedInItsOwnLoopEndsWithAMessage)
{
    make();
    EXPECT_DEATH(loop_->run(work([&](double) { probe_.reset(); })),
                 "haptic probe was destroyed while its loop was running");
    EXPECT_DEATH(loop_->run(work([&](double) { loop_.reset(); })),
                 "haptic loop was destroyed while its loop was running");
}

/// Covers ODE's spaces and the predictive one. The second parameter: whether the program calls safe_collide().
class ThrowingCallbackTest : public testing::TestWithParam<std::tuple<bool, bool>>
{
protected:
    static void throw_near(void *, dGeomID, dGeomID) { throw std::runtime_error("near callback"); }

    // ODE's own spaces stay locked and can never be destroyed. The list keeps them reachable for leak checks.
    static std::vector<dSpaceID> &locked_spaces()
    {
        static auto *const spaces = new std::vector<dSpaceID>;
        return *spaces;
    }

    const OdeUse ode_;
    SimulatedClock clock_;
};

TEST_P(ThrowingCallbackTest, ComesOutOfTheLoopAndTheProbeCanGo)
{
    const auto [decoupled, safe] = GetParam();
    for (const SpaceChoice choice : all_space_choices)
    {
        SCOPED_TRACE(static_cast<int>(choice));
        const dSpaceID space = make_space(choice);
        const dGeomID plane = dCreatePlane(space, 0, 0, 1, 0);
        ScriptedDevice device([](double) -> Vector3 { return {0, 0, 0.005}; });
        {
            HapticProbe probe(device, space, radius, RenderSettings());
            HapticLoop loop(probe, simulated(clock_, infinity, decoupled));
            const bool carried = safe;
            EXPECT_THROW(loop.run({[&] {
                                       carried ? safe_collide(space, nullptr, &throw_near)
                                               : dSpaceCollide(space, nullptr, &throw_near);
                                   },
                                   [](double) {}}),
                         std::runtime_error);
            EXPECT_TRUE(device.last_wrench().force.isZero(0));
        }
        if (safe || dSpaceIsPredictive(space) != 0)
        {
            EXPECT_EQ(dSpaceGetNumGeoms(space), 1);
            dGeomDestroy(plane);
            dSpaceDestroy(space);
        }
        else
        {
            locked_spaces().push_back(space);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Loops, ThrowingCallbackTest, testing::Combine(testing::Bool(), testing::Bool()),
                         [](const auto &info) {
                             return std::string(std::get<0>(info.param) ? "Decoupled" : "SingleThreaded") +
                                    (std::get<1>(info.param) ? "Carried" : "Thrown");
                         });
} // namespace
} // namespace ode_predictive_space::haptics
