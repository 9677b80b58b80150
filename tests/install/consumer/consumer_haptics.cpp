// An independent haptic program: a hand presses on a still ball for half a second.

#include <cstdio>

#include <ode/ode.h>
#include <ode_predictive_space/haptics/loop.h>
#include <ode_predictive_space/haptics/virtual_device.h>

namespace haptics = ode_predictive_space::haptics;

namespace
{
haptics::HapticProbe *probe;

void near_callback(void *, dGeomID first, dGeomID second)
{
    probe->touch(first, second);
}

/// @return the force at the hand in the end, in N.
double press(dSpaceID space)
{
    haptics::VirtualDevice device({}, [](double seconds) { return haptics::Vector3(0, 0.03 - 0.1 * seconds, 0); });
    haptics::HapticProbe sphere(device, space, 0.01);
    probe = &sphere;

    haptics::SimulatedClock clock;
    haptics::LoopSettings settings;
    settings.duration = 0.5;
    settings.clock = &clock;
    haptics::HapticLoop loop(sphere, settings);
    const haptics::LoopReport report =
        loop.run({[&] { dSpaceCollide(space, nullptr, &near_callback); }, [](double) {}});
    std::printf("%d ticks\n", static_cast<int>(report.ticks));
    return loop.latest().force.y();
}
} // namespace

int main()
{
    dInitODE2(0);
    const dSpaceID space = dHashSpaceCreate(nullptr);
    dGeomSetPosition(dCreateSphere(space, 0.05), 0, -0.06, 0);
    const double force = press(space);
    dSpaceDestroy(space);
    dCloseODE();
    std::printf("%.2f N\n", force);
    return force > 1 && force < 7.9 ? 0 : 1;
}
