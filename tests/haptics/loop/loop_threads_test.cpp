// The loop and its threads on the machine's clock: for ThreadSanitizer, and for behaviour that a simulated clock cannot show.

#include "ode_predictive_space/haptics/loop.h"

#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/probe_world.h"
#include "tests/haptics/support/ridges.h"
#include "tests/haptics/support/scripted_device.h"
#include "tests/support/eventually.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <mutex>
#include <thread>

namespace ode_predictive_space::haptics
{
namespace
{
/// Any thread may read its force.
class WatchedDevice : public ScriptedDevice
{
public:
    using ScriptedDevice::ScriptedDevice;

    void close() noexcept override
    {
        ScriptedDevice::close();
        force = 0;
    }

    void write(const Wrench &wrench) override
    {
        ScriptedDevice::write(wrench);
        force = wrench.force.z();
    }

    std::atomic<double> force{0}; ///< N
};

/// s, simulated; the end of a loop whose condition never holds. On a busy machine the probe touches repeatedly until then.
constexpr double long_enough = 60;

RenderSettings without_ramp()
{
    SafetyLimits limits = SafetyLimits::of(desktop_capabilities());
    limits.ramp_time = 0;
    RenderSettings settings;
    settings.safety = limits;
    return settings;
}

class LoopThreadsTest : public testing::Test
{
protected:
    // The hand presses once a second, because a force that a busy machine drops returns only with the next press.
    LoopThreadsTest()
        : device_([](double seconds) -> Vector3 {
              const double phase = std::fmod(seconds, 1);
              return {0, 0, 0.012 - 0.008 * std::clamp(10 * std::min(phase, 0.9 - phase), 0.0, 1.0)};
          })
    {}

    LoopSettings settings(bool decoupled)
    {
        LoopSettings settings;
        settings.decoupled = decoupled;
        settings.rate = decoupled ? 2000 : 1000;
        settings.duration = long_enough;
        settings.notice = [this](const Notice &notice) {
            const std::lock_guard<std::mutex> lock(mutex_);
            notices_.sink()(notice);
        };
        return settings;
    }

    int count(NoticeKind kind)
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        return notices_.count(kind);
    }

    const OdeUse ode_;
    ProbeWorld world_;
    WatchedDevice device_;

private:
    std::mutex mutex_;
    NoticeList notices_;
};

TEST_F(LoopThreadsTest, BothKindsRunAndAreWatchedFromAThirdThread)
{
    for (const bool decoupled : {false, true})
    {
        ProbeWorld world;
        dCreatePlane(world.space, 0, 0, 1, 0);
        world.add_moving_box({0.05, 0.05, 0.05}, {0, 0.01, -0.025}, 10);
        HapticProbe probe(device_, world.space, radius, without_ramp());
        HapticLoop loop(probe, settings(decoupled));
        std::atomic<bool> over{false};
        std::atomic<int> reads{0};
        std::thread watcher([&] {
            while (!over)
            {
                const LoopReport report = loop.report();
                EXPECT_LE(report.period.p50, report.period.max);
                ++reads;
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
        });
        double largest = 0;
        const LoopReport report = loop.run(world.work(probe, [&](double) {
            largest = std::max(largest, loop.latest().requested.norm());
            if (largest > 0 && reads > 10 && loop.report().ticks > 100)
                loop.stop();
        }));
        over = true;
        watcher.join();
        EXPECT_GT(reads, 10);
        EXPECT_GT(report.ticks, 100U);
        EXPECT_GT(report.steps, 0U);
        EXPECT_GT(largest, 0);
        EXPECT_FALSE(report.scheduling.empty());
        EXPECT_EQ(device_.force, 0);
    }
}

TEST_F(LoopThreadsTest, AHangingSceneHasNoForceWhileItHangs)
{
    for (const bool decoupled : {false, true})
    {
        ProbeWorld world;
        dCreatePlane(world.space, 0, 0, 1, 0);
        HapticProbe probe(device_, world.space, radius, without_ramp());
        HapticLoop loop(probe, settings(decoupled));
        bool hung = false;
        const int before = count(NoticeKind::guard) + count(NoticeKind::watchdog);
        loop.run(world.work(probe, [&](double) {
            if (device_.force <= 0)
                return;
            hung = true;
            EXPECT_TRUE(eventually([&] { return device_.force == 0; }));
            EXPECT_TRUE(eventually([&] { return count(NoticeKind::guard) + count(NoticeKind::watchdog) > before; }));
            loop.stop();
        }));
        EXPECT_TRUE(hung);
        EXPECT_EQ(device_.force, 0);
    }
}

TEST_F(LoopThreadsTest, WhatTheNoticesSinkThrowsEndsTheLoopWithoutForce)
{
    for (const bool decoupled : {false, true})
    {
        ProbeWorld world;
        dCreatePlane(world.space, 0, 0, 1, 0);
        HapticProbe probe(device_, world.space, radius, without_ramp());
        LoopSettings settings = this->settings(decoupled);
        settings.notice = [](const Notice &) { throw std::runtime_error("the terminal is gone"); };
        HapticLoop loop(probe, settings);
        bool pressed = false;
        EXPECT_THROW(loop.run(world.work(probe,
                                         [&](double) {
                                             pressed = pressed || device_.force > 0;
                                             if (pressed) // worth a notice
                                                 std::this_thread::sleep_for(std::chrono::milliseconds(20));
                                         })),
                     std::runtime_error);
        EXPECT_EQ(device_.force, 0);
    }
}

/// While the servo slides over a mesh, the scene replaces its data, changes its triangles in place, and recreates it.
TEST_F(LoopThreadsTest, MeshesMayChangeWhileTheServoFeelsThem)
{
    const RidgeShape ridges;
    OdeMesh mesh(ridge_mesh(ridges, 60, 60));
    const OdeMesh other(ridge_mesh(ridges, 50, 50));
    dGeomID geom = mesh.add_to(world_.space);
    ScriptedDevice device([](double seconds) -> Vector3 { return {0.02 * std::sin(20 * seconds), 0.001, 0.008}; });
    HapticProbe probe(device, world_.space, radius, without_ramp());
    LoopSettings settings = this->settings(true);
    settings.physics_rate = 500;
    HapticLoop loop(probe, settings);
    int steps = 0;
    int pressed = 0;
    loop.run({[&] { world_.collide(probe); },
              [&](double dt) {
                  world_.step(dt);
                  pressed += loop.latest().requested.norm() > 0.5 ? 1 : 0;
                  switch (++steps % 20)
                  {
                  case 5:
                      mesh.set(ridge_mesh(ridges, 60 - steps % 3, 60));
                      dGeomTriMeshSetData(geom, mesh.data());
                      probe.sensor()->forget_mesh(mesh.data());
                      break;
                  case 10:
                      dGeomTriMeshSetData(geom, other.data());
                      break;
                  case 15:
                      dGeomDestroy(geom);
                      geom = mesh.add_to(world_.space);
                      break;
                  default:
                      break;
                  }
                  if (steps >= 250 && pressed > 10)
                      loop.stop();
              }});
    dGeomDestroy(geom);
    EXPECT_GT(pressed, 10);
}
} // namespace
} // namespace ode_predictive_space::haptics
