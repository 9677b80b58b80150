#include "ode_predictive_space/haptics/safety.h"

#include "tests/haptics/support/signal_disposition.h"

#include <csignal>
#include <gtest/gtest.h>
#include <thread>

namespace ode_predictive_space::haptics
{
namespace
{
volatile std::sig_atomic_t heard_by_the_program = 0;

void program_handler(int number)
{
    heard_by_the_program = number;
}

TEST(StopRequest, SignalsThatEndAProgramAskForAStop)
{
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
    {
        const SignalDisposition ending(number);
        const StopRequest stop;
        EXPECT_FALSE(StopRequest::requested());
        EXPECT_EQ(StopRequest::signal(), 0);
        std::raise(number);
        EXPECT_TRUE(StopRequest::requested());
        EXPECT_EQ(StopRequest::signal(), number);
        std::raise(number); // a second signal is handled, too
        EXPECT_TRUE(StopRequest::requested());
    }
}

TEST(StopRequest, OfSeveralTheLastGivesTheSignalsBack)
{
    heard_by_the_program = 0;
    const SignalDisposition handler(SIGTERM, program_handler);
    {
        const StopRequest outer;
        {
            const StopRequest inner;
        }
        std::raise(SIGTERM);
        EXPECT_EQ(heard_by_the_program, 0);
        EXPECT_TRUE(StopRequest::requested());
        const StopRequest later; // keeps the earlier request
        EXPECT_TRUE(StopRequest::requested());
    }
    EXPECT_TRUE(StopRequest::requested()) << "the request outlives the objects";
    std::raise(SIGTERM);
    EXPECT_EQ(heard_by_the_program, SIGTERM);
}

TEST(StopRequest, ASignalThatTheProgramIgnoresStaysIgnored)
{
    const SignalDisposition handler(SIGHUP, SIG_IGN);
    const StopRequest stop;
    std::raise(SIGHUP);
    EXPECT_FALSE(StopRequest::requested());
}

TEST(StopRequest, NeedsNoSignal)
{
    const StopRequest stop;
    std::thread([] { StopRequest::request(); }).join();
    EXPECT_TRUE(StopRequest::requested());
    EXPECT_EQ(StopRequest::signal(), 0);
}

TEST(StopRequest, DoesNotHideTheSignalThatCameFirst)
{
    const SignalDisposition ending(SIGTERM);
    const StopRequest stop;
    std::raise(SIGTERM);
    StopRequest::request();
    EXPECT_EQ(StopRequest::signal(), SIGTERM);
}
} // namespace
} // namespace ode_predictive_space::haptics
