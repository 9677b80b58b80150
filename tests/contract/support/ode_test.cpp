#include "tests/contract/support/ode_test.h"

#include <cstdarg>
#include <cstdio>
#include <mutex>

namespace ode_predictive_space
{
namespace
{
std::mutex text_mutex;
std::string message_text;

std::string formatted(const char *message, va_list arguments)
{
    char text[2000];
    std::vsnprintf(text, sizeof text, message, arguments);
    return text;
}

void throw_abort(int, const char *message, va_list arguments)
{
    throw OdeAbort(formatted(message, arguments));
}

void keep_message(int, const char *message, va_list arguments)
{
    const std::lock_guard<std::mutex> lock(text_mutex);
    message_text += formatted(message, arguments) + "\n";
}

class OdeEnvironment : public ::testing::Environment
{
public:
    void SetUp() override
    {
        dInitODE2(0);
        dAllocateODEDataForThread(dAllocateMaskAll);
    }

    void TearDown() override { dCloseODE(); }
};

const ::testing::Environment *const environment = ::testing::AddGlobalTestEnvironment(new OdeEnvironment);
} // namespace

OdeMessages::OdeMessages() : error_(dGetErrorHandler()), debug_(dGetDebugHandler()), message_(dGetMessageHandler())
{
    dSetErrorHandler(throw_abort);
    dSetDebugHandler(throw_abort);
    dSetMessageHandler(keep_message);
    const std::lock_guard<std::mutex> lock(text_mutex);
    message_text.clear();
}

OdeMessages::~OdeMessages()
{
    dSetErrorHandler(error_);
    dSetDebugHandler(debug_);
    dSetMessageHandler(message_);
}

std::string OdeMessages::text()
{
    const std::lock_guard<std::mutex> lock(text_mutex);
    return message_text;
}

std::string ode_complaint(const std::function<void()> &call)
{
    std::string before;
    {
        const std::lock_guard<std::mutex> lock(text_mutex);
        before.swap(message_text);
    }
    std::string complaint;
    try
    {
        call();
        complaint = OdeMessages::text();
    }
    catch (const OdeAbort &abort)
    {
        complaint = OdeMessages::text() + abort.what();
    }
    const std::lock_guard<std::mutex> lock(text_mutex);
    message_text.swap(before);
    return complaint;
}

bool ode_has_assertions()
{
    dGeomID sphere = dCreateSphere(nullptr, 1);
    const bool complains = !ode_complaint([=] { dGeomSphereSetRadius(sphere, -1); }).empty();
    dGeomDestroy(sphere);
    return complains;
}

void OdeTest::TearDown()
{
    EXPECT_EQ(OdeMessages::text(), "");
    EXPECT_NE(environment, nullptr);
}
} // namespace ode_predictive_space
