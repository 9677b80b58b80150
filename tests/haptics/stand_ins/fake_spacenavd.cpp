#include "tests/haptics/stand_ins/fake_spacenavd.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace
{
// The protocol: the mark of a request, and the known requests.
constexpr std::int32_t tag = 0x7faa0000;
constexpr std::int32_t change_protocol = tag | 0x5500;
constexpr std::int32_t device_name = tag | 0x2000;
constexpr std::int32_t device_type = tag | 0x2005;

constexpr const char *mouse_name = "Stand-in Mouse";

bool receive(int client, void *data, std::size_t size)
{
    return recv(client, data, size, MSG_WAITALL) == static_cast<ssize_t>(size);
}

void write_to(int client, const void *data, std::size_t size)
{
    // The client may have gone in the meantime.
    static_cast<void>(::send(client, data, size, MSG_NOSIGNAL));
}
} // namespace

FakeSpacenavd::FakeSpacenavd(SpacenavdManner manner) : manner_(manner)
{
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path_.copy(address.sun_path, sizeof address.sun_path - 1);
    listener_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (bind(listener_, reinterpret_cast<const sockaddr *>(&address), sizeof address) != 0 || listen(listener_, 4) != 0)
        throw std::runtime_error("no socket at " + path_);
    setenv("SPNAV_SOCKET", path_.c_str(), 1);
    thread_ = std::thread([this] { serve(); });
}

FakeSpacenavd::~FakeSpacenavd()
{
    stop();
    unsetenv("SPNAV_SOCKET");
}

void FakeSpacenavd::stop()
{
    is_ended_ = true;
    shutdown(listener_, SHUT_RDWR);
    shutdown(client_, SHUT_RDWR);
    if (thread_.joinable())
    {
        thread_.join();
        close(listener_);
        listener_ = -1;
    }
}

void FakeSpacenavd::send(const Message &message)
{
    write_to(client_, message.data(), sizeof message);
}

void FakeSpacenavd::send_half_a_motion(int x)
{
    const std::int32_t half[4] = {0, x, 0, 0};
    write_to(client_, half, sizeof half);
}

void FakeSpacenavd::serve()
{
    while (!is_ended_)
    {
        const int client = accept(listener_, nullptr, nullptr);
        if (client == -1)
            return;
        client_ = client;
        // stop() either sees the client or is seen here.
        if (!is_ended_ && manner_ != SpacenavdManner::hangs_up)
            serve_client(client);
        client_ = -1;
        close(client);
    }
}

void FakeSpacenavd::serve_client(int client)
{
    if (!greet(client) || manner_ == SpacenavdManner::hangs_up_after_greeting)
        return;
    Message question;
    while (receive(client, &question, manner_ == SpacenavdManner::old ? sizeof question[0] : sizeof question))
        if (manner_ != SpacenavdManner::old)
            answer(client, question);
}

bool FakeSpacenavd::greet(int client)
{
    std::int32_t request = 0;
    if (!receive(client, &request, sizeof request))
        return false;
    if (manner_ != SpacenavdManner::old && (request & ~0xff) == change_protocol)
        write_to(client, &request, sizeof request);
    return true;
}

void FakeSpacenavd::answer(int client, Message question)
{
    static constexpr Message motion{0, 1, 2, 3, 4, 5, 6, 16};
    std::fill(question.begin() + 1, question.end(), 0);
    switch (question[0])
    {
    case device_type:
        question[1] = 0x206;
        question[7] = manner_ == SpacenavdManner::no_mouse ? -1 : 0;
        break;
    case device_name:
        std::memcpy(&question[1], mouse_name, std::strlen(mouse_name));
        question[7] = static_cast<std::int32_t>(std::strlen(mouse_name));
        break;
    default:
        question[7] = -1;
    }
    if (manner_ == SpacenavdManner::busy_mouse && !has_been_asked_)
    {
        has_been_asked_ = true;
        write_to(client, motion.data(), sizeof motion);
    }
    write_to(client, question.data(), sizeof question);
}
