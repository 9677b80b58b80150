#include "tests/haptics/loop/loop_fixture.h"

#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
class LoopNoticeTest : public HapticLoopTest
{
protected:
    std::vector<Notice> of_stalls() const
    {
        std::vector<Notice> stalls;
        for (const Notice &notice : notices_.all())
            if (notice.kind == NoticeKind::watchdog || notice.kind == NoticeKind::guard)
                stalls.push_back(notice);
        return stalls;
    }

    /// Hangs for 60 ms in a step at each of these times; s, from the start of the loop.
    LoopReport run_with_stalls(std::vector<double> times)
    {
        make();
        const double begin = clock_.now();
        return loop_->run(work([&, begin, times = std::move(times)](double now) mutable {
            if (!times.empty() && now - begin >= times.front())
            {
                times.erase(times.begin());
                clock_.advance(0.06);
            }
        }));
    }
};

INSTANTIATE_TEST_SUITE_P(Kinds, LoopNoticeTest, testing::Bool(), name_of_loop);

TEST_P(LoopNoticeTest, OneStallIsToldOfOnce)
{
    run_with_stalls({2});
    ASSERT_EQ(of_stalls().size(), 1U) << of_stalls()[1].text.data();
}

TEST_P(LoopNoticeTest, AllNoticesHaveSimulatedTime)
{
    clock_.advance(1000); // the clock's time differs from the simulated one
    device_.break_at(2.5, Breakage::lost);
    run_with_stalls({1, 2.2});
    loop_->stop();
    ASSERT_GE(notices_.all().size(), 3U);
    for (const Notice &notice : notices_.all())
    {
        EXPECT_GE(notice.time, 0) << notice.text.data();
        EXPECT_LE(notice.time, 3.1) << notice.text.data();
    }
    EXPECT_NEAR(of_stalls()[0].time, 1, 0.1);
    EXPECT_NEAR(of_stalls()[1].time, 2.2, 0.1);
}

TEST_P(LoopNoticeTest, ACauseThatComesAgainIsToldOnceASecondAndANewOneAtOnce)
{
    RenderSettings rendering = usual_rendering();
    rendering.safety = SafetyLimits::of(desktop_capabilities());
    rendering.safety->max_force = 1;
    rendering.safety->engage_force = 0.5;
    path_ = [](double seconds) -> Vector3 { // taps, ten times a second; a fast move to the side at 2.25 s
        const double aside = 0.05 * std::clamp((seconds - 2.25) / 0.01, 0.0, 1.0);
        return {aside, 0, radius + (seconds < 1 ? 0.003 : 0.003 * std::cos(20 * M_PI * seconds))};
    };
    make(std::move(rendering));
    probe_->set_materials([this](dGeomID) -> std::optional<Material> {
        const bool broken = std::abs(clock_.now() - 2.65) < 0.02;
        return broken ? std::optional<Material>(Material{-1}) : std::nullopt;
    });
    std::uint64_t saturated = 0;
    probe_->set_recorder([&](const RenderedTick &tick) { saturated += tick.saturated ? 1 : 0; });
    const LoopReport report = loop_->run(work());
    EXPECT_GT(saturated, 10U);
    EXPECT_EQ(report.saturated, saturated);
    EXPECT_EQ(report.notices, notices_.all().size());
    const auto told_at = [&](const char *text) {
        std::vector<double> times;
        for (const Notice &notice : notices_.all())
        {
            if (notice.sentence().find(text) != std::string_view::npos)
                times.push_back(notice.time);
        }
        return times;
    };
    EXPECT_EQ(told_at("above the device's maximum").size(), 2U) << "of twenty taps";
    ASSERT_EQ(told_at("faster than the limit").size(), 1U);
    EXPECT_NEAR(told_at("faster than the limit").front(), 2.25, 0.02);
    ASSERT_GE(told_at("is not a number").size(), 1U);
    EXPECT_NEAR(told_at("is not a number").front(), 2.64, 0.04);
}
} // namespace
} // namespace ode_predictive_space::haptics
