// A fast thin surface carries the proxy along: the search region includes the surface's next place.

#include "tests/haptics/contact/contact_fixture.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
/// A sheet comes from below, accelerates, and carries the proxy off the resting tool by several radii per tick.
TEST(CarriedProxy, StaysOnAThinSheetThatMovesByMoreThanTheProbesSizeInATick)
{
    constexpr double size = 0.003; // m; radius of the probe
    const OdeUse ode;
    ProbeWorld world;
    const OdeMesh mesh(sheet_mesh(0.4, 8));
    const dBodyID body = world.add_body(Vector3(0, 0, -0.02), 1);
    dBodySetKinematic(body);
    dGeomSetBody(mesh.add_to(world.space), body);
    dWorldSetGravity(world.world, 0, 0, 0);
    ScriptedDevice device([](double) { return Vector3(0.01, 0.02, 0); });
    HapticProbe probe(device, world.space, size, with_law(std::make_shared<ProxyLaw>(Material{10})));
    probe.sensor()->prepare_all();
    int carried = 0;
    for (int tick = 0; tick < 80; ++tick)
    {
        const double speed = std::min(22.0, 0.5 * tick); // m/s
        dBodySetLinearVel(body, 0, 0, speed);
        const double height = dBodyGetPosition(body)[2]; // m; at the tick
        world.run(probe, 1);
        const double depth = std::max(0.0, height + size);
        ASSERT_NEAR(probe.last_tick().requested.z(), 10 * depth, 0.02 * 10 * depth + 1e-9)
            << tick << " at " << speed << " m/s";
        carried += depth > 0 && speed > 20 ? 1 : 0;
    }
    EXPECT_GT(carried, 10);
}
} // namespace
} // namespace ode_predictive_space::haptics
