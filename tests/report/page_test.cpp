#include "ode_predictive_space/report/page.h"

#include "ode_predictive_space/report/curves.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>

namespace ode_predictive_space::report
{
namespace
{
std::size_t count_of(const std::string &part, const std::string &text)
{
    std::size_t count = 0;
    for (std::size_t place = text.find(part); place != std::string::npos; place = text.find(part, place + 1))
    {
        ++count;
    }
    return count;
}

/// While it lives, this process writes no file of more bytes.
class SmallFiles
{
public:
    explicit SmallFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN))
    {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit small{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
    }
    ~SmallFiles()
    {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    SmallFiles(const SmallFiles &) = delete;
    SmallFiles &operator=(const SmallFiles &) = delete;

private:
    void (*handler_)(int);
    rlimit before_;
};

TEST(Page, DrawsLinesAndDots)
{
    const std::string text =
        html({"t", "", {{"plot", "x", "y", {{"a", {{0, 0}, {1, 2}}}, {"b", {{1, 1}}, Curve::Style::dots}}}}});
    EXPECT_EQ(count_of("<svg", text), 1u);
    EXPECT_EQ(count_of("points=\"70.0,255.0 790.0,10.0 \"", text), 1u) << "from corner to corner: " << text;
    EXPECT_EQ(count_of("<circle cx=\"790.0\" cy=\"132.5\"", text), 1u) << text;
}

TEST(Page, HasRoomForTheLabelAtTheEndOfAnAxis)
{
    const std::string text = html({"t", "", {{"plot", "x", "y", {{"a", {{0, 0}, {20000, 2}}}}}}});
    EXPECT_EQ(count_of("<text x=\"790\" y=\"272\" text-anchor=\"middle\">20000</text>", text), 1u) << text;
    const std::size_t box = text.find("viewBox=\"0 0 ");
    ASSERT_NE(box, std::string::npos);
    constexpr double half_of_the_label = 5 * 7.0 / 2; // five digits of 12 pixels' height
    EXPECT_GE(std::stod(text.substr(box + 13)), 790 + half_of_the_label);
}

TEST(Page, ALogarithmicAxisHasWholeDecades)
{
    const std::string text = html({"t", "", {{"plot", "x", "y", {{"a", {{0, 1}, {1, 50}}}}, true}}});
    EXPECT_EQ(count_of("points=\"70.0,255.0 790.0,46.9 \"", text), 1u) << text;
    EXPECT_EQ(count_of(">100</text>", text), 1u);
}

TEST(Page, LeavesOutWhatHasNoPoints)
{
    const double none = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    const std::string text = html({"t",
                                   "",
                                   {{"empty", "x", "y", {{"a", {}}, {"b", {{none, 1}, {1, infinite}}}}},
                                    {"log", "x", "y", {{"c", {{1, 0}, {2, -1}}}}, true}}});
    EXPECT_EQ(count_of("<svg", text), 0u);
    EXPECT_EQ(count_of("nan", text) + count_of("inf", text), 0u);
}

TEST(Page, ShowsTextAsItIs)
{
    const std::string text = html({"<script>", "a < b & \"c\"", {}});
    EXPECT_EQ(count_of("<script", text), 0u);
    EXPECT_EQ(count_of("a &lt; b &amp; &quot;c&quot;", text), 1u);
}

TEST(Page, HasNoControlCharacters)
{
    const std::string text =
        html({"\x1b[31m", "two\nlines\x07\n", {{"p\x08", "x", "y", {{"c\x1b", {{0, 1}, {1, 2}}}}}}});
    EXPECT_EQ(count_of("<h1>\\x1b[31m</h1>", text), 1u) << text;
    EXPECT_EQ(count_of("<pre>two\nlines\\x07\n</pre>", text), 1u) << text;
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
    EXPECT_EQ(count_of("<table", html({"t", "details", {}})), 0u) << "no answer, no table";
}

TEST(Answer, ComesBackFromItsLines)
{
    Answer answer{"Leave it.", {{"spaces", "time"}, {"a\tb", "2"}}, {"n"}, {{"p", "x", "y", {}, true}}};
    answer.plots[0].curves = {{"c", {{0.5, 1}, {2, 3}}}};
    const std::optional<Answer> back = answer_of(lines_of(answer));
    ASSERT_TRUE(back);
    EXPECT_EQ(back->sentence, "Leave it.");
    EXPECT_EQ(back->table[1][0], "a b") << "a tab would be the end of a field";
    EXPECT_EQ(back->notes.size(), 1u);
    ASSERT_EQ(back->plots.size(), 1u);
    EXPECT_TRUE(back->plots[0].logarithmic);
    EXPECT_EQ(back->plots[0].curves[0].points[1].y, 3);
}

TEST(Answer, ThatIsNotWholeIsNone)
{
    const std::string lines = lines_of(Answer{"a", {{"b"}}, {}, {{"p", "x", "y", {{"c", {{1, 2}}}}}}});
    for (std::size_t size = 0; size < lines.size() - 1; ++size)
        EXPECT_FALSE(answer_of(lines.substr(0, size))) << lines.substr(0, size);
    EXPECT_FALSE(answer_of("curve\tc\t1 2\nend\n")) << "a curve without a plot";
    EXPECT_FALSE(answer_of("\nend\n"));
    EXPECT_FALSE(answer_of("riddle\t1\nend\n"));
}

TEST(Page, IsWrittenIntoAFolder)
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("page_test_" + std::to_string(getpid())) / "a" / "b";
    prepare_folder(folder);
    EXPECT_EQ(write_page(folder, {"title", "text", {}}), folder / "index.html");
    EXPECT_THROW(prepare_folder(folder / "index.html"), std::runtime_error) << "a file is not a folder";
    std::string first;
    std::getline(std::ifstream(folder / "index.html"), first);
    EXPECT_EQ(first, "<!DOCTYPE html>");
    std::filesystem::remove_all(folder.parent_path().parent_path());
    EXPECT_THROW(prepare_folder("/proc/no_folder"), std::runtime_error);
    EXPECT_THROW(write_page("/proc/no_folder", {}), std::runtime_error);
}

// An empty page was left, in place of an earlier one.
TEST(Page, ThatIsTooLargeForAFileLeavesAnEarlierOne)
{
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("page_test_full_" + std::to_string(getpid()));
    prepare_folder(folder);
    EXPECT_TRUE(std::filesystem::is_empty(folder)) << "a page is there when it is written";
    write_page(folder, {"earlier", "", {}});
    {
        const SmallFiles limit(100);
        EXPECT_THROW(write_page(folder, {"later", std::string(100000, 'x'), {}}), std::runtime_error);
    }
    std::ostringstream page;
    page << std::ifstream(folder / "index.html").rdbuf();
    EXPECT_EQ(count_of("<h1>earlier</h1>", page.str()), 1u) << page.str();
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1) << "nothing else is left";
    std::filesystem::remove_all(folder);
}

TEST(Page, CurvesOfASeriesHaveTheirPointsInTheMiddleOfColumns)
{
    BoundedSeries series{};
    for (std::size_t i = 0; i <= BoundedSeries::most_columns; ++i)
    {
        series.add(static_cast<double>(i));
    }
    const Curve mean = means("m", series, 0.1, 10);
    EXPECT_DOUBLE_EQ(mean.points[1].x, 0.3);
    EXPECT_DOUBLE_EQ(mean.points[1].y, 25);
    EXPECT_DOUBLE_EQ(largest("l", series, 0.1, 10).points[1].y, 30);
}
} // namespace
} // namespace ode_predictive_space::report
