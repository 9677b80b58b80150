// A probe in notches so narrow that it lies on both walls at once, far above the bottom.

#include "tests/haptics/contact/contact_fixture.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double probe_in_notch = 0.003; // m; radius
constexpr double wall = 0.4;             // m; length from the bottom up
constexpr double wall_thickness = 0.05;  // m

enum class Notch
{
    mesh,
    boxes_of_one_body,
    boxes_of_two_bodies,
    mesh_corner, ///< three walls
    box_corner   ///< three walls, each an object
};

struct Opening
{
    Notch notch;
    int degrees; ///< between the walls; for a corner, twice the angle between wall and axis
};

class NotchTest : public testing::TestWithParam<Opening>
{
protected:
    NotchTest() { build(); }

    double half() const { return GetParam().degrees * M_PI / 360; }
    double resting() const
    {
        return probe_in_notch / std::sin(half());
    } ///< m; height of the probe that lies on the walls
    bool is_corner() const { return GetParam().notch == Notch::mesh_corner || GetParam().notch == Notch::box_corner; }
    int walls() const { return is_corner() ? 3 : 2; }

    /// The horizontal unit vector in which wall i leans away from the bottom.
    Vector3 outwards(int i) const { return {std::cos(2 * M_PI * i / walls()), std::sin(2 * M_PI * i / walls()), 0}; }
    Vector3 up_the_wall(int i) const { return std::sin(half()) * outwards(i) + std::cos(half()) * Vector3::UnitZ(); }
    Vector3 normal(int i) const { return std::sin(half()) * Vector3::UnitZ() - std::cos(half()) * outwards(i); }

    void build()
    {
        if (GetParam().notch == Notch::mesh || GetParam().notch == Notch::mesh_corner)
        {
            mesh_ = std::make_unique<OdeMesh>(is_corner() ? corner() : groove());
            mesh_->add_to(world_.space);
            return;
        }
        const bool one = GetParam().notch == Notch::boxes_of_one_body;
        dBodyID body = nullptr;
        for (int i = 0; i < walls(); ++i)
        {
            if (body == nullptr || !one)
            {
                body = world_.add_body(Vector3::Zero(), 1);
                dBodySetKinematic(body);
            }
            add_wall(body, i);
        }
    }

    void add_wall(dBodyID body, int i)
    {
        const dGeomID box = dCreateBox(world_.space, wall, 0.3, wall_thickness);
        dGeomSetBody(box, body);
        const Vector3 up = up_the_wall(i), n = normal(i), across = n.cross(up);
        const Vector3 centre = 0.4 * wall * up - wall_thickness / 2 * n;
        const dMatrix3 turn = {up.x(), across.x(), n.x(),  0,          up.y(), across.y(),
                               n.y(),  0,          up.z(), across.z(), n.z(),  0};
        dGeomSetOffsetPosition(box, centre.x(), centre.y(), centre.z());
        dGeomSetOffsetRotation(box, turn);
    }

    MeshShape groove() const
    {
        MeshShape shape;
        const Vector3 a(0, -0.15, 0), b(0, 0.15, 0);
        shape.vertices = {a, b};
        for (int i = 0; i < 2; ++i)
        {
            const int first = static_cast<int>(shape.vertices.size());
            shape.vertices.push_back(a + wall * up_the_wall(i));
            shape.vertices.push_back(b + wall * up_the_wall(i));
            shape.triangles.push_back({0, 1, first});
            shape.triangles.push_back({1, first + 1, first});
        }
        return shape;
    }

    MeshShape corner() const
    {
        MeshShape shape;
        shape.vertices = {Vector3::Zero()};
        for (int i = 0; i < 3; ++i)
            shape.vertices.push_back(wall * Vector3::UnitZ() - 2 * wall * std::tan(half()) * outwards(i));
        shape.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
        return shape;
    }

    ScriptedDevice::Path press(double depth) const
    {
        const double top = resting() + 0.02, low = resting() - depth;
        return [=](double t) -> Vector3 {
            const double z = top + std::clamp((t - 0.1) / 0.5, 0.0, 1.0) * (low - top);
            const double aside = t > 0.7 ? 0.0005 * std::sin(40 * (t - 0.7)) : 0;
            return {aside, 0.3 * aside, z};
        };
    }

    void expect_truth(std::shared_ptr<ForceLaw> law, double depth)
    {
        ScriptedDevice device(press(depth));
        HapticProbe probe(device, world_.space, probe_in_notch, with_law(std::move(law)));
        Vector3 last = Vector3::Zero(), tool = Vector3::Zero();
        const Vector3 proxy = Vector3(0, 0, resting());
        probe.set_recorder([&](const RenderedTick &tick) {
            Vector3 truth = k * (proxy - tick.tool.position);
            if (tick.tool.position.z() > resting())
                truth.setZero();
            if (!is_corner())
                truth.y() = 0;
            EXPECT_LE((tick.requested - truth).norm(), 0.002 * truth.norm() + 1e-6)
                << tick.time << ": " << tick.requested.transpose() << " and not " << truth.transpose();
            EXPECT_LE((tick.requested - last).norm(), k * (tick.tool.position - tool).norm() + 0.1) << tick.time;
            last = tick.requested;
            tool = tick.tool.position;
        });
        tool = press(depth)(0);
        for (int i = 0; i < 12 && !HasFailure(); ++i)
            world_.run(probe, 100);
        EXPECT_GT(last.z(), 0.9 * k * depth);
    }

    const OdeUse ode_;
    ProbeWorld world_;
    std::unique_ptr<OdeMesh> mesh_;
};

std::vector<Opening> openings()
{
    std::vector<Opening> all;
    for (const Notch notch :
         {Notch::mesh, Notch::boxes_of_one_body, Notch::boxes_of_two_bodies, Notch::mesh_corner, Notch::box_corner})
        for (const int degrees : {30, 10, 8, 5, 2})
            all.push_back({notch, degrees});
    return all;
}

std::string name_of_opening(const testing::TestParamInfo<Opening> &info)
{
    const char *names[] = {"Mesh", "BoxesOfOneBody", "BoxesOfTwoBodies", "CornerOfAMesh", "CornerOfBoxes"};
    return std::string(names[static_cast<int>(info.param.notch)]) + std::to_string(info.param.degrees) + "Degrees";
}

INSTANTIATE_TEST_SUITE_P(Openings, NotchTest, testing::ValuesIn(openings()), name_of_opening);

TEST_P(NotchTest, TheProxyLawLetsItPassNowhereHoweverHardItIsPressed)
{
    expect_truth(std::make_shared<ProxyLaw>(Material{k}), std::min(0.05, resting() / 2));
}

TEST_P(NotchTest, OfOneObjectThePenaltyLawDoesTheSame)
{
    const bool one = GetParam().notch != Notch::boxes_of_two_bodies && GetParam().notch != Notch::box_corner;
    if (one)
        expect_truth(std::make_shared<PenaltyLaw>(Material{k}), 0.004);
}
} // namespace
} // namespace ode_predictive_space::haptics
