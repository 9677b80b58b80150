// Live counters and the page of the launcher, from pages of counts.

#include <algorithm>
#include <deque>
#include <iterator>

#include <gtest/gtest.h>

#include "ode_predictive_space/preload/live.h"

namespace ode_predictive_space::preload
{
namespace
{
void count(SpaceCounts &counts, int space, int calls)
{
    counts.number = space;
    counts.predictive = 1;
    std::copy_n("game", 5, counts.program);
    for (int i = 0; i < calls; ++i)
    {
        counts.collide.add(2e-6, 0);
        counts.collide_series.add(2e-6);
        counts.reported += 3;
    }
}

TEST(LiveLine, IsAboutTheTimeSinceTheReadingBefore)
{
    SpaceCounts first{}, second{};
    count(first, 1, 4);
    count(second, 2, 6);
    const Totals before = totals_of({&first});
    EXPECT_EQ(live_line({}, {}, 0.5), "ode-predictive-run: 0 spaces, 0 collides");
    EXPECT_EQ(live_line(before, totals_of({&first, &second}), 0.5),
              "ode-predictive-run: 2 spaces, 10 collides, 12/s, 2 us, 3 pairs");
}

TEST(LiveLine, HasRoomInALineOfATerminal)
{
    const Totals many{4000, 4'000'000'000'000'000'000, 1e30, 4'000'000'000'000'000'000};
    EXPECT_LT(live_line({}, many, 1e-9).size(), 80u);
}

TEST(LauncherPage, DrawsTheSpacesThatWereCollidedMostOften)
{
    std::deque<SpaceCounts> counts;
    std::vector<SpaceCounts *> pages;
    for (int i = 1; i <= 9; ++i)
    {
        pages.push_back(&counts.emplace_back());
        count(counts.back(), i, i);
    }
    const report::Page page = page_of("game", pages, {}, "");
    ASSERT_EQ(page.plots.size(), 1u);
    ASSERT_EQ(page.plots[0].curves.size(), 7u);
    EXPECT_EQ(page.plots[0].curves[0].points.size(), 9u);
    EXPECT_NE(page.plots[0].curves[0].name.find("space 9"), std::string::npos);
    EXPECT_NE(page.text.find("space 1"), std::string::npos) << "all are in the text";
}

TEST(LauncherPage, NamesTheProgramsThatStillRun)
{
    SpaceCounts counts{};
    count(counts, 1, 4);
    EXPECT_NE(page_of("game", {&counts}, {}, "game (process 7)").text.find("up to then: game (process 7)\n"),
              std::string::npos);
    EXPECT_EQ(page_of("game", {&counts}, {}, "").text.find("Still running"), std::string::npos);
}

// A program that goes astray may leave anything in its page; the launcher must get on with it.
TEST(LauncherPage, IsMadeOfAnyBytes)
{
    for (int byte : {0x00, 0x01, 0x7f, 0x80, 0xff})
    {
        alignas(SpaceCounts) unsigned char bytes[sizeof(SpaceCounts)];
        std::fill(std::begin(bytes), std::end(bytes), static_cast<unsigned char>(byte));
        auto *counts = reinterpret_cast<SpaceCounts *>(bytes);
        const std::string html = report::html(page_of("game", {counts, counts}, {}, ""));
        EXPECT_NE(html.find("</html>"), std::string::npos);
        EXPECT_LT(live_line({}, totals_of({counts}), 0.5).size(), 80u);
    }
}
} // namespace
} // namespace ode_predictive_space::preload
