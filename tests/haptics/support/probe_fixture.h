#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_PROBE_FIXTURE_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_PROBE_FIXTURE_H

#include "tests/haptics/support/constants.h"
#include "tests/haptics/support/probe_world.h"
#include "tests/haptics/support/scripted_device.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace ode_predictive_space::haptics
{
/// A minimum-jerk path of half a second, after one second of rest in which forces ramp in.
inline ScriptedDevice::Path reach(const Vector3 &from, const Vector3 &to)
{
    return [from, to](double seconds) -> Vector3 {
        const double u = std::clamp((seconds - 1) / 0.5, 0.0, 1.0);
        return from + u * u * u * (10 + u * (-15 + 6 * u)) * (to - from);
    };
}

constexpr int reach_ticks = 1600; // the whole path, and some rest

class HapticProbeTest : public testing::Test
{
protected:
    const OdeUse ode_;
};

enum class Shape
{
    plane,
    sphere,
    box
};

/// Adds a shape whose surface is at z = 0 below the probe, with the normal z.
inline dGeomID add_shape(ProbeWorld &world, Shape shape)
{
    if (shape == Shape::plane)
        return dCreatePlane(world.space, 0, 0, 1, 0);
    if (shape == Shape::sphere)
    {
        const dGeomID sphere = dCreateSphere(world.space, 0.3);
        dGeomSetPosition(sphere, 0, 0, -0.3);
        return sphere;
    }
    return world.add_box({0.4, 0.6, 0.2}, {0.05, -0.1, -0.1});
}

/// N s; the impulse on the hand in these ticks.
inline Vector3 impulse_on_hand(ProbeWorld &world, HapticProbe &probe, int ticks)
{
    Vector3 impulse = Vector3::Zero();
    probe.set_recorder([&](const RenderedTick &tick) { impulse += dt * tick.wrench.force; });
    world.run(probe, ticks);
    probe.set_recorder({});
    return impulse;
}
} // namespace ode_predictive_space::haptics

#endif
