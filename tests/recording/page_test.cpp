#include "ode_predictive_space/recording/page.h"

#include "ode_predictive_space/recording/curves.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

#include "tests/support/program.h"

namespace ode_predictive_space::recording
{
namespace
{
TEST(Page, LeavesOutWhatHasNoPoints)
{
    const double none = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    const std::string text = html({"t",
                                   "",
                                   {{"empty", "x", "y", {{"a", {}}, {"b", {{none, 1}, {1, infinite}}}}},
                                    {"log", "x", "y", {{"c", {{1, 0}, {2, -1}}}}, true}}});
    EXPECT_EQ(count_of("<svg", text), 0);
    EXPECT_EQ(count_of("nan", text) + count_of("inf", text), 0);
}

TEST(Page, ShowsTextAsItIs)
{
    const std::string text = html({"<script>", "a < b & \"c\"", {}});
    EXPECT_EQ(count_of("<script", text), 0);
    EXPECT_EQ(count_of("a &lt; b &amp; &quot;c&quot;", text), 1);
}

TEST(Page, HasNoControlCharacters)
{
    const std::string text =
        html({"\x1b[31m", "two\nlines\x07\n", {{"p\x08", "x", "y", {{"c\x1b", {{0, 1}, {1, 2}}}}}}});
    EXPECT_EQ(count_of("<h1>\\x1b[31m</h1>", text), 1) << text;
    EXPECT_EQ(count_of("<pre>two\nlines\\x07\n</pre>", text), 1) << text;
    EXPECT_TRUE(
        std::all_of(text.begin(), text.end(), [](char each) { return each == '\n' || each >= ' ' || each < 0; }));
}

TEST(Page, BeginsWithTheAnswer)
{
    Page page{"t", "details", {}};
    page.answer = {"Leave < it.", {{"spaces", "time"}, {"hash", "1 & 2"}}, {"a note"}, {}};
    const std::string text = html(page);
    EXPECT_LT(text.find("Leave &lt; it."), text.find("<th>spaces</th>")) << text;
    EXPECT_LT(text.find("<td>1 &amp; 2</td>"), text.find("a note")) << text;
    EXPECT_LT(text.find("a note"), text.find("details")) << text;
    EXPECT_EQ(count_of("<table", html({"t", "details", {}})), 0) << "no answer, no table";
}
} // namespace
} // namespace ode_predictive_space::recording
