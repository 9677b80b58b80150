// The cost of a tick is bounded by counts, however rough and dense a mesh is.

#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "tests/haptics/contact_fixture.h"
#include "tests/haptics/rough_mesh.h"
#include "tests/support/effort.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double ball = 0.05; // m; the mean radius of the mesh

class SlideBudgetTest : public testing::TestWithParam<double>
{
protected:
    const OdeUse ode_;
    ProbeWorld world_;
};

INSTANTIATE_TEST_SUITE_P(Radii, SlideBudgetTest, testing::Values(0.001, 0.003, 0.01),
                         [](const auto &info) { return "Radius" + std::to_string(std::lround(1000 * info.param)); });

/// Scrubs over the ball in straight lines at changing depths, sometimes through it, and sometimes off it.
class Scrub
{
public:
    explicit Scrub(double size) : size_(size) {}

    Vector3 operator()(double)
    {
        constexpr double step = 0.3 * dt; // m; of the hand in a tick
        if ((to_ - at_).norm() < 1e-9)
        {
            const Vector3 side = (at_.normalized() + random_.in_cube(0.8)).normalized();
            to_ = (ball + size_ + (random_.one_in(10) ? 0.005 : random_.between(-0.006, 0))) * side;
        }
        const Vector3 way = to_ - at_;
        at_ += way.norm() > step ? Vector3(step / way.norm() * way) : way;
        return at_;
    }

private:
    double size_; ///< m; the probe's radius
    RandomNumbers random_{1};
    Vector3 at_ = Vector3(0, 0, 0.07);
    Vector3 to_ = Vector3(0, 0, 0.05);
};

TEST_P(SlideBudgetTest, IsKeptInEachTickOverARoughMesh)
{
    const OdeMesh mesh(rough_ball(ball, 160, 0.03, 0.0002, 1));
    mesh.add_to(world_.space);
    ScriptedDevice device{Scrub(GetParam())};
    RenderSettings rendering;
    rendering.law = std::make_shared<ProxyLaw>(Material{k});
    HapticProbe probe(device, world_.space, GetParam(), rendering);
    probe.sensor()->prepare_all();
    std::size_t most = 0;
    int felt = 0;
    probe.set_recorder([&](const RenderedTick &tick) {
        most = std::max(most, probe.sensor()->tracker()->visited());
        felt += tick.wished.norm() > 0.5 ? 1 : 0;
    });
    constexpr int ticks = of_cases(16000);
    world_.run(probe, ticks);
    EXPECT_LE(most, SphereSlide::most_triangles);
    EXPECT_GT(felt, ticks / 4);
}

/// Some 25,000 triangles are as near to the probe as its place of contact: more than one tick may visit.
TEST_P(SlideBudgetTest, LetsTheProxyArriveOnADenseMesh)
{
    const double size = GetParam();
    const OdeMesh mesh(sheet_mesh(2 * size, 300));
    mesh.add_to(world_.space);
    const Vector3 above(0.1 * size, 0.1 * size, 2 * size), in(0.1 * size, 0.1 * size, 0.5 * size),
        along(0.6 * size, 0.3 * size, 0.5 * size);
    ScriptedDevice device([=](double seconds) {
        return seconds < 1 ? between(above, in, 0.1, 0.4, seconds) : between(in, along, 1, 0.4, seconds);
    });
    RenderSettings rendering;
    rendering.law = std::make_shared<ProxyLaw>(Material{k});
    HapticProbe probe(device, world_.space, size, rendering);
    probe.sensor()->prepare_all();
    std::size_t most = 0;
    probe.set_recorder([&](const RenderedTick &) { most = std::max(most, probe.sensor()->tracker()->visited()); });
    for (int part = 0; part < 2; ++part)
    {
        world_.run(probe, 1000);
        EXPECT_LE((probe.last_tick().wished - Vector3(0, 0, 0.5 * size * k)).norm(), 1e-6) << part;
    }
    EXPECT_GT(most, SphereSlide::most_triangles / 8);
    EXPECT_LE(most, SphereSlide::most_triangles);
}
} // namespace
} // namespace ode_predictive_space::haptics
