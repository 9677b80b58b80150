// Under a light grip, each known device comes to rest on a wall with the default law.

#include "ode_predictive_space/haptics/probe.h"
#include "ode_predictive_space/haptics/virtual_device.h"

#include "tests/haptics/support/probe_fixture.h"

namespace ode_predictive_space::haptics
{
namespace
{
using LightGrip = HapticProbeTest;

/// N; range of the force from 4 s to 6 s.
double swing_on_wall(const std::string &device_name, double press, double rate)
{
    ProbeWorld world;
    world.add_box({0.1, 1, 1}, {0.05 + radius, 0, 0});
    VirtualDeviceSettings settings;
    settings.capabilities = device_preset(device_name);
    settings.hand = {0.08, 0.2, 60, 0.6};
    VirtualDevice device(settings, [press](double seconds) -> Vector3 {
        return {std::clamp(0.1 * (seconds - 1), 0.0, press), 0, 0};
    });
    RenderSettings rendering;
    rendering.rate = rate;
    rendering.physics_rate = rate;
    HapticProbe probe(device, world.space, radius, rendering);
    double least = infinity;
    double most = -infinity;
    probe.set_recorder([&](const RenderedTick &tick) {
        if (tick.time < 4)
            return;
        least = std::min(least, tick.force.x());
        most = std::max(most, tick.force.x());
    });
    world.run(probe, static_cast<int>(6 * rate), 1 / rate);
    EXPECT_LT(least, -0.02) << device_name << ": it presses";
    return most - least;
}

TEST_F(LightGrip, ComesToRestOnAWallWithEachKnownDevice)
{
    for (const Capabilities &device : device_presets())
    {
        for (const double press : {0.001, 0.005, 0.02})
        {
            for (const double rate : {1000.0, 500.0})
                EXPECT_LT(swing_on_wall(device.name, press, rate), 0.1)
                    << device.name << ", " << press << " m, " << rate;
        }
    }
}

TEST_F(LightGrip, WhereTheDampingIsKnownTheDefaultLawGoesByThatAlone)
{
    ScriptedDevice device([](double) -> Vector3 { return Vector3::Zero(); }, device_preset("omega.3"));
    RenderSettings settings;
    settings.device_damping = 5;
    EXPECT_EQ(Renderer(device, settings).law().material().stiffness, 2500);
    settings.device_damping.reset();
    EXPECT_LT(Renderer(device, settings).law().material().stiffness, 1600);
}
} // namespace
} // namespace ode_predictive_space::haptics
