#include "ode_predictive_space/haptics/device/spnav_connection.h"

#ifdef ODE_PREDICTIVE_SPACE_HAS_SPNAV

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

// Last, because it includes X11's macros.
#include <spnav.h>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr const char *usual_socket = "/var/run/spnav.sock";

/// The file in which libspnav looks for the name of a socket.
constexpr const char *server_settings = "/etc/spnavrc";

/// Maximum of events in one call, because a faulty server must not block the servo. Mice send some hundred a second.
constexpr int most_events_at_once = 256;

/// Blocks SIGPIPE in this thread: libspnav uses write(), and a server that hangs up must not end the program.
AtEnd block_sigpipe()
{
    sigset_t sigpipe, pending, mask_before;
    sigemptyset(&sigpipe);
    sigaddset(&sigpipe, SIGPIPE);
    sigpending(&pending);
    pthread_sigmask(SIG_BLOCK, &sigpipe, &mask_before);
    return AtEnd([sigpipe, mask_before, was_pending = sigismember(&pending, SIGPIPE) == 1] {
        const timespec at_once{0, 0};
        if (!was_pending)
            sigtimedwait(&sigpipe, nullptr, &at_once);
        pthread_sigmask(SIG_SETMASK, &mask_before, nullptr);
    });
}

/// The error number of connecting to a socket; 0 on success.
int connect_error(const std::string &path)
{
    sockaddr_un address{};
    if (path.size() >= sizeof address.sun_path)
        return ENAMETOOLONG;
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
    const int socket_number = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (socket_number == -1)
        return errno;
    const bool is_connected = connect(socket_number, reinterpret_cast<const sockaddr *>(&address), sizeof address) == 0;
    const int error = is_connected ? 0 : errno;
    close(socket_number);
    return error;
}

DeviceError server_error(const std::string &path, int error)
{
    const bool is_forbidden = error == EACCES || error == EPERM;
    const std::string reason = error != 0 ? std::strerror(error) : "libspnav refused it";
    return {is_forbidden ? DeviceFault::permission_denied : DeviceFault::missing_file,
            "3D mouse: no connection to spacenavd at " + path + ": " + reason};
}

/// @throws DeviceError in a set-user-ID program, whose environment is not trusted: libspnav would use it.
std::string named_socket()
{
    const char *named = std::getenv("SPNAV_SOCKET");
    if (named != nullptr && secure_getenv("SPNAV_SOCKET") == nullptr)
    {
        throw DeviceError(DeviceFault::permission_denied,
                          "3D mouse: SPNAV_SOCKET is set, which a set-user-ID program ignores: unset it");
    }
    return named != nullptr ? named : "";
}

void open_library()
{
    if (spnav_fd() != -1)
    {
        throw DeviceError(DeviceFault::permission_denied, "3D mouse: another device of this program uses libspnav, "
                                                          "which has only one connection: close that one first");
    }
    const std::string named = named_socket();
    const bool is_named = !named.empty();
    const std::string path = is_named ? named : usual_socket;
    const int error = connect_error(path);
    // libspnav would fall back to another server, and leaks memory at each failed open.
    if (error != 0 && (is_named || access(server_settings, R_OK) != 0))
        throw server_error(path, error);
    errno = 0; // libspnav mistakes an old EINTR for its own, and reads a closed socket forever
    if (spnav_open() == -1)
        throw server_error(path, error);
}

enum class Inbox
{
    waiting,
    empty,
    closed ///< the server has hung up; libspnav does not report it
};

Inbox look_into_inbox()
{
    char byte;
    const ssize_t size = recv(spnav_fd(), &byte, sizeof byte, MSG_PEEK | MSG_DONTWAIT);
    if (size > 0)
        return Inbox::waiting;
    return size == -1 && (errno == EAGAIN || errno == EINTR) ? Inbox::empty : Inbox::closed;
}

DeviceError lost(const std::string &why)
{
    return {DeviceFault::lost, "3D mouse: " + why};
}

/// Called before each query, because libspnav would wait forever at a closed socket.
void ensure_server()
{
    errno = 0;
    if (look_into_inbox() == Inbox::closed)
        throw lost("spacenavd has closed the connection");
}

/// @throws DeviceError not_found for a server without a mouse; lost.
std::string find_mouse()
{
    constexpr const char *unknown = "3D mouse";
    if (spnav_protocol() < 1)
        return unknown; // an old server does not report it
    // libspnav takes a motion event before the answer for the answer, so that the query fails.
    constexpr int attempts = 3;
    for (int attempt = 0; attempt < attempts; ++attempt)
    {
        ensure_server();
        if (spnav_dev_type() < 0)
            continue;
        ensure_server();
        char name[128];
        return spnav_dev_name(name, sizeof name) > 0 ? name : unknown;
    }
    ensure_server();
    throw DeviceError(DeviceFault::not_found, "3D mouse: spacenavd runs, but has no mouse: plug one in");
}

void take_button(const spnav_event_button &button, std::uint32_t &buttons)
{
    if (button.bnum < 0 || button.bnum >= 32)
        return;
    const std::uint32_t bit = std::uint32_t{1} << button.bnum;
    buttons = button.press != 0 ? buttons | bit : buttons & ~bit;
}

void take_event(const spnav_event &event, SpnavInput &input)
{
    switch (event.type)
    {
    case SPNAV_EVENT_MOTION:
        // The server's z axis points away from the person, so its rotation has the opposite sign.
        input.translation = Vector3(event.motion.x, event.motion.y, -event.motion.z);
        input.rotation = Vector3(event.motion.rx, event.motion.ry, -event.motion.rz);
        break;
    case SPNAV_EVENT_BUTTON:
        take_button(event.button, input.buttons);
        break;
    case SPNAV_EVENT_DEV:
        if (event.dev.op == SPNAV_DEV_RM)
            throw lost("a mouse was unplugged");
        break;
    default:
        break;
    }
}
} // namespace

SpnavConnection::SpnavConnection()
{
    const AtEnd unblock = block_sigpipe();
    open_library();
    opened_ = AtEnd(spnav_close);
    mouse_ = find_mouse();
}

void SpnavConnection::receive(SpnavInput &input)
{
    for (int taken = 0; taken < most_events_at_once; ++taken)
    {
        spnav_event event{};
        if (spnav_poll_event(&event) != 0)
        {
            take_event(event, input);
            continue;
        }
        const Inbox inbox = look_into_inbox();
        if (inbox == Inbox::closed)
            throw lost("spacenavd has ended");
        if (inbox == Inbox::empty)
            return;
    }
}
} // namespace ode_predictive_space::haptics

#else

namespace ode_predictive_space::haptics
{
SpnavConnection::SpnavConnection()
{
    throw DeviceError(DeviceFault::missing_library,
                      "3D mouse: this library was built without libspnav: build it where libspnav-dev is installed");
}

void SpnavConnection::receive(SpnavInput &) {}
} // namespace ode_predictive_space::haptics

#endif
