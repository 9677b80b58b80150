// Implausible states of a device and events of a scene give no force, and cost no more of it than necessary.

#include "ode_predictive_space/haptics/renderer.h"

#include "tests/haptics/support/faulty_device.h"
#include "tests/haptics/support/probe_fixture.h"

#include <gtest/gtest.h>
#include <optional>
#include <utility>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double stiffness = 500; // N/m

class PositionsOnly : public ScriptedDevice
{
public:
    using ScriptedDevice::ScriptedDevice;

protected:
    DeviceState move_to(double seconds) override
    {
        DeviceState state = ScriptedDevice::move_to(seconds);
        state.linear_velocity.setZero();
        return state;
    }
};

Capabilities with_workspace(double reach)
{
    Capabilities capabilities = desktop_capabilities();
    capabilities.workspace = Eigen::AlignedBox3d(Vector3::Constant(-reach), Vector3::Constant(reach));
    return capabilities;
}

class PlausibilityTest : public HapticProbeTest
{
protected:
    PlausibilityTest() { dCreatePlane(world_.space, 0, 0, 1, 0); }

    double most_force_after(ScriptedDevice &device, double from, double to)
    {
        HapticProbe probe(device, world_.space, radius, with_stiffness(stiffness, notices_.sink()));
        double most = 0;
        probe.set_recorder([&](const RenderedTick &tick) {
            if (tick.time >= from)
                most = std::max(most, tick.wrench.force.norm());
        });
        world_.run(probe, static_cast<int>(to / dt));
        return most;
    }

    ProbeWorld world_;
    NoticeList notices_;
};

/// Gives a new state every 20 ms.
class SlowDevice : public PositionsOnly
{
public:
    using PositionsOnly::PositionsOnly;

    DeviceState read(double time) override
    {
        const DeviceState state = PositionsOnly::read(time);
        if (!last_ || time - last_->time >= 0.02)
            last_ = state;
        return *last_;
    }

private:
    std::optional<DeviceState> last_;
};

TEST_F(PlausibilityTest, ADeviceMayBeSlow)
{
    Capabilities capabilities = desktop_capabilities();
    capabilities.rate = 50;
    SlowDevice device([](double) { return Vector3(0, 0, 0.05); }, capabilities);
    most_force_after(device, 0, 0.5);
    EXPECT_EQ(notices_.count(NoticeKind::device), 0) << notices_.text(NoticeKind::device);
}

TEST_F(PlausibilityTest, ADeviceMayLeaveItsWorkspaceByAMetreOrTwiceItsSize)
{
    for (const auto &[reach, height] : {std::pair(0.1, 1.05), std::pair(1.0, 7.0)})
    {
        PositionsOnly device([z = height](double) { return Vector3(0, 0, z); }, with_workspace(reach));
        most_force_after(device, 0, 0.1);
        EXPECT_EQ(notices_.count(NoticeKind::device), 0) << notices_.text(NoticeKind::device);
    }
}

ScriptedDevice::Path jump_to(double height)
{
    return [=](double seconds) -> Vector3 { return {0, 0, seconds < 1.2 ? 0.05 : height}; };
}

TEST_F(PlausibilityTest, AJumpOfTheDeviceGivesNoForceForAsLongAsItLasts)
{
    for (const double height : {-5.0, -0.05, 0.005})
    {
        PositionsOnly device(jump_to(height), with_workspace(height < -1 ? 10 : 0.1));
        EXPECT_EQ(most_force_after(device, 1.2, 3), 0) << height;
        EXPECT_EQ(notices_.count(NoticeKind::device), 1) << height;
        notices_ = NoticeList();
    }
}

TEST_F(PlausibilityTest, NoForceFarOutsideOfTheWorkspace)
{
    PositionsOnly device(jump_to(-5));
    EXPECT_EQ(most_force_after(device, 1.2, 3), 0);
    EXPECT_NE(notices_.text(NoticeKind::device).find("outside of its workspace"), std::string::npos);
}

TEST_F(PlausibilityTest, ADeviceThatTellsNoVelocityIsTooFastByItsPositions)
{
    const auto dive = [](double seconds) -> Vector3 {
        return {0, 0, seconds < 1.2 ? 0.05 : std::max(-0.2, 0.05 - 5 * (seconds - 1.2))};
    };
    PositionsOnly device(dive);
    most_force_after(device, 1.2, 1.25);
    EXPECT_EQ(notices_.count(NoticeKind::safety), 1);
    EXPECT_NE(notices_.text(NoticeKind::safety).find("faster"), std::string::npos);
}

TEST_F(PlausibilityTest, DampingWorksWithADeviceThatTellsNoVelocity)
{
    constexpr double speed = 0.03; // m/s
    constexpr double damping = 5;  // N s/m
    PositionsOnly device([](double seconds) -> Vector3 {
        return {0, 0, radius + 0.001 - speed * std::max(0.0, seconds - 1.2)};
    });
    RenderSettings settings = with_stiffness(stiffness);
    settings.law = std::make_shared<PenaltyLaw>(Material{stiffness, damping});
    HapticProbe probe(device, world_.space, radius, settings);
    world_.run(probe, 1301);
    const double depth = radius - probe.tool().position.z();
    EXPECT_NEAR(probe.last_tick().requested.z(), stiffness * depth + damping * speed, 0.01 * damping * speed);
}

ScriptedDevice::Path lean()
{
    return reach({0, 0, 0.05}, {0, 0, radius - 0.002});
}

TEST_F(PlausibilityTest, OneReadThatIsNotANumberDoesNotCostTheWall)
{
    for (const double length : {0.0005, 0.005})
    {
        NoticeList notices;
        ScriptedDevice scripted(lean());
        FaultyDevice device(scripted);
        device.break_at(1.7, Breakage::not_a_number, 1.7 + length);
        ProbeWorld world;
        dCreatePlane(world.space, 0, 0, 1, 0);
        HapticProbe probe(device, world.space, radius, with_stiffness(stiffness, notices.sink()));
        world.run(probe, 1701);
        EXPECT_TRUE(device.last_wrench().force.isZero(0)) << "at once";
        world.run(probe, 50);
        EXPECT_LT(device.last_wrench().force.norm(), 0.3) << "it comes back slowly";
        world.run(probe, 700);
        EXPECT_NEAR(device.last_wrench().force.z(), stiffness * 0.002, 1e-9);
        EXPECT_EQ(notices.count(NoticeKind::device), 2) << "gone, and back";
    }
}

class SpoiledDevice : public ScriptedDevice
{
public:
    using Place = double *(*)(DeviceState &);

    explicit SpoiledDevice(Place place) : ScriptedDevice(lean()), place_(place) {}

    DeviceState read(double time) override
    {
        DeviceState state = ScriptedDevice::read(time);
        if (time > 1.7)
            *place_(state) = nan;
        return state;
    }

private:
    Place place_;
};

TEST_F(PlausibilityTest, AStateThatIsNotANumberIsADeviceThatDoesNotAnswer)
{
    const SpoiledDevice::Place places[] = {[](DeviceState &state) { return &state.time; },
                                           [](DeviceState &state) { return &state.orientation.z(); },
                                           [](DeviceState &state) { return &state.angular_velocity.x(); }};
    for (const SpoiledDevice::Place place : places)
    {
        NoticeList notices;
        SpoiledDevice device(place);
        ProbeWorld world;
        dCreatePlane(world.space, 0, 0, 1, 0);
        HapticProbe probe(device, world.space, radius, with_stiffness(stiffness, notices.sink()));
        world.run(probe, 1690);
        EXPECT_GT(device.last_wrench().force.z(), 0.9);
        world.run(probe, 15);
        EXPECT_TRUE(device.last_wrench().force.isZero(0));
        EXPECT_EQ(notices.count(NoticeKind::device), 1);
    }
}

TEST_F(PlausibilityTest, AMaximumOfForceThatIsNotToldIsANotice)
{
    Capabilities capabilities = desktop_capabilities();
    capabilities.max_force = 0; // as in a new device that does not state it
    ScriptedDevice device(lean(), capabilities);
    HapticProbe probe(device, world_.space, radius, with_stiffness(stiffness, notices_.sink()));
    world_.run(probe, reach_ticks);
    EXPECT_EQ(notices_.count(NoticeKind::safety), 1);
    EXPECT_NE(notices_.text(NoticeKind::safety).find("maximum force is 0"), std::string::npos);
}

class AppearingObjectTest : public HapticProbeTest, public testing::WithParamInterface<bool>
{};

INSTANTIATE_TEST_SUITE_P(Laws, AppearingObjectTest, testing::Bool(), [](const testing::TestParamInfo<bool> &law) {
    return std::string(law.param ? "Proxy" : "Penalty");
});

// 5 N in 0.5 s are 0.01 N per ms. Once, only the limit of the change of force applied: 1.6 N per ms.
TEST_P(AppearingObjectTest, ItsForceRisesSlowly)
{
    ScriptedDevice device([](double) -> Vector3 { return Vector3::Zero(); });
    ProbeWorld world;
    HapticProbe probe(device, world.space, radius, with_law(make_law(GetParam(), Material{stiffness})));
    world.run(probe, 1000);
    world.add_box({0.2, 0.2, 0.02}, {0, 0, -0.009}); // its top is 1 mm above the middle of the probe
    Vector3 before = Vector3::Zero();
    for (int tick = 0; tick < 600; ++tick)
    {
        world.run(probe, 1);
        const Vector3 force = device.last_wrench().force;
        ASSERT_LE((force - before).norm(), 0.02) << tick;
        before = force;
    }
    EXPECT_GT(before.z(), stiffness * 0.005);
    EXPECT_NEAR(before.z(), stiffness * (radius + 0.001), 1e-6);
}

/// N/m; stiffness of the plane in the hand.
double stiffness_in_hand(Renderer &renderer)
{
    const Material material = renderer.rendered(renderer.law().material());
    return renderer.mapping().stiffness_at_device(material.stiffness);
}

TEST_F(PlausibilityTest, SofteningEndsWithItsReason)
{
    ScriptedDevice device(lean());
    Renderer renderer(device, with_stiffness(stiffness));
    WorkspacePlacement placement;
    placement.scale = 20;
    renderer.set_placement(placement);
    EXPECT_NEAR(stiffness_in_hand(renderer), 1000, 1e-9) << "all that the device can render";
    placement.scale = 1;
    renderer.set_placement(placement);
    EXPECT_EQ(stiffness_in_hand(renderer), 500);
    renderer.set_rates(250, 250);
    EXPECT_EQ(stiffness_in_hand(renderer), 250);
    renderer.set_rates(1000, 1000);
    EXPECT_EQ(stiffness_in_hand(renderer), 500);
}

TEST_F(PlausibilityTest, TheDefaultLawIsAsStiffInTheHandAtEachScale)
{
    ScriptedDevice device(lean());
    RenderSettings settings;
    settings.placement.scale = 20;
    Renderer renderer(device, settings);
    EXPECT_NEAR(stiffness_in_hand(renderer), 500, 1e-9);
    settings.placement.scale = 3;
    renderer.set_placement(settings.placement);
    EXPECT_NEAR(stiffness_in_hand(renderer), 500, 1e-9);
}
} // namespace
} // namespace ode_predictive_space::haptics
