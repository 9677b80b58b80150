// Ends of a program that no destructor sees: there must be no force after them. Each is tried in a process of its own.

#include "ode_predictive_space/haptics/loop.h"

#include "tests/haptics/probe_world.h"
#include "tests/haptics/scripted_device.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <functional>
#include <gtest/gtest.h>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace ode_predictive_space::haptics
{
namespace
{
/// What the device of another process renders.
struct SharedForce
{
    std::atomic<double> now{0};  ///< N
    std::atomic<double> most{0}; ///< N
};

class SharedDevice : public ScriptedDevice
{
public:
    explicit SharedDevice(SharedForce &force)
        : ScriptedDevice([](double seconds) -> Vector3 {
              return {0, 0,
                      0.009 + 0.003 * std::cos(20 * seconds)}; // in and out: a stall of the machine costs one touch
          }),
          force_(force)
    {}

    void close() noexcept override
    {
        ScriptedDevice::close();
        force_.now = 0;
    }

    void write(const Wrench &wrench) override
    {
        ScriptedDevice::write(wrench);
        force_.now = wrench.force.norm();
        force_.most = std::max(force_.most.load(), wrench.force.norm());
    }

private:
    SharedForce &force_;
};

/// The parameter: whether the loop has two threads.
class ProgramEndTest : public testing::TestWithParam<bool>
{
protected:
    ProgramEndTest()
        : memory_(mmap(nullptr, sizeof(SharedForce), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)),
          force_(*new (memory_) SharedForce)
    {}
    ~ProgramEndTest() override { munmap(memory_, sizeof(SharedForce)); }

    /// A program leans on a plane; with the force there, it ends. @return its exit status.
    int status_after(const std::function<void()> &end)
    {
        const pid_t child = fork();
        if (child == 0)
        {
            const rlimit no_core = {0, 0};
            setrlimit(RLIMIT_CORE, &no_core);
            lean_until([&] { end(); });
            std::_Exit(99);
        }
        int status = 0;
        waitpid(child, &status, 0);
        return status;
    }

    void expect_zero()
    {
        EXPECT_GT(force_.most, 1) << "it was there";
        EXPECT_EQ(force_.now, 0);
    }

private:
    void lean_until(const std::function<void()> &end)
    {
        dInitODE2(0);
        ProbeWorld world;
        dCreatePlane(world.space, 0, 0, 1, 0);
        SharedDevice device(force_);
        SafetyLimits limits = SafetyLimits::of(desktop_capabilities());
        limits.ramp_time = 0;
        RenderSettings rendering;
        rendering.safety = limits;
        HapticProbe probe(device, world.space, 0.01, rendering);
        LoopSettings settings;
        settings.decoupled = GetParam();
        settings.ask_for_priority = false;
        settings.duration = 20;
        HapticLoop loop(probe, settings);
        loop.run({[&] { world.collide(probe); },
                  [&](double dt) {
                      world.step(dt);
                      if (force_.now > 1.2)
                      {
                          end();
                      }
                  }});
    }

    void *memory_;

protected:
    SharedForce &force_;
};

TEST_P(ProgramEndTest, ExitInACallbackLeavesNoForce)
{
    const int status = status_after([] { std::exit(3); });
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 3);
    expect_zero();
}

TEST_P(ProgramEndTest, ExitInAnotherThreadLeavesNoForce)
{
    const int status = status_after([] { std::thread([] { std::exit(3); }).join(); });
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 3);
    expect_zero();
}

TEST_P(ProgramEndTest, QuickExitLeavesNoForce)
{
    const int status = status_after([] { std::quick_exit(4); });
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 4);
    expect_zero();
}

TEST_P(ProgramEndTest, TerminateLeavesNoForce)
{
    const int status = status_after([] { std::terminate(); });
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
    expect_zero();
}

TEST_P(ProgramEndTest, AnExceptionThatAThreadDoesNotCatchLeavesNoForce)
{
    const int status = status_after([] { std::thread([] { throw std::runtime_error("not caught"); }).join(); });
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
    expect_zero();
}

TEST_P(ProgramEndTest, SigquitEndsTheLoopAndLeavesNoForce)
{
    const int status = status_after([] { std::raise(SIGQUIT); });
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 99) << "run() returned";
    expect_zero();
}

INSTANTIATE_TEST_SUITE_P(Loops, ProgramEndTest, testing::Bool(),
                         [](const auto &parameters) { return parameters.param ? "TwoThreads" : "OneThread"; });
} // namespace
} // namespace ode_predictive_space::haptics
