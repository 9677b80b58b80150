#include "tests/docs/example_device.h"
#include "tests/support/error_of.h"

#include <gtest/gtest.h>
#include <ode_predictive_space/haptics/renderer.h>
#include <string>
#include <thread>
#include <vector>

namespace
{
using haptics::DeviceError;
using haptics::DeviceFault;
using haptics::Vector3;

class Server
{
public:
    Server()
    {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        EXPECT_EQ(0, bind(socket_, reinterpret_cast<sockaddr *>(&address), sizeof address));
        socklen_t size = sizeof address;
        getsockname(socket_, reinterpret_cast<sockaddr *>(&address), &size);
        port_ = ntohs(address.sin_port);
    }

    ~Server() { ::close(socket_); }
    Server(const Server &) = delete;
    Server &operator=(const Server &) = delete;

    std::uint16_t port() const { return port_; }

    void open(ExampleDevice &device)
    {
        std::thread answer([this] {
            receive();
            tell({0.01, 0.02, 0.03});
        });
        device.open();
        answer.join();
    }

    Vector3 receive()
    {
        Vector3 force(7, 7, 7);
        socklen_t size = sizeof client_;
        EXPECT_EQ(ssize_t{sizeof(double[3])},
                  recvfrom(socket_, force.data(), sizeof(double[3]), 0, reinterpret_cast<sockaddr *>(&client_), &size));
        return force;
    }

    void tell(const Vector3 &position)
    {
        const std::array<double, 6> numbers = {position.x(), position.y(), position.z(), 0.4, 0.5, 0.6};
        sendto(socket_, numbers.data(), sizeof numbers, 0, reinterpret_cast<sockaddr *>(&client_), sizeof client_);
    }

private:
    int socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    std::uint16_t port_ = 0;
    sockaddr_in client_{};
};

template <typename Call> DeviceFault fault_of(Call call)
{
    return ode_predictive_space::error_of<DeviceError>(call).fault();
}

haptics::Wrench force_of(double x, double y, double z)
{
    haptics::Wrench wrench;
    wrench.force = {x, y, z};
    return wrench;
}

TEST(ExampleDevice, withoutServerCannotBeOpened)
{
    std::uint16_t port = 0;
    {
        const Server gone;
        port = gone.port();
    }
    ExampleDevice device(port);
    EXPECT_EQ(DeviceFault::not_found, fault_of([&] { device.open(); }));
    EXPECT_FALSE(device.status().open);
    EXPECT_EQ(DeviceFault::not_open, fault_of([&] { device.read(0); }));
    EXPECT_EQ(DeviceFault::not_open, fault_of([&] { device.write({}); }));
}

TEST(ExampleDevice, tellsTheNewestStateAndWhenItWasNew)
{
    Server server;
    ExampleDevice device(server.port());
    server.open(device);
    EXPECT_EQ(Vector3(0.01, 0.02, 0.03), device.read(0.5).position);
    server.tell({4, 5, 6});
    server.tell({7, 8, 9});
    const haptics::DeviceState state = device.read(1);
    EXPECT_EQ(Vector3(7, 8, 9), state.position);
    EXPECT_EQ(Vector3(0.4, 0.5, 0.6), state.linear_velocity);
    EXPECT_EQ(1, state.time);
    EXPECT_EQ(1, device.read(2).time);
}

TEST(ExampleDevice, sendsForcesAndNoneInTheEnd)
{
    Server server;
    ExampleDevice device(server.port());
    server.open(device);
    device.write(force_of(1, -2, 3));
    EXPECT_EQ(Vector3(1, -2, 3), server.receive());
    device.close();
    EXPECT_EQ(Vector3(0, 0, 0), server.receive());
    EXPECT_FALSE(device.status().open);
}

TEST(ExampleDevice, thatTellsNothingNewGetsNoForce)
{
    std::vector<std::string> notices;
    haptics::RenderSettings settings;
    settings.notice = [&](const haptics::Notice &notice) { notices.emplace_back(notice.sentence()); };
    Server server;
    ExampleDevice device(server.port());
    server.open(device);
    haptics::Renderer renderer(device, settings);
    for (int tick = 1; tick <= 20; ++tick)
    {
        renderer.read(0.001 * tick, 0.001 * tick);
        renderer.note_fresh_physics();
        renderer.render({}, true, 0.001);
    }
    EXPECT_FALSE(renderer.last_tick().device_answers);
    EXPECT_EQ(std::vector<std::string>{"No force: The device has given no new state for too long."}, notices);
}
} // namespace
