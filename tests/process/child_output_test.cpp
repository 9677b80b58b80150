// A child that becomes another program: all that it writes, or nothing.

#include "ode_predictive_space/process/child_output.h"

#include <csignal>

#include <gtest/gtest.h>

#include <unistd.h>

namespace ode_predictive_space::process
{
namespace
{
void become_shell(int pipe, const char *script)
{
    dup2(pipe, STDOUT_FILENO);
    execl("/bin/sh", "sh", "-c", script, nullptr);
}

TEST(ChildOutput, IsAllThatAProgramWrites)
{
    const auto output =
        child_output([](int pipe) { become_shell(pipe, "printf one; head -c 200000 /dev/zero; printf two"); });
    ASSERT_TRUE(output);
    ASSERT_EQ(output->size(), 200006u) << "more than a pipe holds";
    EXPECT_EQ(output->substr(0, 3) + output->substr(200003), "onetwo");
}

TEST(ChildOutput, IsEmptyWhereNothingIsWritten)
{
    EXPECT_EQ(child_output([](int pipe) { become_shell(pipe, "exit 0"); }), std::string());
}

TEST(ChildOutput, IsNoneOfAProgramThatFails)
{
    EXPECT_EQ(child_output([](int pipe) { become_shell(pipe, "echo half; exit 1"); }), std::nullopt);
    EXPECT_EQ(child_output([](int pipe) { become_shell(pipe, "echo half; kill -KILL $$"); }), std::nullopt);
}

TEST(ChildOutput, IsNoneWhereTheProgramIsMissing)
{
    EXPECT_EQ(child_output([](int /*pipe*/) { execl("/nonexistent/program", "program", nullptr); }), std::nullopt);
}

void ignore_signal(int /*number*/) {}

// Without SA_RESTART a read that waits returns.
TEST(ChildOutput, GoesOnAfterASignal)
{
    struct sigaction action = {}, before = {};
    action.sa_handler = ignore_signal;
    sigaction(SIGUSR1, &action, &before);
    const auto output = child_output(
        [](int pipe) { become_shell(pipe, "printf one; sleep 0.2; kill -USR1 $PPID; sleep 0.2; printf two"); });
    sigaction(SIGUSR1, &before, nullptr);
    EXPECT_EQ(output, "onetwo");
}
} // namespace
} // namespace ode_predictive_space::process
