// 3D mice of 3Dconnexion, which spacenavd serves.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_SPACENAV_DEVICE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_SPACENAV_DEVICE_H

#include "ode_predictive_space/haptics/device.h"

#include <memory>

namespace ode_predictive_space::haptics
{
/// How the deflection of the cap moves the handle. All > 0, but dead_zone >= 0.
struct SpacenavSettings
{
    double speed = 0.1;            ///< m/s at full deflection
    double turn_rate = 1.0;        ///< rad/s at full deflection
    double dead_zone = 0.05;       ///< < 1; the part of full deflection, per axis, that counts as none
    double workspace_extent = 0.1; ///< m; the position stays within this far from the origin, per axis
};

/// A 3D mouse, through libspnav and a running spacenavd.
///
/// **This has never run on hardware.** It was tested against a stand-in for spacenavd only.
///
/// The cap's deflection is a rate: read() integrates it to a position, which starts at the origin and stops at the
/// workspace's walls, and to an orientation. A pause of more than `longest_step` between two reads counts as that.
/// There is no force: write() is accepted and ignored.
///
/// The environment variable SPNAV_SOCKET names another server than that at /var/run/spnav.sock. If it is set and does
/// not answer, open() fails; there is no falling back.
class SpacenavDevice final : public Device
{
public:
    static constexpr double longest_step = 0.05;   ///< s
    static constexpr double full_deflection = 350; ///< in the server's counts; what the mice tell at their stop

    /// @throws std::invalid_argument when a setting is out of its range.
    explicit SpacenavDevice(const SpacenavSettings &settings = {});
    ~SpacenavDevice() override;

    /// Does nothing when it is open. One device can be open at a time, because libspnav has one connection for the
    /// whole program.
    ///
    /// @throws DeviceError missing_library (this was built without libspnav), missing_file (no server at the socket),
    /// permission_denied (the socket's, libspnav's connection is taken, or SPNAV_SOCKET is set in a set-user-ID program),
    /// not_found (the server has no mouse), lost.
    void open() override;
    void close() noexcept override;
    const Capabilities &capabilities() const override { return capabilities_; }

    /// @throws DeviceError lost, also when a mouse is unplugged; until close().
    DeviceState read(double time) override;
    void write(const Wrench &wrench) override;
    DeviceStatus status() const override;

private:
    class Session;

    SpacenavSettings settings_;
    Capabilities capabilities_;
    std::unique_ptr<Session> session_;
};
} // namespace ode_predictive_space::haptics

#endif
