#include "ode_predictive_space/haptics/safety/open_gates.h"

#include "tests/haptics/safety/program_end_fixture.h"
#include "tests/haptics/support/allocation_count.h"

#include <atomic>
#include <exception>
#include <memory>
#include <sys/time.h>
#include <thread>

namespace ode_predictive_space::haptics
{
namespace
{
class PushingGate
{
public:
    explicit PushingGate(SharedForce &force) : device(force), gate(device)
    {
        device.open();
        open_gates::add(gate);
        DeviceState state;
        gate.read(0, state);
        gate.write(push(1));
    }

    ~PushingGate() { open_gates::remove(gate); }
    PushingGate(const PushingGate &) = delete;
    PushingGate &operator=(const PushingGate &) = delete;

    SharedDevice device;
    DeviceGate gate;
};

class OpenGatesTest : public ProgramEnds
{
protected:
    ProgramEnd end_in_driver_of_guard(const std::function<void()> &end)
    {
        return end_of_pressing([&] {
            static PushingGate pushing(force_); // exit() destroys it
            pushing.device.after_write = end;
            open_gates::close_unguarded(std::this_thread::get_id(), 0);
        });
    }
};

TEST_F(OpenGatesTest, ADriverMayTerminateTheProgramInTheGuardsCall)
{
    expect_abort(end_in_driver_of_guard([] { std::terminate(); }));
    expect_zero();
}

TEST_F(OpenGatesTest, ADriverMayExitInTheGuardsCall)
{
    EXPECT_TRUE(end_in_driver_of_guard([] { std::exit(3); }).exited_with(3));
    expect_zero();
}

TEST_F(OpenGatesTest, ASecondGateToADeviceIsRefusedUntilTheFirstIsRemoved)
{
    auto pushing = std::make_unique<PushingGate>(force_);
    SharedDevice &device = pushing->device;
    DeviceGate second(device);
    EXPECT_THROW(open_gates::add(second), std::logic_error);
    open_gates::remove(pushing->gate);
    EXPECT_NO_THROW(open_gates::add(second));
    open_gates::remove(second);
    const std::uint64_t before = allocation_count();
    open_gates::add(second);
    open_gates::remove(second);
    EXPECT_EQ(allocation_count(), before) << "a place is used again";
}

TEST_F(OpenGatesTest, OnlyUnguardedGatesThatTheThreadReadsAreClosed)
{
    PushingGate pushing(force_);
    const std::thread::id me = std::this_thread::get_id();
    EXPECT_FALSE(open_gates::close_unguarded(std::thread::id(), 0)) << "another thread";
    pushing.gate.set_guarded(true);
    EXPECT_FALSE(open_gates::close_unguarded(me, 0)) << "guarded";
    EXPECT_EQ(force_.now, 1);
    pushing.gate.set_guarded(false);
    EXPECT_TRUE(open_gates::close_unguarded(me, 0));
    EXPECT_EQ(force_.now, 0);
}

TEST_F(OpenGatesTest, TheEndOfAllForcesLeavesTheAlarmToTheProgram)
{
    for (int round = 0; round < 2; ++round) // the second gate takes the place of the first
    {
        PushingGate pushing(force_);
        EXPECT_EQ(force_.now, 1);
        open_gates::end_all_forces();
        EXPECT_EQ(force_.now, 0) << round;
    }
    itimerval timer = {};
    getitimer(ITIMER_REAL, &timer);
    EXPECT_EQ(timer.it_value.tv_sec + timer.it_value.tv_usec, 0);
    struct sigaction action = {};
    sigaction(SIGALRM, nullptr, &action);
    EXPECT_TRUE(action.sa_handler == SIG_DFL);
}

TEST_F(OpenGatesTest, AGateThatIsRemovedIsLeftAlone)
{
    std::atomic<bool> over{false};
    std::thread guard([&, reader = std::this_thread::get_id()] {
        while (!over)
            open_gates::close_unguarded(reader, 0);
    });
    for (int i = 0; i < 2000; ++i)
    {
        // AddressSanitizer reports a visit to a destroyed gate.
        const auto first = std::make_unique<PushingGate>(force_);
        const auto second = std::make_unique<PushingGate>(second_force_);
    }
    over = true;
    guard.join();
    EXPECT_FALSE(open_gates::close_unguarded(std::this_thread::get_id(), 0)) << "none is left";
}
} // namespace
} // namespace ode_predictive_space::haptics
