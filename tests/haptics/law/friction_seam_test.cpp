// Friction on a flat mesh equals that on a box: the seams between triangles have no effect.

#include "tests/haptics/contact/contact_fixture.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
struct Grid
{
    double cell;  ///< m
    double scale; ///< of the grid, the probe and the hand's path
    double turn;  ///< rad; of the surface, about an oblique axis
};

constexpr double encoder = 3e-5; // m; its steps take the hand exactly above the seams

class FrictionSeamTest : public testing::TestWithParam<Grid>
{
protected:
    Eigen::Matrix3d turn() const
    {
        return Eigen::AngleAxisd(GetParam().turn, Vector3(1, 2, -0.5).normalized()).toRotationMatrix();
    }

    Vector3 hand(double seconds) const
    {
        const double down = std::clamp((seconds - 0.8) / 0.3, 0.0, 1.0);
        const Vector3 flat(0.05 * std::sin(1.3 * std::max(0.0, seconds - 1.2)), 0.02 * std::sin(0.9 * seconds),
                           0.02 - 0.021 * down);
        const Vector3 seen = (flat / encoder).array().round() * encoder;
        return turn() * (GetParam().scale * seen);
    }

    /// N; the largest change of the force in a tick, along the surface, while it is pressed.
    double largest_step(const std::function<void(ProbeWorld &)> &add_surface) const
    {
        ProbeWorld world;
        add_surface(world);
        ScriptedDevice device([this](double seconds) { return hand(seconds); });
        HapticProbe probe(device, world.space, 0.004 * GetParam().scale,
                          with_law(std::make_shared<ProxyLaw>(Material{k, 0, 0.8, 0.8})));
        probe.sensor()->prepare_all();
        const Vector3 normal = turn() * Vector3::UnitZ();
        double most = 0, pressed = 0;
        Vector3 last = Vector3::Zero();
        probe.set_recorder([&](const RenderedTick &tick) {
            const Vector3 along = tick.requested - normal.dot(tick.requested) * normal;
            if (tick.time > 1.5)
            {
                most = std::max(most, (along - last).norm());
                pressed = std::max(pressed, along.norm());
            }
            last = along;
        });
        world.run(probe, 12000);
        EXPECT_GT(pressed, 1.5 * GetParam().scale);
        return most;
    }

    const OdeUse ode_;
};

TEST_P(FrictionSeamTest, IsNotFelt)
{
    const Grid grid = GetParam();
    const int cells = 2 * static_cast<int>(0.07 / grid.cell);
    MeshShape shape = grid_mesh(grid.cell * grid.scale, cells, cells);
    for (Vector3 &vertex : shape.vertices)
        vertex = (turn() * vertex).cast<float>().cast<double>(); // single precision, as programs have it
    const OdeMesh mesh(shape);
    const double on_mesh = largest_step([&](ProbeWorld &world) { mesh.add_to(world.space); });
    const double on_box = largest_step([&](ProbeWorld &world) {
        const double scale = grid.scale;
        const dGeomID box = world.add_box(scale * Vector3(0.3, 0.3, 0.1), turn() * (scale * Vector3(0, 0, -0.05)));
        dMatrix3 rotation = {};
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                rotation[4 * row + column] = turn()(row, column);
        dGeomSetRotation(box, rotation);
    });
    EXPECT_LE(on_mesh, on_box + 0.002);
}

INSTANTIATE_TEST_SUITE_P(Grids, FrictionSeamTest,
                         testing::Values(Grid{6e-3, 1, 0}, Grid{6.1e-3, 1, 0}, Grid{1.5e-3, 1, 0}, Grid{6e-3, 3, 0},
                                         Grid{6.1e-3, 0.3, 0}, Grid{6e-3, 1, 0.7}, Grid{1.5e-3, 1, 0.7},
                                         Grid{1.5e-3, 3, 1.9}),
                         [](const auto &info) { return "Grid" + std::to_string(info.index); });
} // namespace
} // namespace ode_predictive_space::haptics
