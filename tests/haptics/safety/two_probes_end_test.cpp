// Programs with two probes or with their own handlers end without a force, and do not hang.

#include "ode_predictive_space/haptics/safety/active_run.h"

#include "tests/haptics/safety/program_end_fixture.h"
#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/probe_world.h"

#include <exception>
#include <memory>
#include <mutex>

namespace ode_predictive_space::haptics
{
namespace
{
class LeaningProbe
{
public:
    LeaningProbe(Device &device, const SharedForce &force) : force_(force)
    {
        dCreatePlane(world_.space, 0, 0, 1, 0);
        RenderSettings settings;
        settings.safety = SafetyLimits::of(desktop_capabilities());
        settings.safety->ramp_time = 0;
        probe_ = std::make_unique<HapticProbe>(device, world_.space, radius, settings);
    }

    void press()
    {
        while (force_.now <= present_force)
            world_.run(*probe_, 1);
    }

    HapticProbe &probe() { return *probe_; }
    ProbeWorld &world() { return world_; }

private:
    const SharedForce &force_;
    ProbeWorld world_;
    std::unique_ptr<HapticProbe> probe_;
};

class SecondProbeEnds : public ProgramEnds
{
protected:
    ProgramEnd end_after_pressing(const std::function<void(LeaningProbe &first, Device &device)> &end)
    {
        return end_of_pressing([&] {
            const OdeUse ode;
            SharedDevice device(force_);
            LeaningProbe first(device, force_);
            first.press();
            end(first, device);
        });
    }
};

TEST_F(SecondProbeEnds, OnOneDeviceItEndsAProgramThatDoesNotCatchThat)
{
    const ProgramEnd end = end_after_pressing(
        [](LeaningProbe &first, Device &device) { const HapticProbe second(device, first.world().space, radius); });
    expect_abort(end);
    EXPECT_TRUE(end.says("Another probe renders to this device")) << end.messages;
    expect_zero();
}

TEST_F(SecondProbeEnds, CaughtItLeavesTheFirstAloneAndStillGuarded)
{
    const ProgramEnd end = end_after_pressing([&](LeaningProbe &first, Device &device) {
        EXPECT_THROW(HapticProbe(device, first.world().space, radius), std::logic_error);
        first.press();
        std::exit(force_.now > present_force ? 3 : 4);
    });
    EXPECT_TRUE(end.exited_with(3)) << end.messages;
    expect_zero();
}

class TwoProbesEnd : public ProgramEnds, public testing::WithParamInterface<int>
{};

INSTANTIATE_TEST_SUITE_P(Order, TwoProbesEnd, testing::Values(0, 1));

TEST_P(TwoProbesEnd, InEachOrderNoForceIsLeft)
{
    for (const bool by_abort : {true, false})
    {
        const ProgramEnd end = end_of_pressing([&] {
            const OdeUse ode;
            SharedDevice devices[] = {SharedDevice(force_), SharedDevice(second_force_)};
            std::unique_ptr<LeaningProbe> probes[] = {std::make_unique<LeaningProbe>(devices[0], force_),
                                                      std::make_unique<LeaningProbe>(devices[1], second_force_)};
            probes[0]->press();
            probes[1]->press();
            probes[GetParam()].reset();
            by_abort ? std::abort() : std::exit(3);
        });
        EXPECT_TRUE(by_abort ? end.died_of(SIGABRT) : end.exited_with(3)) << end.messages;
        expect_zero(force_);
        expect_zero(second_force_);
    }
}

TEST_P(TwoProbesEnd, OneDriverThatEndsTheProgramAgainDoesNotKeepTheOthersForce)
{
    const ProgramEnd end = end_of_pressing([&] {
        const OdeUse ode;
        SharedDevice devices[] = {SharedDevice(force_), SharedDevice(second_force_)};
        LeaningProbe first(devices[0], force_);
        LeaningProbe second(devices[1], second_force_);
        first.press();
        second.press();
        devices[GetParam()].after_write = [] { std::terminate(); };
        std::terminate();
    });
    EXPECT_TRUE(end.died_of(SIGABRT)) << end.messages;
    expect_zero(force_);
    expect_zero(second_force_);
}

/// A device that guards its state with a lock, as many do.
class LockedDevice : public SharedDevice
{
public:
    using SharedDevice::SharedDevice;

    DeviceState read(double time) override
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        return SharedDevice::read(time);
    }

    void write(const Wrench &wrench) override
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        SharedDevice::write(wrench);
    }

private:
    std::mutex mutex_;
};

using DriverEnds = ProgramEnds;

TEST_F(DriverEnds, WithItsLockHeldTheProgramEndsAllTheSameAndSaysWhatIsLeft)
{
    const ProgramEnd end = end_of_pressing([&] {
        const OdeUse ode;
        LockedDevice device(force_);
        LeaningProbe first(device, force_);
        first.press();
        device.before_read = [] { std::abort(); };
        first.world().run(first.probe(), 1);
    });
    EXPECT_FALSE(end.hung);
    EXPECT_TRUE(end.says("hangs in the device's driver")) << end.messages;
}

HapticProbe *probe_of_handler = nullptr;

using HandlerEnds = SecondProbeEnds;

TEST_F(HandlerEnds, MayUseAProbeThatHasThrown)
{
    const ProgramEnd end = end_after_pressing([](LeaningProbe &first, Device &) {
        probe_of_handler = &first.probe();
        std::set_terminate([] {
            probe_of_handler->is_taken();
            std::abort();
        });
        first.probe().take(std::make_shared<ActiveRun>());
        first.probe().take(std::make_shared<ActiveRun>());
    });
    expect_abort(end);
    expect_zero();
}
} // namespace
} // namespace ode_predictive_space::haptics
