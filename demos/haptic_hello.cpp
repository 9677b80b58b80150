// A hand presses on a box for a second: it feels the force, and the box gets the opposite one. Haptic lines are marked.
// With any argument, time is simulated: it passes as fast as possible, and each run is the same.

#include <algorithm>
#include <cstdio>
#include <ode/ode.h>
#include <ode_predictive_space/haptics/loop.h>
#include <ode_predictive_space/haptics/virtual_device.h>
#include <ode_predictive_space/predictive_space.h>

namespace haptics = ode_predictive_space::haptics;

namespace
{
dWorldID world;
dJointGroupID contacts;
haptics::HapticProbe *probe;

void near_callback(void *, dGeomID first, dGeomID second)
{
    if (probe->touch(first, second)) // haptic: contacts of the probe become a force
        return;
    dContact contact[4] = {};
    const int count = dCollide(first, second, 4, &contact[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i)
    {
        contact[i].surface.mu = 0.5;
        dJointAttach(dJointCreateContact(world, contacts, &contact[i]), dGeomGetBody(first), dGeomGetBody(second));
    }
}

void add_box(dSpaceID space)
{
    const dBodyID body = dBodyCreate(world);
    dMass mass;
    dMassSetBoxTotal(&mass, 1, 0.2, 0.2, 0.1);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, 0, 0, 0.05);
    dGeomSetBody(dCreateBox(space, 0.2, 0.2, 0.1), body);
}

/// The person's target for the handle: 10 cm down in 0.4 s, in the device's frame, whose y points up.
haptics::Vector3 target(double seconds)
{
    return {0, 0.05 - 0.1 * std::min(1.0, seconds / 0.4), 0};
}

void print_notice(const haptics::Notice &notice)
{
    std::printf("%s\n", notice.text.data());
}

/// @return whether the hand touches the box in the end.
bool press(dSpaceID space, haptics::LoopClock *clock)
{
    haptics::VirtualDevice device({}, &target); // haptic: a hand and a device, without hardware

    haptics::RenderSettings settings;
    settings.placement.rotation = haptics::WorkspacePlacement::z_up(); // haptic: up is z in the scene
    settings.placement.offset = {0, 0, 0.14}; // haptic: where the device's origin lies in it, m
    settings.notice = &print_notice;
    haptics::HapticProbe sphere(device, space, 0.01, settings); // haptic: a sphere of 1 cm that follows the hand
    probe = &sphere;

    haptics::LoopSettings loop_settings; // haptic: 1000 times a second
    loop_settings.duration = 1;
    loop_settings.clock = clock;
    haptics::HapticLoop loop(sphere, loop_settings);

    int ticks = 0;
    haptics::SceneWork work;
    work.collide = [&] { dSpaceCollide(space, nullptr, &near_callback); };
    work.advance = [&](double dt) {
        dWorldQuickStep(world, dt);
        dJointGroupEmpty(contacts);
        if (++ticks % 100 == 0)
            std::printf("%.1f s: the probe at %.4f m %s, the force is %.2f N\n", ticks * dt, sphere.tool().position.z(),
                        sphere.touches().empty() ? "touches nothing" : "touches the box", sphere.last_tick().force.z());
    };
    const haptics::LoopReport report = loop.run(work);
    std::printf("%d ticks at %.0f Hz, %d late\n", static_cast<int>(report.ticks), report.rate,
                static_cast<int>(report.overruns));
    return !sphere.touches().empty();
}
} // namespace

int main(int count, char **)
{
    dInitODE2(0);
    world = dWorldCreate();
    dWorldSetGravity(world, 0, 0, -9.81);
    contacts = dJointGroupCreate(0);
    dSpaceID space = dPredictiveSpaceCreate(nullptr); // or any other
    dCreatePlane(space, 0, 0, 1, 0);
    add_box(space);

    haptics::SimulatedClock simulated;
    const bool touched = press(space, count > 1 ? &simulated : nullptr);

    dJointGroupDestroy(contacts);
    dSpaceDestroy(space);
    dWorldDestroy(world);
    dCloseODE();
    return touched ? 0 : 1;
}
