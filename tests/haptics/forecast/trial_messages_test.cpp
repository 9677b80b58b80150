// A loop of two threads tries steps out; messages of ODE about trials are kept from the program.

#include "ode_predictive_space/haptics/loop.h"
#include "ode_predictive_space/haptics/loop/trial_messages.h"
#include "ode_predictive_space/haptics/virtual_device.h"

#include "tests/haptics/support/probe_fixture.h"

#include <cstdarg>
#include <ode/error.h>
#include <thread>

namespace ode_predictive_space::haptics
{
namespace
{
std::uint64_t messages_of_program = 0;

class TrialMessagesTest : public testing::Test
{
protected:
    TrialMessagesTest() : before_(dGetMessageHandler())
    {
        messages_of_program = 0;
        dSetMessageHandler([](int, const char *, va_list) { ++messages_of_program; });
    }

    ~TrialMessagesTest() override { dSetMessageHandler(before_); }

    const OdeUse ode_;
    dMessageFunction *before_;
};

TEST_F(TrialMessagesTest, KeepBackThoseOfTheirThreadAloneAndLeaveTheHandlerAsItWas)
{
    dMessageFunction *const handler = dGetMessageHandler();
    {
        const TrialMessages messages;
        std::thread([] {
            TrialMessages(); // of another loop
            dMessage(1, "done");
        }).join();
        dMessage(1, "tried");
        EXPECT_EQ(messages.count(), 1U);
    }
    EXPECT_EQ(messages_of_program, 1U);
    EXPECT_EQ(dGetMessageHandler(), handler);
    dMessage(1, "done");
    EXPECT_EQ(messages_of_program, 2U);
    const TrialMessages next;
    EXPECT_EQ(next.count(), 0U);
}

/// The contacts of a box that a hand presses beside its middle depend on each other: dWorldStep() sends messages.
TEST_F(TrialMessagesTest, AreCountedAndGivenOnceInALoopOfTwoThreads)
{
    ProbeWorld world;
    dWorldSetGravity(world.world, 0, 0, -9.81);
    dCreatePlane(world.space, 0, 0, 1, 0);
    const dBodyID box = world.add_moving_box({0.2, 0.2, 0.1}, {0, 0, 0.05}, 1);
    dMass mass;
    dMassSetBoxTotal(&mass, 1, 0.2, 0.2, 0.1);
    dBodySetMass(box, &mass);
    VirtualDevice device({}, [](double seconds) -> Vector3 {
        return {0.05, 0.05 - 0.1 * std::min(1.0, seconds / 0.4), 0};
    });
    RenderSettings settings;
    settings.placement.rotation = WorkspacePlacement::z_up();
    settings.placement.offset = {0, 0, 0.14};
    HapticProbe probe(device, world.space, radius, settings);
    NoticeList notices;
    SimulatedClock clock;
    LoopSettings loop_settings = simulated(clock, 5, true, 200);
    loop_settings.notice = notices.sink();
    HapticLoop loop(probe, loop_settings);
    const LoopReport report = loop.run(world.work(probe));
    EXPECT_EQ(messages_of_program, 0U);
    ASSERT_GT(report.trial_messages, 1U) << "or the scene does not show it";
    int given = 0;
    for (const Notice &notice : notices.all())
        given += notice.sentence().find("ODE gives messages") != std::string::npos ? 1 : 0;
    EXPECT_EQ(given, 1);
}
} // namespace
} // namespace ode_predictive_space::haptics
