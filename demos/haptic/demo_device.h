#ifndef ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_DEMO_DEVICE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_HAPTIC_DEMO_DEVICE_H

#include "ode_predictive_space/haptics/device.h"

#include <atomic>
#include <memory>

namespace ode_predictive_space::demo
{
/// The number of the button that moves the workspace instead of the probe. No device has that many buttons.
constexpr unsigned clutch_button = 31;

/// Passes all calls on, and reports the clutch's button as held while hold_clutch() says so.
class DemoDevice : public haptics::Device
{
public:
    explicit DemoDevice(std::unique_ptr<haptics::Device> device) : device_(std::move(device)) {}

    /// Any thread may call this.
    void hold_clutch(bool held) { clutch_.store(held, std::memory_order_relaxed); }
    bool clutch_held() const { return clutch_.load(std::memory_order_relaxed); }

    haptics::Device &inner() { return *device_; }

    void open() override { device_->open(); }
    void close() noexcept override { device_->close(); }
    const haptics::Capabilities &capabilities() const override { return device_->capabilities(); }
    haptics::DeviceState read(double time) override
    {
        haptics::DeviceState state = device_->read(time);
        if (clutch_held())
            state.buttons |= 1u << clutch_button;
        return state;
    }
    void write(const haptics::Wrench &wrench) override { device_->write(wrench); }
    haptics::DeviceStatus status() const override { return device_->status(); }

private:
    std::unique_ptr<haptics::Device> device_;
    std::atomic<bool> clutch_{false};
};
} // namespace ode_predictive_space::demo

#endif
