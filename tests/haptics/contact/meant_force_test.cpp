// The force is k (proxy - tool) in each tick, however the proxy catches up over a rough mesh.

#include "ode_predictive_space/haptics/contact/contact_tracker.h"
#include "tests/haptics/contact/contact_fixture.h"
#include "tests/haptics/contact/rough_mesh.h"
#include "tests/support/effort.h"

#include <algorithm>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr int ticks = of_cases(8000);
constexpr double sheet_side = 0.2; // m

std::vector<TriangleCorners> triangles_of(const MeshShape &shape)
{
    std::vector<TriangleCorners> triangles;
    for (const auto &indices : shape.triangles)
        triangles.push_back({shape.vertices[indices[0]], shape.vertices[indices[1]], shape.vertices[indices[2]]});
    return triangles;
}

ScriptedDevice::Path scrub(double speed, double depth)
{
    return [=](double seconds) -> Vector3 {
        const double way = speed * seconds;
        const double down = std::clamp(seconds / 0.3, 0.0, 1.0);
        const double low = -depth * (0.5 + 0.5 * std::sin(40 * way));
        return {0.07 * std::sin(13 * way), 0.07 * std::sin(17 * way + 1), 0.05 + down * (low - 0.05)};
    };
}

struct Course
{
    double radius; ///< m
    double speed;  ///< m/s
};

class MeantForceTest : public testing::TestWithParam<Course>
{
protected:
    const OdeUse ode_;
    ProbeWorld world_;
    const MeshShape shape_ = rough_sheet(sheet_side, 200, 0.004, 0.0002, 5);
    const OdeMesh mesh_{shape_};
    const MeshTree tree_{triangles_of(shape_)};
};

INSTANTIATE_TEST_SUITE_P(Courses, MeantForceTest,
                         testing::Values(Course{0.003, 0.05}, Course{0.003, 0.2}, Course{0.003, 0.5},
                                         Course{0.01, 0.05}, Course{0.01, 0.2}, Course{0.01, 0.5}),
                         [](const auto &info) {
                             return "Radius" + std::to_string(std::lround(1000 * info.param.radius)) + "Speed" +
                                    std::to_string(std::lround(1000 * info.param.speed));
                         });

TEST_P(MeantForceTest, IsTheProxysSpringInEachTickAndDoesNotJump)
{
    mesh_.add_to(world_.space);
    const double size = GetParam().radius, speed = GetParam().speed;
    ScriptedDevice device(scrub(speed, 0.01));
    RenderSettings rendering;
    rendering.law = std::make_shared<ProxyLaw>(Material{k});
    HapticProbe probe(device, world_.space, size, rendering);
    probe.sensor()->prepare_all();
    double error = 0, inside = 0, jump = 0;
    int pressed = 0;
    Vector3 force = Vector3::Zero(), tool = Vector3::Zero();
    probe.set_recorder([&](const RenderedTick &tick) {
        const Vector3 &proxy = probe.sensor()->tracker()->proxy();
        error = std::max(error, (tick.requested - k * (proxy - tick.tool.position)).norm());
        inside = std::max(inside, size - tree_.distance(proxy, size));
        if (tick.time > 0)
            jump = std::max(jump, (tick.requested - force).norm() - k * (tick.tool.position - tool).norm());
        pressed += tick.requested.norm() > 0.5 ? 1 : 0;
        force = tick.requested;
        tool = tick.tool.position;
    });
    world_.run(probe, ticks);
    EXPECT_LE(error, 0.01);
    EXPECT_LE(inside, size / 1000);
    EXPECT_LE(jump, 0.1);
    EXPECT_GT(pressed, ticks / 4);
}
} // namespace
} // namespace ode_predictive_space::haptics
