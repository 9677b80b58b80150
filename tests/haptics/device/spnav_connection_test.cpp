#include "ode_predictive_space/haptics/device/spnav_connection.h"

#include "tests/haptics/stand_ins/fake_spacenavd.h"
#include "tests/support/error_of.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>

using namespace ode_predictive_space::haptics;
using ode_predictive_space::error_of;
using testing::IsSubstring;

namespace
{
DeviceError error_of_connecting()
{
    return error_of<DeviceError>([] { SpnavConnection(); });
}
} // namespace

TEST(SpnavConnection, WorksWithAnOldServer)
{
    FakeSpacenavd server(SpacenavdManner::old);
    SpnavConnection connection;
    server.send_motion(1, 2, 3, 4, 5, 6);
    SpnavInput input;
    connection.receive(input);
    EXPECT_EQ(input.translation, Vector3(1, 2, -3));
    EXPECT_EQ(input.rotation, Vector3(4, 5, -6));
}

TEST(SpnavConnection, FindsTheMouseWhileItIsMoved)
{
    const FakeSpacenavd server(SpacenavdManner::busy_mouse);
    EXPECT_NO_THROW(SpnavConnection());
}

TEST(SpnavConnection, SaysThatTheServerHasNoMouse)
{
    const FakeSpacenavd server(SpacenavdManner::no_mouse);
    EXPECT_EQ(error_of_connecting().fault(), DeviceFault::not_found);
    EXPECT_EQ(error_of_connecting().fault(), DeviceFault::not_found) << "the failed connection is not in the way";
}

TEST(SpnavConnection, SurvivesAServerThatHangsUp)
{
    for (const SpacenavdManner manner : {SpacenavdManner::hangs_up, SpacenavdManner::hangs_up_after_greeting})
    {
        const FakeSpacenavd server(manner);
        const DeviceError error = error_of<DeviceError>([] {
            SpnavInput input;
            SpnavConnection().receive(input);
        });
        EXPECT_EQ(error.fault(), DeviceFault::lost) << error.what();
    }
}

TEST(SpnavConnection, NamesTheSocketThatIsNotThere)
{
    const std::string too_long(200, 'x');
    for (const std::string &path : {std::string("/nowhere/spnav.sock"), too_long})
    {
        setenv("SPNAV_SOCKET", path.c_str(), 1);
        const DeviceError error = error_of_connecting();
        unsetenv("SPNAV_SOCKET");
        EXPECT_EQ(error.fault(), DeviceFault::missing_file);
        EXPECT_PRED_FORMAT2(IsSubstring, path + (path == too_long ? "" : ": No such file"), error.what());
    }
}

TEST(SpnavConnection, NamesTheSocketThatNobodyListensAt)
{
    FakeSpacenavd server;
    server.stop();
    const DeviceError error = error_of_connecting();
    EXPECT_EQ(error.fault(), DeviceFault::missing_file);
    EXPECT_PRED_FORMAT2(IsSubstring, server.socket_path() + ": Connection refused", error.what());
}

TEST(SpnavConnectionDeathTest, NamesTheSocketThatMustNotBeOpened)
{
    const auto connect_as_somebody_else = [] {
        const FakeSpacenavd server;
        chmod(server.socket_path().c_str(), 0);
        // The superuser may open any socket.
        if (geteuid() == 0 && setuid(65534) != 0)
            std::_Exit(1);
        const DeviceError error = error_of_connecting();
        std::fprintf(stderr, "%s: %s", name_of(error.fault()), error.what());
        std::_Exit(0);
    };
    EXPECT_EXIT(connect_as_somebody_else(), testing::ExitedWithCode(0), "permission_denied: .*spnav.sock");
}

TEST(SpnavConnection, IsTheOnlyOneOfItsProgram)
{
    const FakeSpacenavd server;
    auto first = std::make_unique<SpnavConnection>();
    const DeviceError error = error_of_connecting();
    EXPECT_EQ(error.fault(), DeviceFault::permission_denied);
    EXPECT_PRED_FORMAT2(IsSubstring, "another device of this program", error.what());
    SpnavInput input;
    EXPECT_NO_THROW(first->receive(input)) << "the first one goes on";
    first.reset();
    EXPECT_NO_THROW(SpnavConnection());
}
