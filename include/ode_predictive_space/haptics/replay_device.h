// A recorded run as a device.

#ifndef ODE_PREDICTIVE_SPACE_HAPTICS_REPLAY_DEVICE_H
#define ODE_PREDICTIVE_SPACE_HAPTICS_REPLAY_DEVICE_H

#include "ode_predictive_space/haptics/recording.h"
#include "ode_predictive_space/haptics/software_device.h"

namespace ode_predictive_space::haptics
{
/// The handle moves as in the recording, from its first tick on; the loop's clock need not show the same time.
///
/// At recorded times, within a nanosecond, the states are those recorded, bit by bit: a loop that reads at the same times
/// gets the same input. In between, positions follow the cubic Hermite curve and orientations the great arc between two
/// ticks, so that nothing jumps at any rate. Velocities are those recorded, or, where there are none, those of parabolas
/// through three ticks; in between, the linear velocity is the derivative of the curve, and the angular velocity changes
/// evenly. Buttons are those of the tick before.
///
/// A gap of more than 0.25 s is crossed on a straight line, from rest to rest. The capabilities are those of the device that was
/// recorded, if the file tells.
///
/// After the last tick the handle rests where it is; status() is then not ready and says why. Forces are accepted and have
/// no effect.
class ReplayDevice : public SoftwareDevice
{
public:
    /// The file is read by open(), which throws what read_recording() throws.
    explicit ReplayDevice(const std::string &file);

    /// Replay a run that is already there.
    ///
    /// @throws std::invalid_argument when it has no ticks.
    explicit ReplayDevice(Recording recording);

    /// With the velocities that it is replayed with. Empty before the first open() of a file.
    const Recording &recording() const { return recording_; }

protected:
    void start() override;
    DeviceState move_to(double seconds) override;
    std::string idle_reason() const override;

private:
    void take_in(Recording recording);
    double seconds_at(std::size_t tick) const;
    DeviceState between(double seconds) const;

    std::string file_; ///< empty when there is none
    Recording recording_;
    std::size_t tick_ = 0; ///< the last one that was reached
    bool ended_ = false;
};
} // namespace ode_predictive_space::haptics

#endif
