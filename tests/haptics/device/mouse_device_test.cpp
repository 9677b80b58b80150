#include "ode_predictive_space/haptics/mouse_device.h"

#include "tests/haptics/support/constants.h"

#include <gtest/gtest.h>
#include <thread>

namespace ode_predictive_space::haptics
{
namespace
{
DeviceState rest(MouseDevice &device, double &time)
{
    time += 1;
    return device.read(time);
}

TEST(MouseDevice, GoesWhereThePointerAndTheWheelGo)
{
    MouseSettings settings;
    settings.metres_per_pixel = 0.001;
    settings.metres_per_wheel_step = 0.01;
    MouseDevice device(settings);
    device.open();
    double time = 0;
    EXPECT_EQ(device.read(time).position, Vector3::Zero());
    device.pointer(20, 30);
    device.pointer(10, 0);
    device.wheel(2);
    const DeviceState state = rest(device, time);
    EXPECT_LT((state.position - Vector3(0.03, -0.03, -0.02)).norm(), 1e-12) << "right, down, away";
    EXPECT_LT(state.linear_velocity.norm(), 1e-12);
}

TEST(MouseDevice, ButtonsAreBits)
{
    MouseDevice device;
    device.open();
    EXPECT_EQ(device.read(0).buttons, 0u);
    device.button(0, true);
    device.button(31, true);
    EXPECT_EQ(device.read(dt).buttons, 0x80000001u);
    device.button(0, false);
    device.button(32, true);
    device.button(-1, true);
    EXPECT_EQ(device.read(2 * dt).buttons, 0x80000000u);
}

TEST(MouseDevice, StaysInItsWorkspaceAndComesBackAtOnce)
{
    MouseSettings settings;
    MouseDevice device(settings);
    device.open();
    double time = 0;
    device.read(time);
    for (int i = 0; i < 5000; ++i)
    {
        device.pointer(i % 1000 < 500 ? 100 : -100, 37);
        device.wheel(-3);
        time += dt;
        ASSERT_TRUE(settings.workspace.contains(device.read(time).position));
    }
    EXPECT_NEAR(rest(device, time).position.z(), 0.1, 1e-12);
    device.wheel(4);
    EXPECT_NEAR(rest(device, time).position.z(), 0.08, 1e-12) << "what led out was lost";
    device.pointer(std::nan(""), infinity);
    EXPECT_TRUE(rest(device, time).position.allFinite());
}

// The pointer moves evenly at 0.1 m/s, in events at 60 Hz.
TEST(MouseDevice, MakesASmoothMotionOfEvents)
{
    MouseSettings settings;
    MouseDevice device(settings);
    device.open();
    const double pixels = 0.1 / 60 / settings.metres_per_pixel;
    Vector3 last = device.read(0).position;
    Vector3 last_velocity = Vector3::Zero();
    int events = 0;
    for (int i = 1; i <= 900; ++i)
    {
        const double time = i * dt;
        for (; events < 60 * time; ++events)
            device.pointer(pixels, 0);
        const DeviceState state = device.read(time);
        ASSERT_LT((state.position - last).norm(), 0.2 * dt) << "no steps, at " << time << " s";
        ASSERT_LT((state.linear_velocity - last_velocity).norm(), 0.01) << "nor of the velocity";
        ASSERT_LT(((state.position - last) / dt - (state.linear_velocity + last_velocity) / 2).norm(), 0.001);
        ASSERT_TRUE(i < 200 || std::abs(state.linear_velocity.x() - 0.1) < 0.03) << state.linear_velocity.x();
        last = state.position;
        last_velocity = state.linear_velocity;
    }
}

TEST(MouseDevice, MovesAlikeHoweverOftenItIsRead)
{
    MouseDevice often;
    MouseDevice seldom;
    for (MouseDevice *device : {&often, &seldom})
    {
        device->open();
        device->read(0);
        device->pointer(100, -50);
    }
    for (int i = 1; i <= 30; ++i)
        often.read(i * dt);
    EXPECT_LT((often.read(0.031).position - seldom.read(0.031).position).norm(), 1e-15);
    EXPECT_LT((often.read(0.032).linear_velocity - seldom.read(0.032).linear_velocity).norm(), 1e-13);
}

TEST(MouseDevice, TakesEventsFromAnotherThread)
{
    MouseSettings settings;
    settings.metres_per_pixel = 0.00001;
    MouseDevice device(settings);
    device.open();
    double time = 0;
    device.read(time);
    std::atomic<bool> done{false};
    std::thread window([&] {
        for (int i = 0; i < 4000; ++i)
        {
            device.pointer(1, 2);
            device.button(i % 32, true);
        }
        done = true;
    });
    while (!done)
    {
        time += dt;
        EXPECT_TRUE(device.read(time).position.allFinite());
    }
    window.join();
    const DeviceState state = rest(device, time);
    EXPECT_LT((state.position - Vector3(0.04, -0.08, 0)).norm(), 1e-9) << "no event is lost";
    EXPECT_EQ(state.buttons, 0xffffffffu);
}

TEST(MouseDevice, BeginsInTheMiddle)
{
    MouseSettings settings;
    settings.workspace = {Vector3(0, 0, 0), Vector3(0.2, 0.4, 0.6)};
    MouseDevice device(settings);
    device.open();
    EXPECT_EQ(device.read(0).position, Vector3(0.1, 0.2, 0.3));
    device.pointer(10, 10);
    device.button(3, true);
    device.read(1);
    device.close();
    device.open();
    device.pointer(10, 10);
    const DeviceState state = device.read(2);
    EXPECT_LT((state.position - Vector3(0.1, 0.2, 0.3)).norm(), 1e-12);
    EXPECT_EQ(state.buttons, 0u);
    EXPECT_EQ(device.capabilities().force_axes, 0);
    EXPECT_EQ(device.capabilities().workspace.max(), Vector3(0.2, 0.4, 0.6));
}

TEST(MouseDevice, RefusesSettingsThatCannotBeMeant)
{
    const auto refused = [](auto change) {
        MouseSettings settings;
        change(settings);
        EXPECT_THROW(MouseDevice{settings}, std::invalid_argument);
    };
    refused([](MouseSettings &s) { s.metres_per_pixel = 0; });
    refused([](MouseSettings &s) { s.metres_per_wheel_step = std::nan(""); });
    refused([](MouseSettings &s) { s.smoothing = -1; });
    refused([](MouseSettings &s) { s.workspace.max().y() = s.workspace.min().y(); });
}
} // namespace
} // namespace ode_predictive_space::haptics
