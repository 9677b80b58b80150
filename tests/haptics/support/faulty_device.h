// A device that passes all calls to another one, which must outlive it, until it breaks on demand.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_FAULTY_DEVICE_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_FAULTY_DEVICE_H

#include "ode_predictive_space/haptics/device.h"

#include <atomic>
#include <limits>

namespace ode_predictive_space::haptics
{
enum class Breakage
{
    none,
    lost,             ///< read() and write() throw `lost`, as after the plug was pulled
    unreadable,       ///< read() throws `failed`; write() works
    unwritable,       ///< write() throws `failed`; read() works
    not_a_number,     ///< the position is not a number
    endless_velocity, ///< the velocity is infinite
    stalled           ///< read() repeats the last state, with its time
};

class FaultyDevice : public Device
{
public:
    explicit FaultyDevice(Device &device) : device_(device) {}

    /// Breaks at the read() at `time` (s, on the loop's clock), until `mended`.
    void break_at(double time, Breakage breakage, double mended = std::numeric_limits<double>::infinity())
    {
        breakage_ = breakage;
        broken_from_ = time;
        mended_ = mended;
    }

    /// Breaks (or mends, with Breakage::none) at the next read() or write(). Any thread may call this.
    void break_now(Breakage breakage) { sudden_ = breakage; }

    void open() override { device_.open(); }
    void close() noexcept override
    {
        device_.close();
        last_ = Wrench();
    }
    const Capabilities &capabilities() const override { return device_.capabilities(); }

    DeviceState read(double time) override
    {
        now_ = time;
        const Breakage breakage = current();
        if (breakage == Breakage::lost)
            throw DeviceError(DeviceFault::lost, "faulty device: the plug has been pulled");
        if (breakage == Breakage::unreadable)
            throw DeviceError(DeviceFault::failed, "faulty device: it cannot be read");
        const DeviceState state = device_.read(time);
        if (breakage != Breakage::stalled)
            whole_ = state;
        return spoil(breakage == Breakage::stalled ? whole_ : state, breakage);
    }

    void write(const Wrench &wrench) override
    {
        const Breakage breakage = current();
        if (breakage == Breakage::lost)
            throw DeviceError(DeviceFault::lost, "faulty device: the plug has been pulled");
        if (breakage == Breakage::unwritable)
            throw DeviceError(DeviceFault::failed, "faulty device: it cannot be written");
        device_.write(wrench);
        last_ = wrench;
        ++writes_;
    }

    DeviceStatus status() const override
    {
        const bool broken = current() != Breakage::none;
        return broken ? DeviceStatus{true, false, "faulty device: it is broken"} : device_.status();
    }

    const Wrench &last_wrench() const { return last_; } ///< that reached the device; zero after close()
    int writes() const { return writes_; }              ///< that reached the device

private:
    Breakage current() const
    {
        const Breakage sudden = sudden_;
        if (sudden != Breakage::none)
            return sudden;
        return now_ >= broken_from_ && now_ < mended_ ? breakage_ : Breakage::none;
    }

    static DeviceState spoil(DeviceState state, Breakage breakage)
    {
        if (breakage == Breakage::not_a_number)
            state.position.setConstant(std::numeric_limits<double>::quiet_NaN());
        if (breakage == Breakage::endless_velocity)
            state.linear_velocity.setConstant(std::numeric_limits<double>::infinity());
        return state;
    }

    Device &device_;
    Breakage breakage_ = Breakage::none;
    double broken_from_ = std::numeric_limits<double>::infinity();
    double mended_ = std::numeric_limits<double>::infinity();
    std::atomic<Breakage> sudden_{Breakage::none};
    double now_ = 0; ///< s; of the last read()
    DeviceState whole_;
    Wrench last_;
    int writes_ = 0;
};
} // namespace ode_predictive_space::haptics

#endif
