// The base of every test of a space: ODE is started, and its message handlers are replaced.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_ODE_TEST_H
#define ODE_PREDICTIVE_SPACE_TESTS_CONTRACT_SUPPORT_ODE_TEST_H

#include <functional>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>
#include <ode/ode.h>

namespace ode_predictive_space
{
/// Thrown from dDebug() and dError(), which must not return.
struct OdeAbort : std::runtime_error
{
    using std::runtime_error::runtime_error;
};

/// Replaces ODE's three message handlers during its lifetime. Aborts become OdeAbort; messages are kept.
class OdeMessages
{
public:
    OdeMessages();
    ~OdeMessages();
    OdeMessages(const OdeMessages &) = delete;
    OdeMessages &operator=(const OdeMessages &) = delete;

    static std::string text();

private:
    dMessageFunction *error_;
    dMessageFunction *debug_;
    dMessageFunction *message_;
};

/// Runs `call` and returns the text that ODE's handlers get from it: an error, an assertion, or messages.
std::string ode_complaint(const std::function<void()> &call);

bool ode_has_assertions();

/// ODE is up. An unexpected assertion, error or message of ODE fails the test.
class OdeTest : public ::testing::Test
{
protected:
    void TearDown() override;

private:
    OdeMessages messages_;
};

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
