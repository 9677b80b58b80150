// Materials of single geoms in a whole probe: both laws, in one thread and in two.

#include "ode_predictive_space/haptics/contact/material.h"
#include "tests/haptics/contact/contact_fixture.h"

#include <algorithm>
#include <map>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double pressed = 0.002; // m
constexpr double left = -0.03;    // m; the middle of one half of the table
constexpr double right = 0.03;

/// Two boxes side by side, whose tops are at z = 0 and meet at x = 0.
class MaterialTest : public ContactTest
{
protected:
    MaterialTest()
    {
        physics_rate_ = 200;
        build(false);
    }

    void build(bool one_body)
    {
        for (const dGeomID box : {left_, right_})
            if (box != nullptr)
                dGeomDestroy(box);
        materials_.clear();
        left_ = world_.add_box({0.1, 0.2, 0.1}, {-0.05, 0, -0.05});
        right_ = world_.add_box({0.1, 0.2, 0.1}, {0.05, 0, -0.05});
        if (one_body)
        {
            const dBodyID body = world_.add_body(Vector3::Zero(), 1);
            dBodySetKinematic(body);
            for (const dGeomID box : {left_, right_})
            {
                const double x = dGeomGetPosition(box)[0];
                dGeomSetBody(box, body);
                dGeomSetOffsetPosition(box, x, 0, -0.05);
            }
        }
    }

    void paint(const Material &left_one, const Material &right_one)
    {
        materials_[left_] = left_one;
        materials_[right_] = right_one;
    }

    /// Comes down at `start`, waits, and from 1.5 s on moves along x to `end`. @param speed m/s.
    std::vector<RenderedTick> slide(double start, double end, double speed)
    {
        ScriptedDevice device([=](double seconds) -> Vector3 {
            const double down = std::clamp((seconds - 1) / 0.3, 0.0, 1.0);
            const double along = std::clamp((seconds - 1.5) * speed / std::abs(end - start + 1e-300), 0.0, 1.0);
            return {start + along * (end - start), 0, radius + 0.005 - down * (0.005 + pressed)};
        });
        HapticProbe probe(device, world_.space, radius, with_law(make_law(proxy_law()), notices_.sink()));
        probe.set_materials([this](dGeomID geom) -> std::optional<Material> {
            const auto found = materials_.find(geom);
            return found != materials_.end() ? std::optional<Material>(found->second) : std::nullopt;
        });
        std::vector<RenderedTick> ticks;
        probe.set_recorder([&](const RenderedTick &tick) { ticks.push_back(tick); });
        const double duration = 2.2 + std::abs(end - start) / speed;
        const LoopSettings settings = simulated(clock_, duration, decoupled(), physics_rate_);
        HapticLoop(probe, settings).run(world_.work(probe));
        return ticks;
    }

    /// N; the largest change of the requested force from tick to tick, once pressed.
    static double largest_jump(const std::vector<RenderedTick> &ticks)
    {
        double largest = 0;
        for (std::size_t i = 1; i < ticks.size(); ++i)
            if (ticks[i].time > 1.5)
                largest = std::max(largest, (ticks[i].requested - ticks[i - 1].requested).norm());
        return largest;
    }

    static double friction_of_sliding(const std::vector<RenderedTick> &ticks)
    {
        const auto sliding =
            std::find_if(ticks.begin(), ticks.end(), [](const RenderedTick &tick) { return tick.time > 1.85; });
        return -sliding->force.x() / sliding->force.z();
    }

    NoticeList notices_;
    std::map<dGeomID, Material> materials_;
    dGeomID left_ = nullptr;
    dGeomID right_ = nullptr;
};

INSTANTIATE_TEST_SUITE_P(Laws, MaterialTest, contact_tests, contact_test_name);

TEST_P(MaterialTest, SoftBesideHardEachAsStiffAsItIs)
{
    for (const bool one_body : {false, true})
    {
        build(one_body);
        paint({200}, {800});
        EXPECT_NEAR(slide(left, left, 0.1).back().force.z(), 200 * pressed, 1e-9);
        EXPECT_NEAR(slide(right, right, 0.1).back().force.z(), 800 * pressed, 1e-9);
    }
}

TEST_P(MaterialTest, WhatHasNoMaterialIsTheLaws)
{
    EXPECT_NEAR(slide(left, left, 0.1).back().force.z(), 500 * pressed, 1e-9);
}

TEST_P(MaterialTest, IceBesideRubber)
{
    paint({500, 0, 0.05}, {500, 0, 0.9});
    for (const auto &[start, friction] : {std::pair(left, 0.05), std::pair(right, 0.9)})
        EXPECT_NEAR(friction_of_sliding(slide(start, start + 0.02, 0.05)), friction, 1e-6);
}

TEST_P(MaterialTest, StaticFrictionHoldsLongerAndSlidingIsFelt)
{
    paint({500, 0, 0.2, 0.6}, {});
    const std::vector<RenderedTick> ticks = slide(left, left + 0.02, 0.05);
    double most = 0;
    for (const RenderedTick &tick : ticks)
        most = std::max(most, -tick.requested.x() / std::max(0.1, tick.requested.z()));
    EXPECT_NEAR(most, 0.6, 0.02);
    EXPECT_NEAR(friction_of_sliding(ticks), 0.2, 1e-6);
}

// Unblended, the force jumps by 1.2 N. The hand moves 0.1 mm per tick, which is 0.08 N while friction holds, and the force of
// 1.6 N may change by a twentieth, another 0.08 N.
TEST_P(MaterialTest, CrossingFromOneToTheOtherTheForceDoesNotJump)
{
    constexpr double most = 0.15; // N per tick
    const Material foam = {200, 0, 0.9};
    const Material glass = {800, 0, 0.05};
    for (const bool one_body : {false, true})
    {
        SCOPED_TRACE(one_body ? "one body" : "two objects");
        build(one_body);
        paint(foam, glass);
        const std::vector<RenderedTick> ticks = slide(left, right, 0.1);
        EXPECT_LE(largest_jump(ticks), most);
        EXPECT_NEAR(ticks.back().force.z(), 800 * pressed, 1e-9);
        EXPECT_LE(largest_jump(slide(right, left, 0.1)), most);
    }
}

TEST_P(MaterialTest, WhatTheDeviceCannotRenderIsSofterAndThatIsTold)
{
    paint({3000}, {400});
    EXPECT_NEAR(slide(left, left, 0.1).back().force.z(), 1000 * pressed, 1e-9);
    EXPECT_GE(notices_.count(NoticeKind::stability), 1);
    EXPECT_NEAR(slide(right, right, 0.1).back().force.z(), 400 * pressed, 1e-9);
}

TEST_P(MaterialTest, OneThatIsNotANumberGivesNoForceAndANotice)
{
    paint({nan}, {500, -1});
    EXPECT_TRUE(slide(left, left, 0.1).back().force.isZero(0));
    EXPECT_TRUE(slide(right, right, 0.1).back().force.isZero(0));
    EXPECT_GE(notices_.count(NoticeKind::contact), 2);
}

TEST(Material, GoesToAnotherOneGraduallyAndArrives)
{
    Material material = {200, 0, 0.9, 1};
    const Material goal = {800, 2, 0.05, 0};
    double last = material.stiffness;
    for (int tick = 0; tick < 20; ++tick)
    {
        material = blended(material, goal, 0.001);
        EXPECT_LE(material.stiffness - last, 800 / 20 + 1e-9);
        last = material.stiffness;
    }
    EXPECT_EQ(material.stiffness, goal.stiffness);
    EXPECT_EQ(material.damping, goal.damping);
    for (int tick = 0; tick < 50; ++tick)
        material = blended(material, goal, 0.001);
    EXPECT_EQ(material.friction, goal.friction);
    EXPECT_LE(material.static_friction, 0.05);
}
} // namespace
} // namespace ode_predictive_space::haptics
