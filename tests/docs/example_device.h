// A device: an arm that another program on this machine serves, by datagrams.

#ifndef EXAMPLE_DEVICE_H
#define EXAMPLE_DEVICE_H

#include <array>
#include <cerrno>
#include <cstring>
#include <netinet/in.h>
#include <ode_predictive_space/haptics/device.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace haptics = ode_predictive_space::haptics;

/// We send a force, 3 doubles (N); the server answers with position and velocity, 6 doubles (m, m/s), and again whenever it has
/// new ones.
class ExampleDevice final : public haptics::Device
{
public:
    explicit ExampleDevice(std::uint16_t port) : port_(port)
    {
        capabilities_.name = "example arm";
        capabilities_.max_force = 8;        // N
        capabilities_.max_stiffness = 1000; // N/m
        capabilities_.max_damping = 5;      // N s/m
    }

    ~ExampleDevice() override { ExampleDevice::close(); }

    // May wait. Afterwards there is a state, so that read() never makes one up.
    void open() override
    {
        if (socket_ >= 0)
        {
            return;
        }
        sockaddr_in server{};
        server.sin_family = AF_INET;
        server.sin_port = htons(port_);
        server.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
        pollfd answer{socket_, POLLIN, 0};
        if (socket_ < 0 || connect(socket_, reinterpret_cast<sockaddr *>(&server), sizeof server) != 0 ||
            !send_force(haptics::Vector3::Zero()) || poll(&answer, 1, 5000) != 1 || !take_news(0))
        {
            close();
            throw haptics::DeviceError(haptics::DeviceFault::not_found,
                                       "example arm: no answer at port " + std::to_string(port_));
        }
    }

    void close() noexcept override
    {
        if (socket_ >= 0)
        {
            send_force(haptics::Vector3::Zero());
            ::close(socket_);
            socket_ = -1;
        }
    }

    const haptics::Capabilities &capabilities() const override { return capabilities_; }

    // From here on, nothing waits. Without news the state keeps its old time: that is how a silent device is noticed.
    haptics::DeviceState read(double time) override
    {
        check_open();
        while (take_news(time))
        {}
        if (errno != EAGAIN)
        {
            throw haptics::DeviceError(haptics::DeviceFault::lost,
                                       std::string("example arm: reading: ") + std::strerror(errno));
        }
        return state_;
    }

    void write(const haptics::Wrench &wrench) override
    {
        check_open();
        if (!send_force(wrench.force))
        {
            throw haptics::DeviceError(haptics::DeviceFault::lost,
                                       std::string("example arm: writing: ") + std::strerror(errno));
        }
    }

    haptics::DeviceStatus status() const override
    {
        return {socket_ >= 0, socket_ >= 0, socket_ >= 0 ? "" : "example arm: not open"};
    }

private:
    void check_open() const
    {
        if (socket_ < 0)
        {
            throw haptics::DeviceError(haptics::DeviceFault::not_open, "example arm: it is not open");
        }
    }

    bool send_force(const haptics::Vector3 &force) const noexcept
    {
        return send(socket_, force.data(), sizeof(double[3]), 0) == sizeof(double[3]);
    }

    /// @return whether there was something new; else errno says why not.
    bool take_news(double time)
    {
        std::array<double, 6> numbers;
        const ssize_t size = recv(socket_, numbers.data(), sizeof numbers, 0);
        if (size != sizeof numbers)
        {
            errno = size < 0 ? errno : EBADMSG;
            return false;
        }
        state_.position = {numbers[0], numbers[1], numbers[2]};
        state_.linear_velocity = {numbers[3], numbers[4], numbers[5]};
        state_.time = time;
        return true;
    }

    haptics::Capabilities capabilities_;
    haptics::DeviceState state_;
    std::uint16_t port_;
    int socket_ = -1;
};

#endif
