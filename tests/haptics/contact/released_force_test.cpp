// The force ends when the proxy reaches the tool, not when the surface leaves the search region.

#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "tests/haptics/contact/contact_fixture.h"
#include "tests/support/effort.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
class ReleasedForceTest : public testing::TestWithParam<double>
{
protected:
    struct Errors
    {
        double spring = 0; ///< N; distance from k (proxy - tool)
        double jump = 0;   ///< N; change in a tick, less k times the hand's travel
        double most = 0;   ///< N; largest force
        Vector3 last = Vector3::Zero();
    };

    Errors errors_along(const ScriptedDevice::Path &path, int ticks)
    {
        ScriptedDevice device(path);
        HapticProbe probe(device, world_.space, GetParam(), with_law(std::make_shared<ProxyLaw>(Material{k})));
        probe.sensor()->prepare_all();
        Errors errors;
        Vector3 tool = Vector3::Zero();
        probe.set_recorder([&](const RenderedTick &tick) {
            const Vector3 &proxy = probe.sensor()->tracker()->proxy();
            errors.spring = std::max(errors.spring, (tick.requested - k * (proxy - tick.tool.position)).norm());
            errors.most = std::max(errors.most, tick.requested.norm());
            if (tick.time > 0)
                errors.jump = std::max(errors.jump,
                                       (tick.requested - errors.last).norm() - k * (tick.tool.position - tool).norm());
            errors.last = tick.requested;
            tool = tick.tool.position;
        });
        world_.run(probe, ticks);
        return errors;
    }

    const OdeUse ode_;
    ProbeWorld world_;
};

INSTANTIATE_TEST_SUITE_P(Radii, ReleasedForceTest, testing::Values(0.001, 0.002, 0.003, 0.005, 0.01),
                         [](const auto &info) { return "Radius" + std::to_string(std::lround(1000 * info.param)); });

TEST_P(ReleasedForceTest, FadesOffTheEdgeOfAThinPlate)
{
    world_.add_box({0.2, 0.2, 0.002}, {-0.1, 0, -0.001});
    const double size = GetParam();
    const Vector3 above(-0.02, 0, 0.05), in(-0.02, 0, size - 0.014), beyond(0.05, 0, size - 0.014);
    const Errors errors = errors_along(
        [=](double t) { return t < 1.5 ? between(above, in, 0.5, 0.7, t) : between(in, beyond, 1.5, 0.7, t); }, 2500);
    EXPECT_LE(errors.jump, 0.1);
    EXPECT_LE(errors.spring, 0.01);
    EXPECT_GT(errors.most, 6.9);
    EXPECT_TRUE(errors.last.isZero(0));
}

TEST_P(ReleasedForceTest, IsTheProxysSpringAllOverARoughBall)
{
    constexpr double ball = 0.05; // m
    const OdeMesh mesh(rough_ball(ball, 160, 0.03, 0.0001, 1));
    mesh.add_to(world_.space);
    RandomNumbers random(1);
    Vector3 at(0, 0, 0.07), to = at;
    const double size = GetParam();
    const Errors errors = errors_along(
        [&](double) {
            constexpr double step = 0.3 * dt; // m; the hand's travel in a tick
            if ((to - at).norm() < 1e-9)
                to = (ball + size + random.between(-0.008, 0.002)) *
                     (at.normalized() + random.in_cube(0.8)).normalized();
            const Vector3 way = to - at;
            at += way.norm() > step ? Vector3(step / way.norm() * way) : way;
            return at;
        },
        of_cases(12000));
    EXPECT_LE(errors.jump, 0.1);
    EXPECT_LE(errors.spring, 0.01);
    EXPECT_GT(errors.most, 2);
}
} // namespace
} // namespace ode_predictive_space::haptics
