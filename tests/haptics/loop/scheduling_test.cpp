// Rights that the system grants or refuses. Each test runs in a separate process, which may drop its rights.

#include "ode_predictive_space/haptics/loop/scheduling.h"

#include "ode_predictive_space/haptics/loop.h"
#include "tests/haptics/support/probe_world.h"
#include "tests/haptics/support/scripted_device.h"
#include "tests/support/effort.h"

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace ode_predictive_space::haptics
{
namespace
{
/// Sanitizers intercept mlock() and its relatives, and lock nothing.
constexpr bool locks_are_real = !is_sanitized;

/// Whether the claim holds in a child process without the rights to real-time priority and locked memory.
bool holds_without_rights(const std::function<bool()> &claim)
{
    const pid_t child = fork();
    if (child == 0)
    {
        const rlimit nothing = {0, 0};
        constexpr uid_t nobody = 65534;
        const bool dropped = setrlimit(RLIMIT_RTPRIO, &nothing) == 0 && setrlimit(RLIMIT_MEMLOCK, &nothing) == 0 &&
                             (geteuid() != 0 || (setgid(nobody) == 0 && setuid(nobody) == 0));
        _exit(dropped && claim() ? 0 : 1);
    }
    int status = 0;
    return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(Scheduling, ARefusalIsAnErrorNumber)
{
    EXPECT_TRUE(holds_without_rights([] {
        std::atomic<int> memory{0};
        const AtEnd lock = lock_memory(memory);
        return ask_for_real_time(false) == EPERM && ask_for_real_time(true) == EPERM && (memory != 0) == locks_are_real;
    }));
}

TEST(Scheduling, ALoopThatIsRefusedRunsAllTheSameAndSaysSo)
{
    EXPECT_TRUE(holds_without_rights([] {
        const OdeUse ode;
        ProbeWorld world;
        SimulatedClock clock;
        ScriptedDevice device([](double) -> Vector3 { return {0, 0, 1}; });
        HapticProbe probe(device, world.space, 0.01);
        NoticeList notices;
        LoopSettings settings;
        settings.clock = &clock;
        settings.duration = 0.1;
        settings.notice = notices.sink();
        const LoopReport report = HapticLoop(probe, settings).run({[] {}, [](double) {}});
        const std::string told = notices.text(NoticeKind::scheduling);
        return report.ticks == 100 && told.find("rtprio") != std::string::npos &&
               told.find("memlock") != std::string::npos && report.scheduling == told;
    }));
}

/// kB; from the system's status file.
long locked_memory()
{
    std::ifstream status("/proc/self/status");
    std::string line;
    long kilobytes = -1;
    while (std::getline(status, line))
        std::sscanf(line.c_str(), "VmLck: %ld", &kilobytes);
    return kilobytes;
}

TEST(Scheduling, OneRefusalOfTwoIsToldOfToo)
{
    SchedulingOutcome outcome;
    outcome.asked = true;
    EXPECT_FALSE(outcome.refused());
    outcome.memory_error = EPERM;
    EXPECT_TRUE(outcome.refused());
    EXPECT_NE(outcome.text().find("has real-time priority"), std::string::npos);
    EXPECT_NE(outcome.text().find("Memory is not locked"), std::string::npos);
}

TEST(Scheduling, IsThatOfTheLoopDuringItsRunAlone)
{
    const OdeUse ode;
    ProbeWorld world;
    SimulatedClock clock;
    ScriptedDevice device([](double) -> Vector3 { return {0, 0, 1}; });
    HapticProbe probe(device, world.space, 0.01);
    LoopSettings settings = simulated(clock, 0.01);
    settings.ask_for_priority = true;
    long locked = 0; // kB
    int policy = SCHED_OTHER;
    const SceneWork work = {[] {},
                            [&](double) {
                                locked = locked_memory();
                                policy = sched_getscheduler(0);
                            }};
    const LoopReport report = HapticLoop(probe, settings).run(work);
    EXPECT_EQ(policy == SCHED_FIFO, report.scheduling.find("has real-time priority") != std::string::npos);
    EXPECT_EQ(locked > 0, locks_are_real && report.scheduling.find("Memory is locked") != std::string::npos);
    EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER);
    EXPECT_EQ(locked_memory(), 0);
}

TEST(Scheduling, MemoryThatTheProgramLockedStaysLocked)
{
    std::vector<char> own(1 << 16);
    ASSERT_EQ(mlock(own.data(), own.size()), 0);
    const long before = locked_memory();
    EXPECT_EQ(before > 0, locks_are_real);
    std::atomic<int> error{-1};
    {
        const AtEnd lock = lock_memory(error);
    }
    EXPECT_GE(locked_memory(), before);
    munlockall();
    {
        const AtEnd lock = lock_memory(error);
    }
    EXPECT_EQ(locked_memory(), 0);
}

TEST(Scheduling, AThreadGetsItsSchedulingBack)
{
    {
        const AtEnd kept = keep_scheduling();
        ask_for_real_time(false);
    }
    EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER);
}
} // namespace
} // namespace ode_predictive_space::haptics
