// The cost of a tick is bounded by counts, however rough and dense a mesh is.

#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "tests/haptics/contact/contact_fixture.h"
#include "tests/haptics/contact/scrubbing.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
/// The meshes are as dense as scans. Sanitizers do not reduce the ticks, so that the hand has time to arrive.
TEST(ScrubbingTest, KeepsTheBudgetInEachTick)
{
    for (const int rings : {112, 250})
        expect_budget_kept(rings, 1500);
}

/// Some 25,000 triangles are as near to the probe as its place of contact: more than a tick may visit.
TEST(SlideBudgetTest, LetsTheProxyArriveOnADenseMesh)
{
    const OdeUse ode;
    for (const double size : {0.001, 0.003, 0.01})
    {
        ProbeWorld world;
        const OdeMesh mesh(sheet_mesh(2 * size, 300));
        mesh.add_to(world.space);
        const Vector3 above(0.1 * size, 0.1 * size, 2 * size), in(0.1 * size, 0.1 * size, 0.5 * size),
            along(0.6 * size, 0.3 * size, 0.5 * size);
        ScriptedDevice device([=](double seconds) {
            return seconds < 1 ? between(above, in, 0.1, 0.4, seconds) : between(in, along, 1, 0.4, seconds);
        });
        HapticProbe probe(device, world.space, size, with_law(std::make_shared<ProxyLaw>(Material{k})));
        probe.sensor()->prepare_all();
        std::size_t most = 0;
        probe.set_recorder([&](const RenderedTick &) { most = std::max(most, probe.sensor()->tracker()->visited()); });
        for (int part = 0; part < 2; ++part)
        {
            world.run(probe, 1000);
            EXPECT_LE((probe.last_tick().requested - Vector3(0, 0, 0.5 * size * k)).norm(), 1e-6)
                << size << ' ' << part;
        }
        EXPECT_GT(most, SphereSlide::most_triangles / 8) << size;
        EXPECT_LE(most, SphereSlide::most_triangles) << size;
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
