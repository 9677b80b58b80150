#include "ode_predictive_space/haptics/virtual_device.h"

#include "tests/haptics/support/constants.h"
#include "tests/support/error_of.h"

#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
namespace
{
Vector3 origin(double)
{
    return Vector3::Zero();
}

VirtualDeviceSettings free_mass()
{
    VirtualDeviceSettings settings;
    settings.hand = {0.2, 0, 0, 0};
    settings.encoder_step = 0;
    return settings;
}

class PressedWall
{
public:
    PressedWall(const VirtualDeviceSettings &settings, double stiffness)
        : device_(settings, [](double) { return Vector3(-0.01, 0, 0); }), stiffness_(stiffness)
    {
        device_.open();
    }

    /// m; largest less smallest position of the handle in the next `ticks` ticks.
    double swing(int ticks)
    {
        double least = infinity;
        double largest = -least;
        for (int i = 0; i < ticks; ++i)
        {
            const DeviceState state = device_.read(dt * ++tick_);
            device_.write({Vector3(std::max(0.0, -stiffness_ * state.position.x()), 0, 0), Vector3::Zero()});
            least = std::min(least, device_.true_position().x());
            largest = std::max(largest, device_.true_position().x());
        }
        return largest - least;
    }

private:
    VirtualDevice device_;
    double stiffness_;
    int tick_ = 0;
};

VirtualDeviceSettings delayed()
{
    VirtualDeviceSettings settings;
    settings.capabilities = device_preset("omega.3");
    settings.position_delay = 1;
    settings.force_delay = 1;
    return settings;
}

TEST(VirtualDevice, EveryPresetHoldsItsOwnStiffnessAtOneKilohertz)
{
    for (const Capabilities &preset : device_presets())
    {
        VirtualDeviceSettings settings;
        settings.capabilities = preset;
        PressedWall wall(settings, preset.max_stiffness);
        wall.swing(3000);
        EXPECT_LE(wall.swing(1000), 2 * settings.encoder_step) << preset.name;
    }
}

TEST(VirtualDevice, OscillatesExactlyHoweverOftenItIsRead)
{
    VirtualDeviceSettings settings = free_mass();
    settings.hand = {0.1, 0.4, 250, 0.6}; // m x'' + c x' + k x = 0 once the force ends
    for (const double period : {0.0005, 0.001, 0.0137})
    {
        VirtualDevice device(settings, origin);
        device.open();
        device.read(0);
        device.write({Vector3(2.5, 0, 0), Vector3::Zero()});
        device.read(20);
        ASSERT_NEAR(device.true_position().x(), 0.01, 1e-12);
        device.write(Wrench());
        const double decay = 1.0 / (2 * 0.1);
        const double turn_rate = std::sqrt(250 / 0.1 - decay * decay);
        for (double time = period; time < 0.5; time += period)
        {
            const double truth = 0.01 * std::exp(-decay * time) *
                                 (std::cos(turn_rate * time) + decay / turn_rate * std::sin(turn_rate * time));
            ASSERT_NEAR(device.read(20 + time).position.x(), truth, 1e-11) << "every " << period << " s";
        }
    }
}

TEST(VirtualDevice, IsDrawnByATargetThatMovesAsTheEquationsSay)
{
    for (const double grip_damping : {0.0, 2.0})
    {
        VirtualDeviceSettings settings = free_mass();
        settings.hand = {0.1, 0, 250, grip_damping};
        VirtualDevice device(settings, [](double seconds) { return Vector3(0.3 * seconds, 0, 0); });
        device.open();
        const double decay = grip_damping / (2 * 0.1);
        const double turn_rate = std::sqrt(250 / 0.1 - decay * decay);
        for (int i = 0; i < 500; ++i)
        {
            const double time = i * dt;
            const double truth = 0.3 * (time - std::exp(-decay * time) * std::sin(turn_rate * time) / turn_rate);
            ASSERT_NEAR(device.read(time).position.x(), truth, 1e-11) << "at " << time << " s";
        }
    }
}

TEST(VirtualDevice, TellsWholeEncoderSteps)
{
    VirtualDeviceSettings settings;
    settings.encoder_step = 0.001;
    VirtualDevice device(settings, [](double seconds) { return Vector3(0.01 * seconds, 0.0004, -0.0006); });
    device.open();
    for (int i = 0; i < 1000; ++i)
    {
        const Vector3 steps = device.read(i * dt).position / settings.encoder_step;
        ASSERT_NEAR(steps.x(), std::round(steps.x()), 1e-9);
        ASSERT_LE(std::abs(steps.x() - device.true_position().x() / settings.encoder_step), 0.5 + 1e-9);
        ASSERT_EQ(steps.y(), 0);
        ASSERT_NEAR(steps.z(), -1, 1e-9);
    }
}

TEST(VirtualDevice, VelocityIsThatOfTheToldPositionsFiltered)
{
    VirtualDeviceSettings settings;
    VirtualDevice device(settings, [](double seconds) { return Vector3(0.1 * seconds, 0, 0); });
    device.open();
    double mean = 0;
    for (int i = 0; i < 2000; ++i)
    {
        const double velocity = device.read(i * dt).linear_velocity.x();
        mean += i >= 1000 ? velocity / 1000 : 0;
        // Unfiltered, one encoder step in a tick would be 0.03 m/s.
        ASSERT_TRUE(i < 1000 || std::abs(velocity - 0.1) < 0.015) << velocity;
    }
    EXPECT_NEAR(mean, 0.1, 1e-4);
}

TEST(VirtualDevice, PositionsComeLateByTheirDelay)
{
    const auto target = [](double seconds) { return Vector3(0.05 * std::sin(5 * seconds), 0, 0); };
    VirtualDeviceSettings late;
    late.position_delay = 3;
    VirtualDevice prompt({}, target);
    VirtualDevice device(late, target);
    prompt.open();
    device.open();
    std::vector<DeviceState> states;
    for (int i = 0; i < 500; ++i)
    {
        states.push_back(prompt.read(i * dt));
        const DeviceState state = device.read(i * dt);
        const DeviceState &truth = states[static_cast<std::size_t>(std::max(0, i - 3))];
        ASSERT_EQ(state.position, truth.position);
        ASSERT_EQ(state.linear_velocity, truth.linear_velocity);
        ASSERT_EQ(state.time, i * dt);
    }
}

TEST(VirtualDevice, ForcesComeLateByTheirDelay)
{
    VirtualDeviceSettings settings = free_mass();
    settings.force_delay = 2;
    VirtualDevice device(settings, origin);
    device.open();
    device.read(0);
    device.write({Vector3(1, 0, 0), Vector3::Zero()}); // stays until the next write
    EXPECT_EQ(device.read(1 * dt).position.x(), 0);
    EXPECT_EQ(device.read(2 * dt).position.x(), 0);
    EXPECT_EQ(device.rendered_force().x(), 1);
    EXPECT_GT(device.read(3 * dt).position.x(), 0);
    device.write(Wrench());
    device.read(4 * dt);
    EXPECT_EQ(device.rendered_force().x(), 1);
    device.read(5 * dt);
    EXPECT_EQ(device.rendered_force().x(), 0);
}

TEST(VirtualDevice, TellsTheLongerDelayOfItsTicksAndItsCapabilities)
{
    VirtualDeviceSettings settings = delayed();
    settings.capabilities.delay = 0.004;
    EXPECT_EQ(VirtualDevice(settings, origin).capabilities().delay, 0.004);
    settings.force_delay = 7;
    EXPECT_EQ(VirtualDevice(settings, origin).capabilities().delay, 0.008);
}

TEST(VirtualDevice, MotorsRenderNoMoreThanTheyCan)
{
    VirtualDevice device({}, origin);
    device.open();
    device.read(0);
    device.write({Vector3(30, 40, 0), Vector3::Zero()});
    EXPECT_LT((device.rendered_force() - 7.9 * Vector3(0.6, 0.8, 0)).norm(), 1e-12);
    EXPECT_EQ(device.last_wrench().force, Vector3(30, 40, 0));
}

TEST(VirtualDevice, AForceThatIsNotFiniteIsRefusedAndEnds)
{
    VirtualDevice device({}, origin);
    device.open();
    device.read(0);
    device.write({Vector3(1, 0, 0), Vector3::Zero()});
    EXPECT_THROW(device.write({Vector3(std::nan(""), 0, 0), Vector3::Zero()}), DeviceError);
    EXPECT_EQ(device.rendered_force(), Vector3::Zero());
    EXPECT_EQ(device.last_wrench().force, Vector3::Zero());
    EXPECT_TRUE(device.read(dt).position.allFinite());
}

TEST(VirtualDevice, SameCallsSameStates)
{
    const auto run = [](VirtualDevice &device) {
        std::vector<Vector3> states;
        device.open();
        for (int i = 0; i < 300; ++i)
        {
            const DeviceState state = device.read(i * dt);
            device.write({-200 * state.position - 3 * state.linear_velocity, Vector3::Zero()});
            states.push_back(state.position);
            states.push_back(state.linear_velocity);
        }
        device.close();
        return states;
    };
    const auto target = [](double seconds) { return Vector3(0.05 * std::sin(9 * seconds), seconds * 0.01, 0); };
    VirtualDevice first(delayed(), target);
    VirtualDevice second(delayed(), target);
    const std::vector<Vector3> states = run(first);
    EXPECT_EQ(run(second), states);
    EXPECT_EQ(run(first), states) << "after it was closed and opened again";
}

TEST(VirtualDevice, RefusesSettingsThatCannotBeMeant)
{
    const auto refused = [](auto change) {
        VirtualDeviceSettings settings;
        change(settings);
        EXPECT_THROW(VirtualDevice(settings, origin), std::invalid_argument);
    };
    refused([](VirtualDeviceSettings &s) { s.hand.mass = 0; });
    refused([](VirtualDeviceSettings &s) { s.hand.damping = -1; });
    refused([](VirtualDeviceSettings &s) { s.hand.grip_stiffness = std::nan(""); });
    refused([](VirtualDeviceSettings &s) { s.hand.grip_damping = -1; });
    refused([](VirtualDeviceSettings &s) { s.encoder_step = -1; });
    refused([](VirtualDeviceSettings &s) { s.velocity_cutoff = 0; });
    refused([](VirtualDeviceSettings &s) { s.force_delay = -1; });
    refused([](VirtualDeviceSettings &s) { s.position_delay = -1; });
    EXPECT_THROW(VirtualDevice({}, nullptr), std::invalid_argument);
}

TEST(VirtualDevice, PresetsAreFoundByName)
{
    EXPECT_EQ(device_presets().size(), 5u);
    EXPECT_EQ(device_preset("Falcon").max_stiffness, 3000);
    EXPECT_EQ(device_preset("omega.3").workspace.max().x(), 0.075);
    const std::string sentence = error_of<std::invalid_argument>([] { device_preset("omega.9"); }).what();
    EXPECT_NE(sentence.find("omega.9"), std::string::npos);
    EXPECT_NE(sentence.find("PHANToM Desktop"), std::string::npos);
}
} // namespace
} // namespace ode_predictive_space::haptics
