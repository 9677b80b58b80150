// Ten minutes of scrubbing over each of three meshes as rough as scans.

#include "tests/haptics/contact/contact_fixture.h"
#include "tests/haptics/contact/scrubbing.h"

namespace ode_predictive_space::haptics
{
namespace
{
TEST(LongScrubbingTest, KeepsTheBudgetInEachTick)
{
    const OdeUse ode;
    for (const int rings : {112, 320, 570}) // 50,000 to 1.3 million triangles
    {
        const ProbeWorld world;
        const OdeMesh mesh(scanned_ball(rings));
        mesh.add_to(world.space);
        for (const double size : {0.001, 0.003, 0.01})
        {
            constexpr int ticks = 200000;
            const ScrubbingResult result = scrub(world.space, size, ticks);
            EXPECT_LE(result.most_triangles, SphereSlide::most_triangles) << rings << " rings, " << size << " m";
            EXPECT_GT(result.pressed, ticks / 8) << rings << " rings, " << size << " m";
        }
    }
}
} // namespace
} // namespace ode_predictive_space::haptics
