// What a loop tells: when, how often, and by which clock. Of both kinds.

#include "tests/haptics/loop_fixture.h"

#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
class LoopNoticeTest : public HapticLoopTest
{
protected:
    /// The notices of watchdog and guard.
    std::vector<Notice> of_stalls() const
    {
        std::vector<Notice> stalls;
        for (const Notice &notice : notices_.all())
        {
            if (notice.kind == NoticeKind::watchdog || notice.kind == NoticeKind::guard)
            {
                stalls.push_back(notice);
            }
        }
        return stalls;
    }

    /// Hangs for 60 ms in a step at each of these times, seconds after the loop's beginning.
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

INSTANTIATE_TEST_SUITE_P(Kinds, LoopNoticeTest, testing::Bool(),
                         [](const testing::TestParamInfo<bool> &kind) { return kind.param ? "Decoupled" : "Coupled"; });

TEST_P(LoopNoticeTest, OneStallIsToldOfOnce)
{
    run_with_stalls({2});
    ASSERT_EQ(of_stalls().size(), 1U) << of_stalls()[1].text.data();
}

TEST_P(LoopNoticeTest, AllNoticesHaveSimulatedTime)
{
    clock_.advance(1000); // the clock's time is another one
    device_.break_at(2.5, Breakage::lost);
    run_with_stalls({1, 2});
    loop_->stop();
    ASSERT_GE(notices_.all().size(), 3U);
    for (const Notice &notice : notices_.all())
    {
        EXPECT_GE(notice.time, 0) << notice.text.data();
        EXPECT_LE(notice.time, 3.1) << notice.text.data();
    }
    EXPECT_NEAR(of_stalls()[0].time, 1, 0.1);
    EXPECT_NEAR(of_stalls()[1].time, 2, 0.1);
}

// Told once a second at most, each; but none is lost.
TEST_P(LoopNoticeTest, WhatComesAgainSoonIsToldLaterWithItsNumber)
{
    RenderSettings rendering = usual_rendering();
    rendering.safety = SafetyLimits::of(desktop_capabilities());
    rendering.safety->max_force = 1;
    rendering.safety->engage_force = 0.5;
    path_ = [](double seconds) -> Vector3 { // taps, five times a second, from 1 s on
        return {0, 0, radius + (seconds < 1 ? 0.01 : 0.003 * std::cos(10 * M_PI * seconds))};
    };
    make(std::move(rendering));
    const LoopReport report = loop_->run(work());
    int told = 0;
    int counted = 0;
    for (const Notice &notice : notices_.all())
    {
        const std::string text(notice.sentence());
        const std::size_t number = text.find(" more times");
        if (notice.kind == NoticeKind::safety && text.find("above the device's maximum") != std::string::npos)
        {
            told += number == std::string::npos ? 1 : 0;
            counted += number == std::string::npos ? 0 : std::stoi(text.substr(text.rfind('(', number) + 1));
        }
    }
    EXPECT_LE(told, 2);
    EXPECT_EQ(told + counted, 10) << "each tap, of two seconds";
    EXPECT_EQ(report.held_back, static_cast<std::uint64_t>(counted));
}
} // namespace
} // namespace ode_predictive_space::haptics
