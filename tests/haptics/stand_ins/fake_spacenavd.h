// A stand-in for spacenavd, the server of 3D mice: a socket, its protocol, and events on demand.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_SPACENAVD_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_STAND_INS_FAKE_SPACENAVD_H

#include "tests/support/scratch.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

enum class SpacenavdManner
{
    usual,      ///< protocol 1, one mouse, "Stand-in Mouse"
    old,        ///< protocol 0: no answers
    no_mouse,   ///< protocol 1, no mouse
    busy_mouse, ///< protocol 1; a motion precedes the first answer
    hangs_up,   ///< accepts the connection and closes it
    hangs_up_after_greeting
};

/// Its thread serves one client at a time at a new socket until stop(). SPNAV_SOCKET names the socket during its lifetime.
class FakeSpacenavd
{
public:
    explicit FakeSpacenavd(SpacenavdManner manner = SpacenavdManner::usual);
    ~FakeSpacenavd();
    FakeSpacenavd(const FakeSpacenavd &) = delete;
    FakeSpacenavd &operator=(const FakeSpacenavd &) = delete;

    /// Sends to the connected client, which can read it when this returns.
    void send_motion(int x, int y, int z, int rx, int ry, int rz) { send({0, x, y, z, rx, ry, rz, 16}); }
    void send_button(int button, bool is_pressed) { send({is_pressed ? 1 : 2, button, 0, 0, 0, 0, 0, 0}); }
    void send_unplugged() { send({3, 1, 0, 0, 0, 0, 0, 0}); }
    void send_plugged_in() { send({3, 0, 0, 0, 0, 0, 0, 0}); }

    void send_nonsense() { send({0x7fff0000, 1, 2, 3, 4, 5, 6, 7}); }

    void send_half_a_motion(int x);

    void stop();

    const std::string &socket_path() const { return path_; }

private:
    using Message = std::array<std::int32_t, 8>;

    void send(const Message &message);
    void serve();
    void serve_client(int client);
    bool greet(int client);
    void answer(int client, Message question);

    const SpacenavdManner manner_;
    const ode_predictive_space::ScratchFolder folder_;
    const std::string path_ = folder_.path() + "/spnav.sock";
    int listener_ = -1;
    std::atomic<int> client_{-1};
    std::atomic<bool> is_ended_{false};
    bool has_been_asked_ = false; ///< of the thread only
    std::thread thread_;
};

#endif
