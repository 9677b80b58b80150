// What every test of a space rests on: ODE started, its handlers watched.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_ODE_TEST_H
#define ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_ODE_TEST_H

#include <functional>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <ode/ode.h>

namespace ode_predictive_space
{
/// Thrown out of dDebug() and dError(), which must not return.
struct OdeAbort : std::runtime_error
{
    using std::runtime_error::runtime_error;
};

/// Takes ODE's three message handlers while it lives. Aborts become OdeAbort; messages are kept.
class OdeMessages
{
public:
    OdeMessages();
    ~OdeMessages();
    OdeMessages(const OdeMessages &) = delete;
    OdeMessages &operator=(const OdeMessages &) = delete;

    /// What dMessage() said since this object was made.
    static std::string text();

private:
    dMessageFunction *error_;
    dMessageFunction *debug_;
    dMessageFunction *message_;
};

/// Runs `call` and returns what ODE's handlers were told by it: the text of an error, an assert, or messages.
std::string ode_complaint(const std::function<void()> &call);

/// Whether ODE checks what it is given; one that was built without assertions does not.
bool ode_has_assertions();

/// ODE is up; an assert of ODE, an error or a message that no test asked for fails the test.
class OdeTest : public ::testing::Test
{
protected:
    void TearDown() override;

private:
    OdeMessages messages_;
};

/// Starts ODE in a thread of a test and ends it there.
class OdeThread
{
public:
    OdeThread() { dAllocateODEDataForThread(dAllocateMaskAll); }
    ~OdeThread() { dCleanupODEAllDataForThread(); }
    OdeThread(const OdeThread &) = delete;
    OdeThread &operator=(const OdeThread &) = delete;
};
} // namespace ode_predictive_space

#endif
